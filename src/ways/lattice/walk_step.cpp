#include "ways/lattice/walk_step.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "math/level_distance.h"
#include "ways/trials/trials.h"

namespace roam::ways {
namespace {

/// Metres. Added to the step limit when two levels are compared.
constexpr double level_tolerance = 2e-3;

}  // namespace

std::optional<FloorPlace> WalkSteps::foot_from(const Standing& from, const Vec3& to) const {
  if (const auto foot = floor_below(survey_, measure_, to.x, to.y, from.level, &gaps_)) return foot;
  const Vec3 half = 0.5 * (from.place + to);
  const auto between = floor_below(survey_, measure_, half.x, half.y, from.level, &gaps_);
  // From the same level, the drop at `to` would fail again.
  if (between && between->level != from.level) {
    if (const auto foot = floor_below(survey_, measure_, to.x, to.y, between->level, &gaps_)) return foot;
  }
  const Vec3 level(to.x, to.y, from.place.z);
  if (!goes_straight(survey_, measure_, from.place, level, measure_.narrowest)) return std::nullopt;
  return place_over_gap(survey_, measure_, to.x, to.y, from.level, &gaps_);
}

float WalkSteps::rounded_down(double radius) {
  const auto clearance = static_cast<float>(radius);
  return clearance > radius ? std::nextafter(clearance, 0.0F) : clearance;
}

float WalkSteps::clearance(const Vec3& place) const {
  const auto stand = stand_at(survey_, measure_, place, largest_, measure_.narrowest);
  return stand ? rounded_down(stand->radius) : 0.0F;
}

/// Two free bodies that overlap leave no room for a wall between them.
bool WalkSteps::linked(const Standing& a, const Standing& b) const {
  const double rise = std::abs(a.place.z - b.place.z), along = level_distance(a.place, b.place);
  const double least = measure_.narrowest;
  const bool one_step = std::abs(a.level - b.level) <= measure_.step + level_tolerance;
  // Centres of spheres differ in height by their radii and lifts too.
  const double apart =
      measure_.height == 0.0 ? std::hypot(along, rise + std::abs(a.free - b.free) + measure_.step) : along;
  if (one_step && a.free + b.free - apart >= 2.0 * least) return true;
  if (one_step && goes_straight(survey_, measure_, a.place, b.place, least)) return true;
  const Vec3 half = 0.5 * (a.place + b.place);
  const auto between = floor_below(survey_, measure_, half.x, half.y, a.level, &gaps_);
  return between && std::abs(between->level - b.level) <= measure_.step + level_tolerance &&
         goes_straight(survey_, measure_, a.place, between->place, least) &&
         goes_straight(survey_, measure_, between->place, b.place, least);
}

bool WalkSteps::walked(const Standing& a, const Standing& b) const {
  constexpr double person = 0.3;  // m
  constexpr double share = 0.97;  // of the free radius
  if (!a.over_gap && !b.over_gap) return true;
  const BodyKind kind{.height = measure_.height, .step = measure_.step, .slope_degrees = survey_.slope_degrees()};
  const std::array<Vec3, 2> way = a.over_gap ? std::array{b.place, a.place} : std::array{a.place, b.place};
  const double radius = std::min(share * std::min(a.free, b.free), person);
  return try_way(survey_, kind, radius, measure_.support_max, way).outcome == Outcome::reached;
}

}  // namespace roam::ways
