#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "math/finite.h"
#include "math/floating_point.h"
#include "math/largest.h"
#include "math/step_limit.h"
#include "motion/demand.h"
#include "motion/sizes.h"
#include "roam/error.h"
#include "roam/walker.h"
#include "text/names.h"
#include "text/number.h"
#include "text/printable.h"

namespace roam {
namespace {

/// Limits far above any use, and low enough that nothing overflows.
constexpr double length_limit = Space::reach_limit / 4.0;
/// Metres. A stride is half a radius long. Below this a step of 4096 strides covers millimetres, at last nothing, and
/// the radius is no longer large beside world_tolerance.
constexpr double least_radius = 1000.0 * walking::world_tolerance;
constexpr double speed_limit = 1e4;
constexpr double factor_limit = 1e3;
constexpr double gravity_limit = 1e3;
constexpr double jump_limit = 100.0;
constexpr double slope_limit = 89.0;

}  // namespace

void demand(const char* whose, const char* what, double value, const char* unit, const Range& range, const char* hint) {
  const bool above = range.open ? value > range.lower : value >= range.lower;
  if (above && value <= range.upper) return;  // written so that NaN fails
  std::string text = std::string(whose) + " " + what + " is " + number_text(value) + " " + unit + "; it must be " +
                     (range.open ? "more than " : "at least ") + number_text(range.lower);
  if (range.upper < positive.upper) text += " and at most " + number_text(range.upper) + " " + unit;
  if (*hint) text += std::string(": ") + hint;
  throw Error(text);
}

WalkerSettings WalkerSettings::person(double radius, double height) {
  const DefaultFloatingPoint guard;
  if (height == 2.0 * radius) return sphere(radius);
  WalkerSettings s;
  const double scale = height / s.height;
  s.radius = radius;
  s.height = height;
  s.eye *= scale;
  s.crouch_height *= scale;
  s.step = std::min(s.step, step_limit(height));
  return s;
}

WalkerSettings WalkerSettings::sphere(double radius) {
  const DefaultFloatingPoint guard;
  WalkerSettings s;
  s.radius = radius;
  s.height = 2.0 * radius;
  s.eye = radius;
  s.step = s.step < radius ? s.step : radius;
  return s;
}

void check(const WalkerSettings& s) {
  const DefaultFloatingPoint guard;
  constexpr const char* whose = "the walker's";
  demand(whose, "radius", s.radius, "m", {least_radius, 0.5 * length_limit, false});
  demand(whose, "support radius", s.support_radius, "m", {0.0, length_limit, false}, "0 is no support disc");
  demand(whose, "height", s.height, "m", {2.0 * s.radius, length_limit, false},
         "a body is at least two radii high, and then a sphere");
  demand(whose, "eye height", s.eye, "m", {0.0, s.height, false},
         "the eye is in the body; set it with the height, as WalkerSettings::person does");
  demand(whose, "step height", s.step, "m", {0.0, step_limit(s.height), false},
         "what is higher is climbed, not stepped on; WalkerSettings::person fits it to the height");
  demand(whose, "slope limit", s.slope_degrees, "degrees", {0.0, slope_limit, false});
  demand(whose, "speed", s.speed, "m/s", {0.0, speed_limit, true});
  demand(whose, "fast factor", s.fast_factor, "times", {1.0, factor_limit, false});
  demand(whose, "gravity", s.gravity, "m/s^2", {0.0, gravity_limit, false});
  demand(whose, "jump height", s.jump_height, "m", {0.0, jump_limit, false});
  demand(whose, "crouched height", s.crouch_height, "m", {0.0, length_limit, true});
  demand(whose, "clearance reach", s.clearance_reach, "m", {0.0, Space::reach_limit, false});
}

void check(std::span<const SizeRegion> regions, const WalkerSettings& settings) {
  const DefaultFloatingPoint guard;
  for (std::size_t i = 0; i < regions.size(); ++i) {
    const SizeRegion& r = regions[i];
    const std::string which = "region " + std::to_string(i + 1) + (r.why.empty() ? "" : " (" + printable(r.why) + ")");
    if (r.bounds.empty() || !is_finite(r.bounds.lower) || !is_finite(r.bounds.upper)) {
      throw Error(which + ": its bounds are empty or not finite; give a box of which no side is negative");
    }
    try {
      check(walking::sized(settings, {r.radius, r.support_radius}));
    } catch (const Error& error) {
      throw Error(which + ": " + error.what());
    }
  }
}

Vec3 wish_velocity(const WalkerSettings& settings, const Vec3& direction, bool fast) {
  const DefaultFloatingPoint guard;
  if (!is_finite(direction)) throw Error("the wished direction is not a finite vector");
  const Vec3 push = direction / std::max(1.0, largest(direction));  // whose length does not overflow
  const double length = glm::length(push);
  const double speed = settings.speed * (fast ? settings.fast_factor : 1.0);
  return push * (length > 1.0 ? speed / length : speed);
}

const char* to_string(Mode mode) { return name_in({"fly", "walk", "ghost"}, mode); }

const char* to_string(EventKind kind) {
  return name_in({"slid",     "blocked",   "stepped_up",  "stepped_down", "jumped",   "airborne", "landed",
                  "fell",     "crouched",  "stood",       "placed",       "freed",    "held",     "put_back",
                  "returned", "throttled", "met_unknown", "slowed",       "narrowed", "widened",  "bridged"},
                 kind);
}

}  // namespace roam
