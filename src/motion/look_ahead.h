#pragma once
/// \file
/// Strides that a body tries in its space, without moving.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "math/slope.h"
#include "roam/space.h"
#include "roam/walker.h"

namespace roam::wandering {

constexpr double stride = 0.5;        // m of one probe
constexpr double least_piece = 0.05;  // m, of a stride on foot; after less the body is before a kerb or a slope
constexpr int most_pieces = 4;        // of a stride: up a slope of 60 degrees it has three
// m above the ground: a level sweep must not touch it, so more than the tolerance of a hit, 2 mm.
constexpr double rest = 2.5e-3;
constexpr double fly_height = 2.0;  // m above the floor, where there is no ceiling to stay under

/// The scene, and the air around it that takes a flying body over a roof and round an object.
inline Box airspace(const Space& space, const WalkerSettings& settings) {
  return space.bounds().grown(fly_height + settings.height + stride);
}

/// The `i`th of `count` level directions all around.
inline Vec3 level(int i, int count) {
  const double angle = 2.0 * std::numbers::pi * i / count;
  return {std::cos(angle), std::sin(angle), 0.0};
}

/// A body that looks ahead.
struct Prober {
  const Space& space;
  const WalkerSettings& settings;
  Mode mode;
  Body body;

  /// Metres of `way` until the body touches something.
  [[nodiscard]] double free_part(const Vec3& place, const Vec3& way) const {
    return space.first_impact(body, place, way).time * glm::length(way);
  }
  /// Moves `place` on by at most `left` metres over the ground, level or, if that is blocked, up by a step. Returns the
  /// metres: 0 at a wall, and where the ground ends or is too steep.
  [[nodiscard]] double go_on_foot(Vec3& place, const Vec3& direction, double left) const {
    const double slope = std::tan(settings.slope_degrees * std::numbers::pi / 180.0);
    double raised = 0.0, length = free_part(place, left * direction);
    if (length < least_piece) {
      raised = std::max(0.0, free_part(place, {0, 0, settings.step + rest}) - rest);
      length = free_part(place + Vec3(0, 0, raised), left * direction);
    }
    const Vec3 high = place + Vec3(0, 0, raised) + length * direction;
    const double down = raised + settings.step + slope * length;
    const Impact ground = space.sweep(body, high, {0, 0, -down});
    const bool is_steep = ground.feature == Feature::face && ground.normal.z < least_upright(settings.slope_degrees);
    if (!ground.hit || is_steep) return 0.0;
    place = high - Vec3(0, 0, ground.time * down - rest);
    return length;
  }
};

/// Strides from `place` in a direction: where each leads to is handed to `visit`, with its length seen from above (or,
/// flying, its length). Ends at a wall, where the ground ends, at the border of the scene, after `count`, and where
/// `visit` returns false.
template <class Visit>
void stride_ahead(const Prober& prober, Vec3 place, const Vec3& direction, int count, const Visit& visit) {
  const bool on_foot = prober.mode == Mode::walk;
  if (on_foot) place.z += prober.free_part(place, {0, 0, rest});
  for (int i = 0; i < count; ++i) {
    double length = 0.0;
    if (on_foot) {
      for (int piece = 0; piece < most_pieces && length < stride; ++piece) {
        length += prober.go_on_foot(place, direction, stride - length);
      }
    } else {
      length = prober.free_part(place, stride * direction);
      place += length * direction;
    }
    if (length < 0.5 * stride) return;
    if (!on_foot && !airspace(prober.space, prober.settings).holds(place)) return;
    if (!visit(place, length)) return;
  }
}

}  // namespace roam::wandering
