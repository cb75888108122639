// The ends of a way: where bodies stand, and where they could.
#include "ways/passage/ends.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "math/largest.h"
#include "math/level_distance.h"
#include "roam/sweep.h"
#include "text/number.h"
#include "ways/lattice/walk_place.h"
#include "ways/probe/parts.h"

namespace roam::ways {
namespace {

/// Metres.
constexpr double ring = 0.05;         ///< between one circle of tried places and the next
constexpr double in_sight = 3.0;      ///< how far to search for room in sight
constexpr double beside_end = 0.2;    ///< more than the body's radius: how far an end moves that is too near to a wall
constexpr double around_floor = 1.5;  ///< how far to search for room around a floor's nearest point
constexpr double same_floor = 0.5;    ///< nearer points of floors are tried once
constexpr double spare = 1e-3;        ///< more than the radius: room at an end that is moved
constexpr int ring_places = 24;
constexpr std::size_t most_candidates = 100'000;  ///< candidates kept during the search
constexpr std::size_t most_floors = 48;           ///< points of floors that are tried
constexpr double farthest_off = 100.0;            ///< or the scene's diagonal: flying ends lie at most this far outside

/// The foot near a place; when flying, the place itself.
std::optional<Vec3> placed(const ProbeSearch& search, const Measure& measure, const Vec3& near) {
  return measure.mode == Mode::walk ? foot_at(search.survey, measure, near) : std::optional(near);
}

/// The start of sight lines: on foot at the knee, above the steps.
Vec3 eye_of(const Measure& measure, const Vec3& place) {
  return place + Vec3(0.0, 0.0, measure.mode == Mode::walk ? measure.step + 0.01 : 0.0);
}

/// Points of the floors, the nearest first, at least `same_floor` apart.
std::vector<Vec3> nearest_floors(const Survey& survey, const Vec3& place) {
  struct Candidate {
    double apart;
    Vec3 point;
  };
  const auto is_nearer = [](const Candidate& a, const Candidate& b) { return a.apart < b.apart; };
  std::vector<Candidate> all;
  for (const TriangleId id : survey.floor_triangles()) {
    const Proximity p = proximity({0.0, 0.0}, place, survey.triangle(id));
    all.push_back({p.distance, p.point});
    if (all.size() < 2 * most_candidates) continue;
    std::nth_element(all.begin(), all.begin() + most_candidates, all.end(), is_nearer);
    all.resize(most_candidates);
  }
  std::sort(all.begin(), all.end(), is_nearer);
  std::vector<Vec3> points;
  for (const Candidate& candidate : all) {
    const bool near = std::any_of(points.begin(), points.end(),
                                  [&](const Vec3& p) { return glm::distance(p, candidate.point) < same_floor; });
    if (!near) points.push_back(candidate.point);
    if (points.size() == most_floors) break;
  }
  return points;
}

std::string text_of(const Vec3& p) {
  return fmt::format("({}, {}, {})", fixed_text(p.x, 2), fixed_text(p.y, 2), fixed_text(p.z, 2));
}

/// Whether bodies of `radius` get from one of these places to all others, straight or by way of others.
bool are_joined(const ProbeSearch& search, const std::vector<Vec3>& places, double radius) {
  std::vector<Vec3> left(places.begin() + 1, places.end()), reached{places.front()};
  for (std::size_t i = 0; i < reached.size(); ++i) {
    const Vec3 from = reached[i];
    const auto joined = std::partition(left.begin(), left.end(), [&](const Vec3& to) {
      return !goes_straight(search.survey, search.measure(), from, to, radius);
    });
    reached.insert(reached.end(), joined, left.end());
    left.erase(joined, left.end());
  }
  return left.empty();
}

/// What joins a place with one near it: nothing, a sight line, or a straight way for the narrowest body. With the
/// last, the nearest places must not be apart for the body itself, as on both sides of a door that is too narrow.
enum class Join : std::uint8_t { none, sight, way };

/// The nearest place where a body of `radius` has room, at most `reach` m away.
std::optional<Vec3> room_around(const ProbeSearch& search, const Vec3& place, double radius, double reach, Join join) {
  Measure measure = search.measure();
  // An end is moved to a place with a little more room: a way is certified to less than a millimetre.
  const double least = join == Join::way ? radius + spare : radius;
  measure.widest = std::max(join == Join::way ? radius + ring : radius, 2.0 * measure.narrowest);
  const int layers = measure.mode == Mode::walk ? 0 : 1;
  for (double away = 0.0; away <= reach; away += ring) {
    std::vector<Vec3> found;
    std::size_t best = 0;
    double widest = 0.0;
    for (int layer = -layers; layer <= layers; ++layer) {
      for (int k = 0; k < (away > 0.0 ? ring_places : 1); ++k) {
        const double angle = 2.0 * std::numbers::pi * k / ring_places;
        const Vec3 off = away * glm::normalize(Vec3(std::cos(angle), std::sin(angle), layer));
        const auto there = placed(search, measure, place + off);
        if (!there) continue;
        const double clearance = clearance_at(search.survey, measure, *there);
        const Vec3 eye = eye_of(measure, place);
        if (clearance < least || (clearance <= widest && join != Join::way)) continue;
        const Vec3 view = eye_of(measure, *there) - eye;
        if (join == Join::sight && search.survey.world().first_impact({0.0, 0.0}, eye, view).hit) continue;
        if (join == Join::way && !goes_straight(search.survey, measure, place, *there, measure.narrowest)) continue;
        if (clearance > widest) best = found.size();
        widest = std::max(widest, clearance);
        found.push_back(*there);
      }
    }
    if (found.empty()) continue;
    if (join == Join::way && !are_joined(search, found, radius)) return std::nullopt;
    return found[best];
  }
  return std::nullopt;
}

/// Metres from the box of the scene. On foot, a place above the box counts as inside.
double off_scene(const ProbeSearch& search, const Vec3& place) {
  const Box box = search.survey.world().bounds();
  Vec3 off = glm::max(glm::max(box.lower - place, place - box.upper), Vec3(0.0));
  if (search.options.mode == Mode::walk && place.z > box.upper.z) off.z = 0.0;
  return glm::length(off);
}

/// The nearest place for a body of `radius`, at any distance. On foot, places no higher than `given` and in sight come
/// first.
std::optional<Vec3> nearest_from_afar(const ProbeSearch& search, const Vec3& given, double radius) {
  const Measure measure = search.measure();
  // Seen from far away, a floor is mostly hidden, and searching around each is slow.
  constexpr int most_from_off = 8;
  const bool is_off = off_scene(search, given) > 0.0;
  int tried = 0;
  std::array<std::optional<Vec3>, 4> found;
  for (const Vec3& floor : nearest_floors(search.survey, given)) {
    if (is_off && (found.front() || tried++ == most_from_off)) break;
    const double above = measure.mode == Mode::walk ? 0.0 : radius + ring;
    const auto room = room_around(search, floor + Vec3(0.0, 0.0, above), radius, around_floor, Join::none);
    if (!room) continue;
    const Vec3 view = eye_of(measure, *room) - given;
    const bool hidden =
        largest(view) > Space::motion_limit || search.survey.world().first_impact({0.0, 0.0}, given, view).hit;
    const bool higher = measure.mode == Mode::walk && room->z > given.z + measure.step;
    std::optional<Vec3>& best = found[(higher ? 2U : 0U) + (hidden ? 1U : 0U)];
    if (!best || glm::distance(*room, given) < glm::distance(*best, given)) best = room;
  }
  for (const auto& place : found) {
    if (place) return place;
  }
  return std::nullopt;
}

}  // namespace

bool is_moved(const Vec3& place, const Vec3& given, Mode mode) {
  return mode == Mode::walk ? level_distance(place, given) > 0.0 : place != given;
}

std::optional<Vec3> stand_for(const ProbeSearch& search, const Vec3& given, double radius) {
  Measure measure = search.measure();
  const auto place = free_end(search.survey, measure, given);
  if (!place) return place;
  if (!is_moved(*place, given, measure.mode)) {
    const auto beside = room_around(search, *place, radius, radius + beside_end, Join::way);
    return beside ? beside : place;
  }
  measure.narrowest = radius;
  const auto roomy = free_end(search.survey, measure, given);
  return roomy ? roomy : place;
}

std::optional<Vec3> nearest_room(const ProbeSearch& search, const Vec3& place, double radius) {
  const auto room = room_around(search, place, radius, in_sight, Join::sight);
  return room ? room : nearest_from_afar(search, place, radius);
}

std::optional<ProbeLimit> low_end(const ProbeSearch& search, const Vec3& given, ProbeLimit::Kind end) {
  Measure measure = search.measure();
  if (measure.mode != Mode::walk || measure.height == 0.0) return std::nullopt;
  const double tall = measure.height;
  double low = measure.step + 2.0 * measure.narrowest, high = tall;
  measure.height = low;
  const auto place = free_end(search.survey, measure, given);
  if (!place) return std::nullopt;
  constexpr double precision = 1e-4;  // m
  while (high - low > precision) {
    measure.height = 0.5 * (low + high);
    (clearance_at(search.survey, measure, *place) > 0.0 ? low : high) = measure.height;
  }
  ProbeLimit limit;
  limit.kind = end;
  limit.too_low = true;
  limit.feet = *place;
  limit.point = *place + Vec3(0.0, 0.0, 0.5 * low);
  limit.direction = {0.0, 0.0, 1.0};
  limit.size = low;
  limit.needed = tall;
  return limit;
}

void refuse_far_end(const ProbeSearch& search, const Vec3& given, const char* end) {
  const Box bounds = search.survey.world().bounds();
  if (search.options.mode != Mode::fly || bounds.empty()) return;
  const double off = off_scene(search, given), most = std::max(farthest_off, glm::length(bounds.size()));
  if (off <= most) return;
  throw NoRoomAtEnd(fmt::format("{} {}", end, text_of(given)),
                    fmt::format("it is {:.0f} m outside the scene, which spans {} to {}; choose a place in it, or at "
                                "most {:.0f} m outside",
                                off, text_of(bounds.lower), text_of(bounds.upper), most),
                    std::nullopt);
}

void refuse_end(const ProbeSearch& search, const Vec3& given, const char* end, double radius) {
  const Box bounds = search.survey.world().bounds();
  const bool walks = search.options.mode == Mode::walk;
  const std::string where = fmt::format("{} {}", end, text_of(given));
  std::string why;
  if (search.survey.triangles() == 0) throw NoRoomAtEnd(where, "the scene has no triangles", std::nullopt);
  const double depth = std::max(given.z, bounds.lower.z) - bounds.lower.z + 1.0;
  const Vec3 down(0.0, 0.0, -std::min(depth, Space::motion_limit));
  if (off_scene(search, given) > 0.0) {
    why = fmt::format("it is off the scene, which spans {} to {}", text_of(bounds.lower), text_of(bounds.upper));
  } else if (walks && !search.survey.floor().first_impact({0.0, 0.0}, given + Vec3(0.0, 0.0, 0.1), down).hit) {
    why = fmt::format("there is no floor below it: nothing that is at most {:g} degrees steep",
                      search.survey.slope_degrees());
  } else {
    why = "what is around it leaves no room, as within a wall";
  }
  const auto place = nearest_from_afar(search, given, radius);
  throw NoRoomAtEnd(
      where,
      fmt::format(
          "no body with a radius of {:g} m or more can be there; {}. {}", search.options.narrowest, why,
          place
              ? fmt::format("The nearest place found for a radius of {:g} m is {}", radius, text_of(*place))
              : fmt::format("No place for a radius of {:g} m was found near it; choose one with free space around it{}",
                            radius, walks ? " and floor below" : "")),
      place);
}

}  // namespace roam::ways
