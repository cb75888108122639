#include "ways/refine/refine.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "ways/lattice/walk_place.h"
#include "ways/refine/way.h"
#include "ways/trials/on_way.h"

namespace roam::ways {
namespace {

/// The ratio of one lattice's spacing to the next coarser one's, around a narrow place.
constexpr double zoom = 0.3;
/// Spacings that a window extends beyond its narrow places, so that it begins and ends in wide ones.
constexpr double window_margin = 2.0;
/// Places of one window, at most. Larger windows are polished without zooming.
constexpr std::uint64_t most_window_places = 300'000;
/// Metres: widths that differ by less are equal.
constexpr double same_width = 1e-6;

double least_free(const Stations& way) {
  double least = way.front().free;
  for (const Station& s : way) least = std::min(least, s.free);
  return least;
}

/// The widest way through a finer lattice around the given one; the given one if no finer way is as wide.
Stations zoomed(const Survey& survey, const Measure& measure, const Stations& way, double spacing) {
  const double least = least_free(way);
  Box window;
  for (const Station& s : way) window.include(s.place);
  const double margin = least + window_margin * spacing;
  window.lower -= Vec3(margin, margin, measure.step + margin);
  window.upper += Vec3(margin, margin, measure.step + margin);
  Measure closer = measure;
  closer.narrowest = std::max(measure.narrowest, 0.9 * least);
  WidestTree tree(survey, closer, zoom * spacing, window);
  const auto from = tree.seed(way.front().place), to = tree.seed(way.back().place);
  if (!from || !to) return way;
  if (!tree.grow(*from, *to, [](std::uint64_t places) { return places < most_window_places; })) return way;
  Stations finer;
  for (const NodeId id : tree.way(*from, *to)) finer.push_back({tree.node(id).place, tree.node(id).clearance, false});
  if (finer.empty()) return way;
  finer.front() = way.front();
  finer.push_back(way.back());
  return least_free(finer) >= least - same_width ? finer : way;
}

/// The first and last station of a window.
struct Run {
  std::size_t begin = 0, end = 0;
};
Run run_about(const Stations& way, std::size_t i, double narrow, double margin) {
  const auto reach = [&](std::size_t k, std::size_t last, std::ptrdiff_t step) {
    double beyond = 0.0;
    while (k != last) {
      const std::size_t next = k + static_cast<std::size_t>(step);
      beyond = way[k].free < narrow ? 0.0 : beyond + glm::length(way[next].place - way[k].place);
      if (beyond > margin) break;
      k = next;
    }
    return k;
  };
  return {reach(i, 0, -1), reach(i, way.size() - 1, 1)};
}

/// The narrowest unpolished station near which the way may be narrower than at its polished stations.
std::optional<std::size_t> next_narrow(const Stations& way, double limit, double spacing) {
  double least = limit;
  for (const Station& s : way)
    if (s.polished) least = std::min(least, s.free);
  // A thin door between two lattice places may be this much narrower than they are.
  const double between = std::hypot(least, lattice_error * spacing);
  std::optional<std::size_t> next;
  for (std::size_t i = 0; i < way.size(); ++i) {
    if (way[i].polished || way[i].free >= std::min(between, limit - same_width)) continue;
    if (!next || way[i].free < way[*next].free) next = i;
  }
  return next;
}

void polish_narrow_places(const Survey& survey, const Measure& measure, double spacing, Stations& way) {
  const double limit = largest_radius(measure);
  while (const auto narrow = next_narrow(way, limit, spacing)) {
    const double below = std::min(limit, way[*narrow].free + lattice_error * spacing);
    const Run run = run_about(way, *narrow, below, window_margin * spacing);
    Stations window(way.begin() + static_cast<std::ptrdiff_t>(run.begin),
                    way.begin() + static_cast<std::ptrdiff_t>(run.end) + 1);
    const double before = least_free(window);
    Stations ridge = polish(survey, measure, zoomed(survey, measure, window, spacing), zoom * spacing);
    // The loss is more than a thin door between two places explains: the ridge has missed a corner.
    if (std::hypot(least_free(ridge), lattice_error * spacing) < before) ridge = window;
    for (Station& s : ridge)
      if (&s != &ridge.front() && &s != &ridge.back()) s.polished = true;
    // The window's first and last stations only count as polished if the way, or the narrow place, ends there.
    const auto first = way.begin() + static_cast<std::ptrdiff_t>(run.begin);
    if (*narrow == run.begin) ridge.front().polished = true;
    if (*narrow == run.end) ridge.back().polished = true;
    const auto at = way.erase(first, way.begin() + static_cast<std::ptrdiff_t>(run.end) + 1);
    way.insert(at, ridge.begin(), ridge.end());
  }
}

/// Whether a body of `radius` passes a way. A piece that climbs a step goes from one station to the next.
bool passes_all(const Survey& survey, const Measure& measure, const std::vector<Vec3>& way, double radius) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const Vec3 &from = way[i - 1], &to = way[i];
    if (!passes(survey, measure, from, to, radius) && !goes_straight(survey, measure, from, to, radius)) return false;
  }
  return true;
}

