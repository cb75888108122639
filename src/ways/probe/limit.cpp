// The limit of a body: a door, a wall beside an end, a lintel that is too low, a step that is too high.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>
#include <vector>

#include "math/boxes.h"
#include "math/step_limit.h"
#include "ways/lattice/walk_place.h"
#include "ways/probe/parts.h"
#include "ways/refine/refine.h"
#include "ways/refine/stations.h"
#include "ways/trials/on_way.h"

namespace roam::ways {
namespace {

/// Metres.
constexpr double same_clearance = 1e-3;  ///< an end limits the way if its clearance is at most this much larger
constexpr double aside = 0.02;           ///< how far a body is moved to test for room on one side
constexpr double station = 0.01;         ///< between the places of a way where the height is measured
constexpr double precision = 1e-3;       ///< of a headroom
constexpr double slack = 5e-4;           ///< ways are certified to this
constexpr double rounding = 1e-6;        ///< of the floor's height
constexpr double granted = 0.02;         ///< more than a search grants above its step
constexpr double step_precision = 0.02;  ///< of the step that a body would have to climb
constexpr double headroom_beyond = 0.5;  ///< how far above the body to search for a lintel
constexpr double rise_within = 0.3;      ///< floors farther apart than this are no step
/// A wall on one side only: moved aside by 1 m, a body gains at least this much clearance.
constexpr double one_sided = 0.4;
/// Metres: reach of the walls on both sides of a narrowest place.
constexpr double side_reach = 0.02;
/// A normal steeper than this belongs to a surface above or below.
constexpr double upright = 0.7;

Vec3 level(const Vec3& v) {
  const Vec3 flat(v.x, v.y, 0.0);
  const double length = glm::length(flat);
  return length > 0.0 ? flat / length : Vec3(0.0);
}

/// Whether a body at an end gains room by moving aside: then the wall is on one side only.
bool has_room_aside(const ProbeSearch& search, const Vec3& place, double clearance) {
  const Measure measure = search.measure();
  constexpr int directions = 16;
  const int layers = measure.mode == Mode::walk ? 0 : 1;
  for (int layer = -layers; layer <= layers; ++layer) {
    for (int k = 0; k < directions; ++k) {
      const double angle = 2.0 * std::numbers::pi * k / directions;
      const Vec3 there = place + aside * glm::normalize(Vec3(std::cos(angle), std::sin(angle), layer));
      const auto foot = measure.mode == Mode::walk ? foot_at(search.survey, measure, there) : std::optional(there);
      if (foot && clearance_at(search.survey, measure, *foot) > clearance + one_sided * aside) return true;
    }
  }
  return false;
}

/// The end as the limit, if the wall beside it is.
std::optional<ProbeLimit> end_limit(const ProbeSearch& search, const Passage& passage, const Vec3& place,
                                    ProbeLimit::Kind kind, double radius) {
  const Measure measure = search.measure();
  const double clearance = clearance_at(search.survey, measure, place);
  if (passage.found) {
    if (!passage.opening || clearance > passage.radius + same_clearance || !has_room_aside(search, place, clearance))
      return std::nullopt;
  } else if (clearance >= radius) {
    return std::nullopt;
  }
  Stand stand{clearance, 0.0};
  if (measure.mode == Mode::walk)
    stand = stand_at(search.survey, measure, place, clearance, 0.99 * clearance).value_or(stand);
  const std::vector<Contact> wall = sides_of(search.survey, measure, place, clearance, stand, 5.0 * same_clearance);
  if (wall.empty()) return std::nullopt;
  if (measure.mode == Mode::walk && std::abs(wall[0].normal.z) >= upright) return std::nullopt;
  ProbeLimit limit;
  limit.kind = kind;
  limit.feet = place;
  limit.direction = measure.mode == Mode::walk ? -level(wall[0].normal) : -wall[0].normal;
  limit.size = clearance;
  limit.needed = radius;
  limit.point = Vec3(place.x, place.y, measure.mode == Mode::walk ? wall[0].point.z : place.z) +
                0.5 * clearance * limit.direction;
  limit.along = kind == ProbeLimit::Kind::start ? 0.0 : passage.length;
  return limit;
}

/// The headroom of a way: the greatest height, up to `most`, of a body of that radius that passes under everything.
ProbeLimit lowest(const ProbeSearch& search, const std::vector<Vec3>& way, double radius, double most) {
  ProbeLimit limit;
  limit.kind = ProbeLimit::Kind::height;
  limit.direction = {0.0, 0.0, 1.0};
  limit.size = most;
  const Body body{radius - slack, 0.0};
  const double bottom = search.options.step + radius, rise = most - bottom - radius;
  for_each_station(way, station, [&](const Vec3& feet, const Vec3& run, double along) {
    const FirstImpact up = search.survey.world().first_impact(body, feet + Vec3(0.0, 0.0, bottom), {0.0, 0.0, rise});
    if (!up.hit || bottom + up.time * rise + body.radius >= limit.size) return;
    limit.size = bottom + up.time * rise + body.radius;
    limit.feet = feet;
    limit.heading = level(run);
    limit.along = along;
  });
  return limit;
}

/// The width of a way at its lowest place, for the bodies of that search. 0 if it is unknown or unlimited.
double width_at(const ProbeSearch& search, const std::vector<Vec3>& way, const ProbeLimit& lowest, double radius) {
  const Measure measure = search.measure();
  Station narrowest{lowest.feet, measure.widest, false};
  for_each_station(way, station, [&](const Vec3& place, const Vec3&, double along) {
    if (std::abs(along - lowest.along) > radius) return;
    const Station here = station_at(search.survey, measure, place);
    if (here.free < narrowest.free) narrowest = here;
  });
  if (narrowest.free >= measure.widest || !(narrowest.free > 0.0)) return 0.0;
  const double reach = search.options.spacing;
  const double widest = widest_beside(search.survey, measure, narrowest, lowest.heading, reach).free;
  return widest < measure.widest ? 2.0 * widest : 0.0;
}

/// Whether both sides of a door reach up to what is above it. Those of a gap between pieces of furniture do not.
bool has_head(const ProbeSearch& search, const ProbeLimit& door) {
  constexpr double below = 0.05, beyond = 0.15;  // m: of the head and of the sides, where the sides are looked for
  const Space& world = search.survey.world();
  const double most = std::min(world.bounds().upper.z - door.point.z + 1.0, Space::motion_limit);
  const FirstImpact head = world.first_impact({0.0, 0.0}, door.point, {0.0, 0.0, most});
  if (!head.hit) return false;
  const Vec3 under = door.point + Vec3(0.0, 0.0, std::max(0.0, head.time * most - below));
  const Vec3 side = (0.5 * door.size + beyond) * door.direction;
  return world.first_impact({0.0, 0.0}, under, side).hit && world.first_impact({0.0, 0.0}, under, -side).hit;
}

}  // namespace

std::optional<ProbeLimit> limit_of(const ProbeSearch& search, const Passage& passage, const ProbeEnds& ends,
                                   double radius) {
  auto end = end_limit(search, passage, ends.start, ProbeLimit::Kind::start, radius);
  if (!end) end = end_limit(search, passage, ends.target, ProbeLimit::Kind::target, radius);
  if (end) return end;
  if (!passage.opening) return std::nullopt;
  const Opening& opening = *passage.opening;
  ProbeLimit limit;
  limit.kind = !passage.found                          ? ProbeLimit::Kind::apart
               : opening.kind == Opening::Kind::lintel ? ProbeLimit::Kind::lintel
               : opening.kind == Opening::Kind::gap    ? ProbeLimit::Kind::gap
                                                       : ProbeLimit::Kind::door;
  const OnWay on = nearest_on(passage.way, opening.point, search.options.mode);
  limit.point = opening.point;
  limit.direction = opening.direction;
  limit.size = opening.width;
  limit.needed = 2.0 * radius;
  limit.along = on.along;
  limit.heading = level(on.heading);
  limit.feet = passage.found ? on.place : opening.point;
  if (limit.kind == ProbeLimit::Kind::door &&
      !is_between(search.survey, search.measure(), on.place, opening, side_reach)) {
    limit.kind = ProbeLimit::Kind::edge;
    limit.size = 0.5 * opening.width;
    limit.needed = radius;
  }
  limit.has_head = limit.kind == ProbeLimit::Kind::door && has_head(search, limit);
  return limit;
}

std::optional<ProbeLimit> headroom(const ProbeSearch& search, double radius) {
  const double tall = search.options.height;
  double low = search.options.step + 2.0 * radius + precision, high = tall;
  if (search.options.mode != Mode::walk || tall == 0.0 || low >= tall) return std::nullopt;
  ProbeSearch lower = search;
  std::optional<ProbeLimit> best;
  std::vector<Vec3> way;
  const auto passes = [&](double height) {
    lower.options.height = height;
    const Passage passage = lower.widest();
    if (!passage.found || passage.radius < radius) return false;
    const ProbeLimit found = lowest(lower, passage.way, radius, tall + headroom_beyond);
    if (!best || found.size > best->size) {
      best = found;
      way = passage.way;
    }
    low = std::max(height, best->size < tall ? best->size : 0.0);
    return true;
  };
  if (!passes(low)) return std::nullopt;
  // Alternates two tries: a millimetre above the known headroom, which ends the search if it fails, and half the
  // interval.
  for (bool beyond = true; high - low > precision; beyond = !beyond) {
    const double next = beyond ? low + precision : 0.5 * (low + high);
    if (!passes(next)) high = next;
  }
  // If nothing limits the height above the lower body's way, height is not what stops the taller body.
  if (best->size >= tall + headroom_beyond) return std::nullopt;
  best->size = low;
  best->needed = tall;
  best->point = best->feet + Vec3(0.0, 0.0, 0.5 * low);
  lower.options.height = low - precision;
  best->width = width_at(lower, way, *best, radius);
  return best;
}

ProbeLimit highest_step(const ProbeSearch& search, const std::vector<Vec3>& way, const Box& where) {
  const double most = search.options.step + granted;
  ProbeLimit limit;
  limit.kind = ProbeLimit::Kind::step;
  limit.direction = {0.0, 0.0, 1.0};
  std::vector<Vec3> floor;
  for_each_station(way, station, [&](const Vec3& foot, const Vec3&, double) {
    if (!where.holds(foot)) return;
    const Vec3 knee = foot + Vec3(0.0, 0.0, search.options.step);
    const Impact down = search.survey.floor().ray(knee, {0.0, 0.0, -2.0 * search.options.step - precision});
    if (down.hit) floor.push_back(down.point);
  });
  for (std::size_t i = 1; i < floor.size(); ++i) {
    const Vec3 run = floor[i] - floor[i - 1];
    if (std::hypot(run.x, run.y) > rise_within) continue;
    if (std::abs(run.z) <= limit.size + rounding || std::abs(run.z) > most) continue;
    limit.size = std::abs(run.z);
    limit.point = floor[i - 1] + 0.5 * run;
    limit.feet = floor[i - 1];
    limit.heading = level(run);
  }
  limit.along = nearest_on(way, limit.point, Mode::walk).along;
  return limit;
}

std::optional<StepUp> step_up(const ProbeSearch& search, double radius) {
  const PassageOptions& o = search.options;
  if (o.mode != Mode::walk || o.height == 0.0) return std::nullopt;
  double low = o.step, high = std::min(step_limit(o.height), o.height - 2.0 * radius);
  if (low >= high) return std::nullopt;
  ProbeSearch higher = search;
  std::optional<StepUp> best;
  const auto passes = [&](double step) {
    higher.options.step = step;
    Passage passage = higher.widest();
    if (!passage.found || passage.radius < radius) return false;
    const ProbeLimit highest = highest_step(higher, passage.way, box_around(passage.way).grown(precision));
    best = {highest, radius, std::move(passage)};
    high = std::min(step, best->limit.size);
    return true;
  };
  if (!passes(high)) return std::nullopt;
  // As headroom() does: tries a little less than the highest step of the known way, and half the interval.
  for (bool below = true; high - low > step_precision + rounding; below = !below) {
    const double next = below ? high - step_precision : 0.5 * (low + high);
    if (!passes(next)) low = next;
  }
  if (best->limit.size <= o.step) return std::nullopt;
  best->limit.needed = o.step;
  return best;
}

}  // namespace roam::ways
