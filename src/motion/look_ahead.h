#pragma once
/// \file
/// Strides that a body tries in its space, without moving.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "math/slope.h"
#include "roam/space.h"
#include "roam/walker.h"

namespace roam::wandering {

constexpr double stride = 0.5;       // m of one probe
constexpr double least_piece = 0.1;  // m, of a stride up the steepest slope without a step
constexpr int most_pieces = 8;       // of a stride on foot
constexpr double rounding = 1e-9;    // m, of the sum of its pieces
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
  /// The position over the ground under `place`, which lies up to `raised` metres above it after a piece of `length`.
  /// None if there is no ground, or if it is too steep.
  [[nodiscard]] std::optional<Vec3> on_ground(const Vec3& place, double raised, double length) const {
    const double down = raised + settings.step + slope() * length;
    const Impact ground = space.sweep(body, place, {0, 0, -down});
    const bool is_steep = ground.feature == Feature::face && ground.normal.z < least_upright(settings.slope_degrees);
    if (!ground.hit || is_steep) return std::nullopt;
    return place - Vec3(0, 0, ground.time * down - rest);
  }
  /// Moves `place` on by at most `left` metres over the ground, level, or higher if that leads farther. Returns the
  /// metres: 0 at a wall, and where the ground ends or is too steep.
  [[nodiscard]] double go_on_foot(Vec3& place, const Vec3& direction, double left) const {
    const double level = free_part(place, left * direction);
    if (level < left) {
      const double height = std::max(settings.step, slope() * least_piece);
      const double raised = std::max(0.0, free_part(place, {0, 0, height + rest}) - rest);
      const Vec3 high = place + Vec3(0, 0, raised);
      const double farther = free_part(high, left * direction);
      const auto there = farther > level ? on_ground(high + farther * direction, raised, farther) : std::nullopt;
      if (there) return place = *there, farther;
    }
    const auto there = on_ground(place + level * direction, 0.0, level);
    if (!there) return 0.0;
    return place = *there, level;
  }

 private:
  [[nodiscard]] double slope() const { return std::tan(settings.slope_degrees * std::numbers::pi / 180.0); }
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
      for (int piece = 0; piece < most_pieces && length < stride - rounding; ++piece) {
        const double part = prober.go_on_foot(place, direction, stride - length);
        if (part == 0.0) break;
        length += part;
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