/// If the whole way is wider than `radius`, its narrowest place. Straight pieces may be wider than the stations that
/// they replaced. Places narrower than `radius` do not count: a body crosses them by a step.
std::optional<Station> narrowest_if_wider(const Survey& survey, const Measure& measure, const std::vector<Vec3>& way,
                                          double radius) {
  const double margin = certified_margin(survey);
  if (!passes_all(survey, measure, way, radius + 2.0 * margin)) return std::nullopt;
  std::optional<Station> narrowest;
  const auto judge = [&](const Vec3& place) {
    const Station station = station_at(survey, measure, place);
    if (station.free >= radius && (!narrowest || station.free < narrowest->free)) narrowest = station;
  };
  for_each_station(way, station_spacing, [&](const Vec3& place, const Vec3&, double) { judge(place); });
  judge(way.back());
  const bool is_wider =
      narrowest && narrowest->free > radius + margin && passes_all(survey, measure, way, narrowest->free - margin);
  return is_wider ? narrowest : std::nullopt;
}

}  // namespace

Passage refine(const Survey& survey, const Measure& measure, double spacing, std::span<const Vec3> places) {
  Passage passage;
  passage.bound = std::numeric_limits<double>::infinity();
  if (places.empty()) return passage;
  Stations way;
  for (const Vec3& place : places) {
    if (!way.empty() && place == way.back().place) continue;
    way.push_back({place, clearance_at(survey, measure, place), false});
  }
  way.front().polished = way.back().polished = true;  // the way's ends are given
  if (least_free(way) < measure.narrowest) return passage;
  polish_narrow_places(survey, measure, spacing, way);
  const double limit = largest_radius(measure);
  const double seen = least_free(way);
  const auto narrowest =
      std::min_element(way.begin(), way.end(), [](const Station& a, const Station& b) { return a.free < b.free; });
  Vec3 decides = narrowest->place;
  passage.radius = mend(survey, measure, way, seen, spacing);
  const double limited_below = limit - certified_margin(survey);
  passage.way = straightened(survey, measure, way, passage.radius < limited_below ? passage.radius : limit);
  if (passage.radius < limited_below) {
    if (const auto station = narrowest_if_wider(survey, measure, passage.way, passage.radius)) {
      passage.radius = station->free;
      decides = station->place;
    }
  }
  passage.found = passage.radius >= measure.narrowest;
  passage.limited = passage.radius < limited_below;
  if (!passage.limited) passage.radius = limit;
  for (std::size_t i = 1; i < passage.way.size(); ++i)
    passage.length += glm::length(passage.way[i] - passage.way[i - 1]);
  if (passage.limited) passage.opening = opening_at(survey, measure, decides, passage.radius);
  return passage;
}

}  // namespace roam::ways
