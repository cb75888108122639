#pragma once
/// \file
/// Small scenes to walk in, and a brute-force judge of every position of a walker.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <string>
#include <vector>

#include "oracle.h"
#include "roam/walker.h"
#include "roam/world.h"

namespace scenes {

using roam::Mesh;
using roam::Vec3;

/// Numbers that are the same on every machine, unlike those of std distributions.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed * 0x9E3779B97F4A7C15ULL + 0xD1B54A32D192ED03ULL) {}
  std::uint64_t bits() {  // splitmix64, Steele, Lea and Flood 2014
    std::uint64_t z = (state_ += 0x9E3779B97F4A7C15ULL);
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9ULL;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBULL;
    return z ^ (z >> 31);
  }
  double unit() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double between(double a, double b) { return a + (b - a) * unit(); }
  bool chance(double p) { return unit() < p; }

 private:
  std::uint64_t state_;
};

inline void add_triangle(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c});
  mesh.triangles.push_back({first, first + 1, first + 2});
}

inline void add_quad(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  add_triangle(mesh, a, b, c);
  add_triangle(mesh, a, c, d);
}

/// A level rectangle at height z.
inline void add_floor(Mesh& mesh, double x0, double y0, double x1, double y1, double z) {
  add_quad(mesh, {x0, y0, z}, {x1, y0, z}, {x1, y1, z}, {x0, y1, z});
}

/// A vertical rectangle over the segment from a to b.
inline void add_wall(Mesh& mesh, double ax, double ay, double bx, double by, double z0, double z1) {
  add_quad(mesh, {ax, ay, z0}, {bx, by, z0}, {bx, by, z1}, {ax, ay, z1});
}

/// The six sides of a box.
inline void add_box(Mesh& mesh, const Vec3& lo, const Vec3& hi) {
  add_floor(mesh, lo.x, lo.y, hi.x, hi.y, lo.z);
  add_floor(mesh, lo.x, lo.y, hi.x, hi.y, hi.z);
  add_wall(mesh, lo.x, lo.y, hi.x, lo.y, lo.z, hi.z);
  add_wall(mesh, hi.x, lo.y, hi.x, hi.y, lo.z, hi.z);
  add_wall(mesh, hi.x, hi.y, lo.x, hi.y, lo.z, hi.z);
  add_wall(mesh, lo.x, hi.y, lo.x, lo.y, lo.z, hi.z);
}

inline void shift(Mesh& mesh, const Vec3& by) {
  for (Vec3& v : mesh.vertices) v += by;
}

inline roam::World build(const Mesh& mesh, bool lossless = false) {
  roam::BuildOptions options;
  options.threads = 1;
  options.lossless = lossless;
  return roam::World::build({&mesh, 1}, options);
}

/// Distances of a body's axis from all triangles of a mesh, in long double. Skips triangles whose boxes are farther
/// from the box of the axis than the nearest triangle so far.
class Judge {
 public:
  explicit Judge(const Mesh& mesh) : mesh_(&mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      roam::Box box;
      for (const Vec3& v : mesh.triangle(i)) box.include(v);
      boxes_.push_back(box);
    }
  }

  /// The least distance to any triangle at a place, at most `enough`.
  [[nodiscard]] double distance(const roam::Body& body, const Vec3& place, double enough) const {
    return over(body, place, Vec3(0.0), enough);
  }

  /// The same over a straight motion.
  [[nodiscard]] double over(const roam::Body& body, const Vec3& from, const Vec3& motion, double enough) const {
    roam::Box axis;
    axis.include(from);
    axis.include(from + motion);
    axis.lower.z -= body.half_height;
    axis.upper.z += body.half_height;
    long double least = enough;
    const bool still = motion == Vec3(0.0);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      double squared = 0.0;
      for (int k = 0; k < 3; ++k) {
        const double apart = std::max({boxes_[i].lower[k] - axis.upper[k], axis.lower[k] - boxes_[i].upper[k], 0.0});
        squared += apart * apart;
      }
      // The slack covers the rounding of the boxes, 1e-8 m at 6.4e6 m.
      if (std::sqrt(squared) > static_cast<double>(least) + 1e-6) continue;
      const roam::Triangle t = mesh_->triangle(i);
      least =
          std::min(least, still ? oracle::distance(body, from, t) : oracle::least_distance(body, from, motion, 1.0, t));
    }
    return static_cast<double>(least);
  }

 private:
  const Mesh* mesh_;
  std::vector<roam::Box> boxes_;
};

/// The least margin, in metres, of two promises at the corners of a step and along its pieces: the true clearance is at
/// least the radius - 1e-6 m, and at least the certified one. A negative value is a violation; so is a step with a
/// piece that its report does not hold. The way to the place where a body was put has no promise. Each piece is judged
/// by the radius that it reports.
inline double margin(const Judge& judge, const roam::StepReport& step) {
  constexpr double promise = 1e-6;
  const Vec3& end = step.segments.empty() ? step.from : step.segments.back().position;
  if (step.segments.total() > step.segments.size() || end != step.to) return -std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
  Vec3 at = step.from;
  for (const roam::Segment& c : step.segments) {
    const roam::Body body = roam::Body::capsule(c.radius, c.height);
    const double enough = std::max(c.radius, c.axis_clearance) + 0.001;
    const double true_clearance =
        c.teleport ? judge.distance(body, c.position, enough) : judge.over(body, at, c.position - at, enough);
    least = std::min({least, true_clearance - (c.radius - promise), true_clearance - (c.axis_clearance - promise)});
    at = c.position;
  }
  const roam::Body body = roam::Body::capsule(step.radius, step.height);
  const double here = judge.distance(body, step.to, std::max(step.radius, step.axis_clearance) + 0.001);
  return std::min({least, here - (step.radius - promise), here - (step.axis_clearance - promise)});
}

/// The same for a body whose radius does not change; minus infinity if it does.
inline double margin(const Judge& judge, const roam::StepReport& step, double radius) {
  bool same = step.radius == radius;
  for (const roam::Segment& c : step.segments) same = same && c.radius == radius;
  return same ? margin(judge, step) : -std::numeric_limits<double>::infinity();
}

}  // namespace scenes
