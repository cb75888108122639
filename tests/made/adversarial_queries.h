#pragma once
/// \file
/// Sweeps that are hard for an engine: every kind aims at one possible error. Seeded; the same on every machine.

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <random>

#include "oracle.h"
#include "roam/sweep.h"

namespace adversarial {

struct Query {
  roam::Body body;
  roam::Vec3 from;
  roam::Vec3 motion;
  roam::Triangle triangle;
};

enum class Kind {
  ordinary,       ///< nearby, roughly towards the triangle
  grazing,        ///< passes at the radius, give or take a few units in the last place
  edge_parallel,  ///< moves along an edge, where the edge's quadratic degenerates
  vertex,         ///< aims at a corner
  sliver,         ///< triangles down to 1e-18 of their length
  degenerate,     ///< points, segments, three corners on a line
  embedded,       ///< starts inside
  touching,       ///< starts at the radius, give or take a few units in the last place
  any_length,     ///< motions of 1e-9 m to 1e5 m
};
inline constexpr Kind kinds[] = {Kind::ordinary,   Kind::grazing,  Kind::edge_parallel, Kind::vertex,    Kind::sliver,
                                 Kind::degenerate, Kind::embedded, Kind::touching,      Kind::any_length};

inline const char* name(Kind kind) {
  constexpr const char* names[] = {"ordinary",   "grazing",  "edge_parallel", "vertex",    "sliver",
                                   "degenerate", "embedded", "touching",      "any_length"};
  return names[static_cast<int>(kind)];
}

/// The places of scenes: the origin, the paper's gallery, a city grid, the radius of the earth.
inline const roam::Vec3 origins[] = {
    {0.0, 0.0, 0.0}, {-13739.0, 253.0, 182.0}, {1e5, -1e5, 1e5}, {6.4e6, 6.4e6, 6.4e6}};

class Generator {
 public:
  Generator(Kind kind, bool capsule, const roam::Vec3& origin, std::uint64_t seed)
      : kind_(kind), capsule_(capsule), origin_(origin), random_(seed) {}

  Query next() {
    Query q;
    q.body.radius = one_in(10) ? 0.0 : power(-2.0, 0.3);
    q.body.half_height = capsule_ ? power(-2.0, 0.5) : 0.0;
    q.triangle = triangle();
    const roam::Vec3 target = target_on(q.triangle), to_start = direction();
    place(q, target, to_start);
    for (auto& corner : q.triangle) corner += origin_;
    q.from += origin_;
    // From here on the coordinates are rounded at the origin. Only motion and radius may still change.
    if (kind_ == Kind::edge_parallel) q.motion = along_an_edge(q);
    if (kind_ == Kind::vertex) q.motion = (q.triangle[index(3)] - q.from) * uniform(0.5, 2.0);
    if (kind_ == Kind::grazing || ((kind_ == Kind::edge_parallel || kind_ == Kind::vertex) && one_in(2))) {
      tune(q, oracle::least_distance<oracle::Quad>(q.body, q.from, q.motion, 1.0, q.triangle));
    }
    if (kind_ == Kind::touching) tune(q, oracle::distance<oracle::Quad>(q.body, q.from, q.triangle));
    return q;
  }

 private:
  double uniform(double a, double b) { return a + (b - a) * (static_cast<double>(random_() >> 11) * 0x1p-53); }
  double power(double a, double b) { return std::pow(10.0, uniform(a, b)); }
  int index(int n) { return static_cast<int>(random_() % static_cast<std::uint64_t>(n)); }
  bool one_in(int n) { return index(n) == 0; }
  double sign() { return one_in(2) ? -1.0 : 1.0; }

  roam::Vec3 direction() {
    if (one_in(8)) {
      roam::Vec3 axis(0.0);
      axis[index(3)] = sign();
      return axis;
    }
    for (;;) {
      const roam::Vec3 v(uniform(-1.0, 1.0), uniform(-1.0, 1.0), uniform(-1.0, 1.0));
      const double square = glm::dot(v, v);
      if (square > 0.01 && square <= 1.0) return v / std::sqrt(square);
    }
  }

