#pragma once
/// \file
/// The promises of a space about sweeps and gaps, judged by brute force over the triangles around the body.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "walker_scenes.h"

namespace judged {

using roam::Body;
using roam::Mesh;
using roam::Vec3;

/// Metres: a body is never nearer than its radius by more than this, and never stopped farther off than this.
constexpr double nearest_allowed = 1e-6;
constexpr double farthest_off = 2e-3;
constexpr double farthest_lossless = 1e-5;

/// Metres. An arrival is accepted up to 20 um before contact, plus twice the rounding error of its frame
/// (docs/algorithm.md). The used part depends on the start of the search, and so on the order of tiles. That order
/// changes with the division of the tree into pages, and with searches that begin below its root.
constexpr double arrival_tolerance = 2.5e-5;

/// The same along the motion: the flatter the contact, the larger.
inline double along(const Vec3& way, const roam::Impact& impact) {
  const double length = glm::length(way);
  const double steep = impact.hit && length > 0.0 ? std::abs(glm::dot(impact.normal, way)) / length : 0.0;
  return arrival_tolerance / std::max(0.01, steep);
}

/// Judges Space::gap_bound if the body's surface comes as near as `gap` (m).
inline void judge_gap(double bound, double gap, const Body& body, double reach) {
  if (gap > -body.radius) {
    ASSERT_LE(bound, std::max(gap, 0.0) + nearest_allowed);
  }
  if (bound == reach) {
    ASSERT_GE(gap, reach - nearest_allowed);
  } else {
    ASSERT_LE(gap, std::max(bound, 0.0) * (8.0 / 7.0) + farthest_off);
  }
}

/// Least distances of the axis, as in scenes::Judge. Fast for repeated queries from nearly the same place.
class NearJudge {
 public:
  explicit NearJudge(const Mesh& mesh) : mesh_(&mesh) {}

  [[nodiscard]] double over(const Body& body, const Vec3& from, const Vec3& motion, double enough) {
    look(from, body.half_height + glm::length(motion) + enough);
    return judge_->over(body, from, motion, enough);
  }

 private:
  /// Metres. How far the body may move before the nearby triangles are collected again.
  static constexpr double spare_room = 0.5;

  void look(const Vec3& at, double reach) {
    const Vec3 away = glm::abs(at - centre_);
    if (judge_ && std::max({away.x, away.y, away.z}) + reach <= half_) return;
    centre_ = at;
    half_ = reach + spare_room;
    const roam::Box around{at - Vec3(half_), at + Vec3(half_)};
    near_ = {};
    for (std::size_t i = 0; i < mesh_->triangles.size(); ++i) {
      const roam::Triangle t = mesh_->triangle(i);
      bool apart = false;
      for (int k = 0; k < 3; ++k) {
        apart |= std::max({t[0][k], t[1][k], t[2][k]}) < around.lower[k] ||
                 std::min({t[0][k], t[1][k], t[2][k]}) > around.upper[k];
      }
      if (!apart) scenes::add_triangle(near_, t[0], t[1], t[2]);
    }
    judge_ = std::make_unique<scenes::Judge>(near_);
  }

  const Mesh* mesh_;
  Mesh near_;
  std::unique_ptr<scenes::Judge> judge_;
  Vec3 centre_{0.0};
  double half_ = 0.0;
};

/// Judges a sweep: it is never late, and at a hit some triangle is within the radius and `farthest` (m).
inline void judge_sweep(const roam::Impact& s, const Body& body, const Vec3& from, const Vec3& motion, double farthest,
                        NearJudge& judge) {
  const double enough = body.radius + 0.01;
  if (!s.hit || s.time > 0.0) {
    ASSERT_GE(judge.over(body, from, s.time * motion, enough), body.radius - nearest_allowed);
  }
  if (s.hit) {
    ASSERT_LE(judge.over(body, from + s.time * motion, Vec3(0.0), enough), body.radius + farthest);
  } else {
    ASSERT_EQ(s.time, 1.0);
  }
}

/// Judges a gap.
inline void judge_gap(double bound, const Body& body, const Vec3& from, const Vec3& motion, double reach,
                      NearJudge& judge) {
  const double enough = body.radius + reach + 0.01;
  judge_gap(bound, judge.over(body, from, motion, enough) - body.radius, body, reach);
}

}  // namespace judged
