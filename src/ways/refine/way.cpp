#include "ways/refine/way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "math/level_distance.h"
#include "ways/lattice/walk_place.h"
#include "ways/refine/refine.h"

namespace roam::ways {
namespace {

/// Metres. On foot a straight piece is checked in steps of this length.
constexpr double stride = 0.1;
/// Metres. A straight piece is at most this far above or below the floor, as beside a kerb.
constexpr double floor_tolerance = 0.1;
/// Metres. Added to the rise that the slope limit allows over a stride; a larger rise is a step.
constexpr double uneven = 0.02;
/// A shorter way may be narrower than the part that it replaces, down to this share of its width.
constexpr double kept_share = 0.9;
/// Metres. The longest straight piece: checking one takes steps along all of it.
constexpr double longest_piece = 20.0;

/// As passes(), with the floor within `tolerance` of the straight line and no step along it. At steps the way keeps the
/// lattice places between which a walker climbed them.
bool passes_on_floor(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to, double radius,
                     double tolerance) {
  if (measure.mode == Mode::fly) return goes_straight(survey, measure, from, to, radius);
  const double length = level_distance(to, from);
  const int count = std::max(1, static_cast<int>(std::ceil(length / stride)));
  const double sloping = length / count * std::tan(glm::radians(survey.slope_degrees())) + uneven;
  Vec3 at = from;
  double level = level_at(survey, measure, from);
  for (int i = 1; i <= count; ++i) {
    const Vec3 line = from + (to - from) * (static_cast<double>(i) / count);
    const auto foot = i == count ? std::optional(to) : foot_at(survey, measure, {line.x, line.y, at.z});
    if (!foot || std::abs(foot->z - line.z) > tolerance || std::abs(foot->z - at.z) > measure.step) return false;
    const double before = level;
    level = level_at(survey, measure, *foot);
    if (std::abs(level - before) > sloping) return false;
    if (!goes_straight(survey, measure, at, *foot, radius)) return false;
    at = *foot;
  }
  return true;
}

/// The largest radius up to `radius` that goes straight between two places; 0 if it is less than `narrowest`.
double largest_straight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to, double radius) {
  double free = 0.0, taken = radius;
  while (taken - free > 0.1 * certified_margin(survey)) {
    const double middle = 0.5 * (free + taken);
    (goes_straight(survey, measure, from, to, middle) ? free : taken) = middle;
  }
  return free < measure.narrowest ? 0.0 : free;
}

}  // namespace

double certified_margin(const Survey& survey) {
  constexpr double margin = 5e-4;
  return margin + 2.0 * survey.world().largest_error();
}

bool passes(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to, double radius) {
  return passes_on_floor(survey, measure, from, to, radius, std::abs(to.z - from.z) + measure.widest + measure.step);
}

double mend(const Survey& survey, const Measure& measure, Stations& way, double radius, double spacing) {
  const double margin = certified_margin(survey);
  constexpr int most_halvings = 5;
  double certified = radius;
  Stations mended{way.front()};
  // Pieces still to be certified, the next one on top; `halvings` counts how often each was halved.
  struct Goal {
    Station station;
    int halvings;
  };
  std::vector<Goal> goals;
  for (std::size_t i = way.size(); i-- > 1;) goals.push_back({way[i], 0});
  while (!goals.empty()) {
    const Goal goal = goals.back();
    const Station& here = mended.back();
    const Vec3 piece = goal.station.place - here.place;
    if (goes_straight(survey, measure, here.place, goal.station.place, certified - margin)) {
      mended.push_back(goal.station);
      goals.pop_back();
      continue;
    }
    const double length = glm::length(piece);
    Station between;
    if (goal.halvings < most_halvings && length > 0.0) {
      between = station_at(survey, measure, here.place + 0.5 * piece);
      between = widest_beside(survey, measure, between, piece / length, 0.5 * std::max(length, spacing));
    }
    if (between.free >= certified) {
      goals.back().halvings = goal.halvings + 1;
      goals.push_back({between, goal.halvings + 1});
      continue;
    }
    certified = std::min(
        certified, largest_straight(survey, measure, here.place, goal.station.place, certified - margin) + margin);
    mended.push_back(goal.station);
    goals.pop_back();
  }
  way = std::move(mended);
  return certified;
}

std::vector<Vec3> straightened(const Survey& survey, const Measure& measure, const Stations& way, double radius) {
  const double margin = certified_margin(survey);
  std::vector<Vec3> out{way.front().place};
  for (std::size_t i = 0; i + 1 < way.size();) {
    // Doubles the length until a piece fails, then approaches the last length that passes by halving.
    const auto goes = [&](std::size_t j) {
      double least = std::min(way[i].free, way[j].free), length = 0.0;
      for (std::size_t k = i; k < j; ++k) {
        least = std::min(least, way[k].free);
        length += glm::length(way[k + 1].place - way[k].place);
      }
      if (length > longest_piece) return false;
      const double wide = std::max(radius - margin, std::min(kept_share * least, least - margin));
      return passes_on_floor(survey, measure, way[i].place, way[j].place, wide, floor_tolerance);
    };
    std::size_t reach = 1, next = i + 1;
    while (i + reach < way.size() && goes(i + reach)) {
      next = i + reach;
      reach *= 2;
    }
    for (std::size_t step = (next - i) / 2; step > 0; step /= 2) {
      if (next + step < way.size() && goes(next + step)) next += step;
    }
    out.push_back(way[next].place);
    i = next;
  }
  return out;
}

}  // namespace roam::ways