  roam::Triangle triangle() {
    const double size = power(-4.0, 4.0) * (one_in(3) ? 1.0 : 1e-2);
    const roam::Vec3 a = direction() * (one_in(2) ? 1.0 : 0.0);
    const roam::Vec3 ab = direction() * size;
    if (kind_ == Kind::sliver) {
      const roam::Vec3 across = glm::cross(ab, direction()) * power(-18.0, -3.0);
      return shuffled({a, a + ab, a + ab * uniform(-0.2, 1.2) + across});
    }
    if (kind_ == Kind::degenerate) {
      switch (index(4)) {
        case 0:
          return {a, a, a};
        case 1:
          return shuffled({a, a, a + ab});
        case 2:
          return shuffled({a, a + ab, a + ab * uniform(-1.0, 2.0)});
        default:
          return shuffled({a, a + roam::Vec3(0.0, 0.0, size), a + roam::Vec3(0.0, 0.0, size * uniform(0.0, 1.0))});
      }
    }
    return {a, a + ab, a + direction() * size * power(-1.0, 0.0)};
  }

  roam::Triangle shuffled(const roam::Triangle& t) {
    const int first = index(3);
    return {t[first], t[(first + 1) % 3], t[(first + 2) % 3]};
  }

  /// A point of the triangle: of the face, of an edge, or a corner.
  roam::Vec3 target_on(const roam::Triangle& t) {
    const int i = index(3);
    const roam::Vec3 &a = t[i], &b = t[(i + 1) % 3], &c = t[(i + 2) % 3];
    if (one_in(4)) return a;
    const roam::Vec3 on_edge = a + (b - a) * uniform(0.0, 1.0);
    return one_in(3) ? on_edge : on_edge + (c - on_edge) * uniform(0.0, 1.0);
  }

  void place(Query& q, const roam::Vec3& target, const roam::Vec3& to_start) {
    const double r = q.body.radius, size = r + q.body.half_height;
    const roam::Vec3 up(0.0, 0.0, uniform(-1.0, 1.0) * q.body.half_height);
    if (kind_ == Kind::embedded) {
      q.from = target + to_start * (r * (one_in(4) ? 0.0 : uniform(0.0, 1.0))) + up;
      q.motion = one_in(4) ? roam::Vec3(0.0) : direction() * power(-3.0, 1.0);
      return;
    }
    if (kind_ == Kind::any_length) {
      const double length = power(-9.0, 5.0);
      const roam::Vec3 beside = target + direction() * (r * uniform(0.0, 1.2)) + up;
      q.from = beside - to_start * (size * uniform(0.5, 1.5) + length * uniform(0.0, 1.0));
      q.motion = to_start * length;
      return;
    }
    q.from = target + to_start * (size + power(-2.0, 1.0));
    const roam::Vec3 past = target + direction() * (size * uniform(0.0, 1.5));
    q.motion = (past - q.from) * uniform(0.5, 2.0);
    // In the plane of the face: the paper's N.v = 0.
    if (one_in(4)) q.motion = (q.triangle[1] - q.triangle[0]) * uniform(-1.0, 1.0) + (q.triangle[2] - q.triangle[0]);
    if (kind_ == Kind::touching && one_in(8)) q.motion = roam::Vec3(0.0);
  }

  roam::Vec3 along_an_edge(const Query& q) {
    const int i = index(3);
    const roam::Vec3 edge = q.triangle[(i + 1) % 3] - q.triangle[i];
    return edge * (sign() * std::ldexp(1.0, index(12) - 4));
  }

  /// A radius that differs from the true distance by its last bits, or by a little.
  void tune(Query& q, oracle::Quad distance) {
    const double d = static_cast<double>(distance);
    if (!(d > 0.0)) return;
    const double relative = one_in(2) ? (index(33) - 16) * 0x1p-52 : sign() * power(-15.0, -6.0);
    q.body.radius = d * (1.0 + relative);
  }

  Kind kind_;
  bool capsule_;
  roam::Vec3 origin_;
  std::mt19937_64 random_;
};

}  // namespace adversarial
