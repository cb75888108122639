#pragma once
/// \file
/// Bodies that pass a triangle at the distance of their radius: at its face, an edge or a corner.

#include <cmath>

#include "clutter.h"
#include "roam/sweep.h"

namespace clutter {

inline double length(const roam::Vec3& v) { return std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

inline roam::Vec3 cross(const roam::Vec3& a, const roam::Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

struct Graze {
  roam::Body body;
  roam::Vec3 from, motion;
  double time;
};

/// A motion of `way` metres that passes a triangle, which is not degenerate, at a distance of radius - depth (m), at
/// `time`.
inline Graze graze(Random& random, const roam::Triangle& t, const roam::Body& body, double depth, double way) {
  using roam::Vec3;
  const Vec3 normal = cross(t[1] - t[0], t[2] - t[0]);
  const double u = random.unit(), v = random.unit() * (1.0 - u);
  // A face, an edge or a corner, and a direction from which it is the nearest part.
  const int kind = static_cast<int>(random.engine() % 3);
  Vec3 point, away;
  if (kind == 0) {
    point = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    away = random.unit() < 0.5 ? normal : -normal;
  } else if (kind == 1) {
    point = t[0] + u * (t[1] - t[0]);
    away = cross(t[1] - t[0], normal) + random.between(-2.0, 2.0) * normal * length(t[1] - t[0]) / length(normal);
  } else {
    point = t[0];
    away = -((t[1] - t[0]) / length(t[1] - t[0]) + (t[2] - t[0]) / length(t[2] - t[0]));
  }
  away = away / length(away);
  // The sphere at the axis's end that faces the point grazes it.
  const Vec3 axis(0.0, 0.0, away.z >= 0.0 ? body.half_height : -body.half_height);
  const Vec3 centre = point + away * (body.radius - depth) + axis;
  Graze g;
  g.body = body;
  g.motion = cross(away, random.direction());
  g.motion = g.motion / length(g.motion) * way;
  g.time = random.unit();
  g.from = centre - g.time * g.motion;
  return g;
}

}  // namespace clutter
