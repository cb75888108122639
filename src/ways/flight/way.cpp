#include "ways/flight/way.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <utility>

#include "ways/flight/search.h"
#include "ways/refine/refine.h"
#include "ways/refine/way.h"

namespace roam::ways {
namespace {

/// The ratio between one tried radius and the next smaller one.
constexpr double next_radius = 0.75;
/// The first tried radius, as a share of the smaller clearance at the ends, where a way leads off a wall.
constexpr double beside_ends = 0.95;
/// m: the least gain in radius worth a search.
constexpr double wider = 4e-3;
/// The growth of that gain after an unsure search.
constexpr double coarser = 4.0;
/// How often cubes along an unsure way are split, for the first way and for wider ones.
constexpr int first_splits = 6;
constexpr int more_splits = 150;
/// Wider ways taken one after the other, at most.
constexpr int most_improvements = 24;
/// m: rounding of a clearance.
constexpr double rounding = 1e-4;

constexpr double unknown = std::numeric_limits<double>::infinity();

class WidestFlight {
 public:
  WidestFlight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
               const FlyOptions& options)
      : survey_(survey),
        measure_(measure),
        options_(options),
        search_(survey, measure, options.spacing, from, to, [this](std::uint64_t places) { return goes_on(places); }) {
    const double ends = std::min(clearance_at(survey, measure, from), clearance_at(survey, measure, to));
    at_ends_ = ends < measure.widest ? ends + rounding + survey.world().largest_error() : unknown;
    bound_ = at_ends_;
    first_ = std::max(ends < measure.widest ? beside_ends * ends : measure.widest, measure.narrowest);
  }

  Passage first() {
    Passage passage;
    for (double radius = first_;; radius = std::max(next_radius * radius, measure_.narrowest)) {
      const bool last = radius <= measure_.narrowest;
      Flight flight = Flight::not_found;
      if (radius >= search_.least_closed()) flight = search_.look(radius, first_splits);
      if (flight == Flight::none) bound_ = std::min(bound_, radius);
      if (flight == Flight::not_found || (flight == Flight::unsure && last)) flight = search_.search_free_cubes(radius);
      if (flight == Flight::found) {
        passage = taken(radius);
        break;
      }
      if (ended_) break;
      if (last) {
        break_off(passage);
        break;
      }
    }
    return passage;
  }

  /// Widens a known way as long as wider ones are found.
  Passage improved(Passage best) {
    for (int turn = 0; turn < most_improvements && best.limited && !ended_; ++turn) {
      double more = wider;
      Flight flight = Flight::unsure;
      double radius = best.radius;
      while (flight == Flight::unsure && radius < measure_.widest) {
        radius = std::min(best.radius + more, measure_.widest);
        if (radius >= bound_) break;
        if (radius >= search_.least_closed()) flight = search_.look(radius, more_splits);
        if (flight == Flight::none) bound_ = std::min(bound_, radius);
        if (flight == Flight::found) best = taken(radius);
        more *= coarser;
      }
      if (flight != Flight::found) break;
    }
    return finished(std::move(best));
  }

  Passage finished(Passage passage) {
    passage.bound = passage.found && !passage.limited ? at_ends_ : bound_;
    passage.complete = !ended_;
    passage.places = search_.cubes();
    return passage;
  }

 private:
  bool goes_on(std::uint64_t places) {
    ended_ = ended_ || places >= options_.most_places || (options_.goes_on && !options_.goes_on(places));
    return !ended_;
  }

  /// The way that was found, made as wide as possible.
  Passage taken(double radius) {
    const std::vector<Vec3>& way = search_.way();
    Passage passage = refine(survey_, measure_, std::max(options_.spacing, search_.side_for(radius)), way);
    if (passage.found && passage.radius >= radius) return passage;
    // Refinement lost width, but the way itself is certified for `radius`.
    passage = Passage{};
    Stations stations;
    double least = unknown;
    Vec3 narrowest = way.front();
    for (const Vec3& place : way) {
      stations.push_back({place, clearance_at(survey_, measure_, place), false});
      if (stations.back().free >= least) continue;
      least = stations.back().free;
      narrowest = place;
    }
    passage.found = true;
    passage.radius = radius;
    passage.limited = radius < measure_.widest - certified_margin(survey_);
    passage.way = straightened(survey_, measure_, stations, radius);
    passage.length = 0.0;
    for (std::size_t i = 1; i < passage.way.size(); ++i)
      passage.length += glm::distance(passage.way[i], passage.way[i - 1]);
    if (passage.limited) passage.opening = opening_at(survey_, measure_, narrowest, radius);
    return passage;
  }

  /// If there is no way: the gap between the two ends.
  void break_off(Passage& passage) {
    const auto pair = search_.nearest_approach();
    if (!pair) return;
    Opening opening;
    opening.kind = Opening::Kind::gap;
    opening.point = 0.5 * ((*pair)[0] + (*pair)[1]);
    opening.direction = glm::normalize((*pair)[1] - (*pair)[0]);
    passage.opening = opening;
  }

  const Survey& survey_;
  const Measure measure_;
  const FlyOptions& options_;
  FlySearch search_;
  double at_ends_ = unknown, bound_ = unknown, first_ = 0.0;
  bool ended_ = false;
};

}  // namespace

Passage widest_flight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                      const FlyOptions& options) {
  WidestFlight flight(survey, measure, from, to, options);
  return flight.improved(flight.first());
}

Passage widened_flight(const Survey& survey, const Measure& measure, Passage known, const FlyOptions& options) {
  if (!known.found || !known.limited || known.way.size() < 2) return known;
  const Vec3 from = known.way.front(), to = known.way.back();
  WidestFlight flight(survey, measure, from, to, options);
  return flight.improved(std::move(known));
}

}  // namespace roam::ways
