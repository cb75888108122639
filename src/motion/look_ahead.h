#pragma once
/// \file
/// Strides that a body tries in its space, without moving.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "roam/space.h"
#include "roam/walker.h"

namespace roam::wandering {

constexpr double stride = 0.5;      // m of one probe
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
};

/// Strides from `place` in a direction: where each leads to is handed to `visit`, with its length seen from above (or,
/// flying, its length). Ends at a wall, where the ground ends, at the border of the scene, and after `count`.
template <class Visit>
void stride_ahead(const Prober& prober, Vec3 place, const Vec3& direction, int count, const Visit& visit) {
  const auto& [space, settings, mode, body] = prober;
  const bool on_foot = mode == Mode::walk;
  // A stride may climb a slope or a kerb.
  const double slope = std::tan(settings.slope_degrees * std::numbers::pi / 180.0);
  const double climb = on_foot ? std::min(stride * slope + settings.step, settings.height) : 0.0;
  for (int i = 0; i < count; ++i) {
    const Vec3 high = place + Vec3(0, 0, climb * space.first_impact(body, place, {0, 0, climb}).time);
    const FirstImpact along = space.first_impact(body, high, stride * direction);
    if (along.hit && along.time < 0.5) return;
    Vec3 next = high + along.time * stride * direction;
    if (on_foot) {
      const double down = high.z - place.z + climb;
      const FirstImpact ground = space.first_impact(body, next, {0, 0, -down});
      if (!ground.hit) return;
      next.z -= ground.time * down;
    } else if (!airspace(space, settings).holds(next)) {
      return;
    }
    visit(next, along.time * stride);
    if (along.hit) return;
    place = next;
  }
}

}  // namespace roam::wandering
