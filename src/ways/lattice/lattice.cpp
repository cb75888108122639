#include "ways/lattice/lattice.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

bool free_way(const World& world, const Body& body, const Vec3& from, const Vec3& to) {
  return !world.first_impact(body, from, to - from).hit;
}

}  // namespace

double clearance_at(const Survey& survey, const Measure& measure, const Vec3& place) {
  if (measure.mode == Mode::fly) {
    const double distance = survey.world().clearance({0.0, 0.0}, place, measure.widest).distance;
    return distance < measure.narrowest ? 0.0 : distance;
  }
  const auto stand = stand_at(survey, measure, place, largest_radius(measure), measure.narrowest);
  return stand ? stand->radius : 0.0;
}

std::optional<Vec3> foot_at(const Survey& survey, const Measure& measure, const Vec3& near) {
  const double level = level_at(survey, measure, near);
  auto foot = floor_below(survey, measure, near.x, near.y, level);
  if (!foot) foot = place_over_gap(survey, measure, near.x, near.y, level);
  return foot ? std::optional(foot->place) : std::nullopt;
}

bool goes_straight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to, double radius) {
  const World& world = survey.world();
  const Body body = body_of(measure, radius);
  Stand at_from{radius, 0.0}, at_to{radius, 0.0};
  if (measure.mode == Mode::walk && measure.height == 0.0) {
    constexpr double tolerance = 1e-4;
    const auto first = stand_at(survey, measure, from, radius, radius - tolerance);
    const auto last = stand_at(survey, measure, to, radius, radius - tolerance);
    if (!first || !last) return false;
    at_from.lift = first->lift;
    at_to.lift = last->lift;
  }
  const Vec3 a = centre_of(measure, from, at_from), b = centre_of(measure, to, at_to);
  const auto has_low_way = [&] { return !meets_high_obstacle(survey, measure, from, to, radius); };
  if (free_way(world, body, a, b)) return has_low_way();
  if (measure.mode == Mode::fly) return false;
  const auto goes_at = [&](double height) {
    const Vec3 from_a(a.x, a.y, height), to_b(b.x, b.y, height);
    return free_way(world, body, a, from_a) && free_way(world, body, from_a, to_b) && free_way(world, body, to_b, b);
  };
  // Crosses at the height of the higher place, as over a kerb. A sphere may lift anywhere, so it may also cross at the
  // lower height, as under a lintel.
  return (goes_at(std::max(a.z, b.z)) && has_low_way()) || (measure.height == 0.0 && goes_at(std::min(a.z, b.z)));
}

}  // namespace roam::ways
