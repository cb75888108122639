#include "train/interval.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "train/neck_ways.h"
#include "train/refine.h"
#include "train/regions.h"

namespace roam::training {

namespace {

/// m, of a grown person: what a body is where nothing asks for another.
constexpr double person = 0.3;
/// A round body is carried by both rims of a crack from 1 / sin(70 degrees) of its half width on (docs/walking.md); and
/// a little for rims that are not straight.
constexpr double carried_share = 1.08;

/// Radii that a body of this kind can have at all.
double cap(const BodyKind& kind, const TrainOptions& options) {
  return std::min(options.radius_max, largest_radius(kind));
}

CrackOptions crack_options(const TrainOptions& options, const Measure& measure) {
  CrackOptions how;
  how.step = options.step;
  how.knee = std::max(how.knee, options.step);
  how.smallest = std::min(measure.narrowest, 0.5 * options.support_max);
  how.support_max = options.support_max;
  how.threads = options.threads;
  return how;
}

void describe_paths(const Layout& layout, Training& training, Evidence& evidence) {
  for (std::size_t i = 0; i < layout.paths.size(); ++i) {
    const Passage& passage = layout.paths[i].passage;
    TrainedPath path;
    path.from = passage.way.front();
    path.to = passage.way.back();
    path.way = passage.way;
    if (passage.limited) path.largest = passage.radius;
    if (path.largest && (!training.largest || *path.largest < *training.largest)) {
      training.largest = path.largest;
      evidence.narrowest = i;
    }
    training.paths.push_back(std::move(path));
  }
}

void cross(const Survey& survey, const Measure& measure, Training& training, Evidence& evidence) {
  const Crossings crossings(survey, evidence.cracks, measure.narrowest);
  for (std::size_t i = 0; i < training.paths.size(); ++i) {
    TrainedPath& path = training.paths[i];
    for (const Crossing& crossing : crossings.on(path.way)) {
      FoundCrack& crack = evidence.cracks[crossing.crack];
      crack.on_a_path = true;
      if (crack.kind != Crack::Kind::crack) continue;
      evidence.crossings.push_back({i, crossing});
      path.smallest = std::max(path.smallest, crack.radius);
      if (crack.radius > training.smallest) {
        training.smallest = crack.radius;
        evidence.widest = crossing.crack;
      }
    }
  }
  for (const FoundCrack& crack : evidence.cracks) {
    if (crack.kind == Crack::Kind::crack) evidence.widest_anywhere = std::max(evidence.widest_anywhere, crack.radius);
    training.cracks.push_back(crack);
  }
}

void describe_decisive(const Layout& layout, const Evidence& evidence, Training& training) {
  if (evidence.narrowest) {
    const Passage& passage = layout.paths[*evidence.narrowest].passage;
    const Opening opening = passage.opening.value_or(Opening{.width = 2.0 * passage.radius});
    training.decisive.push_back({Decisive::Kind::opening, opening.point, opening.width, opening.direction});
  }
  if (evidence.widest) {
    const Crack& crack = evidence.cracks[*evidence.widest];
    training.decisive.push_back({Decisive::Kind::split, crack.point, 2.0 * crack.radius, crack.direction});
  }
}

}  // namespace

Evidence find_ends(const Survey& survey, const TrainOptions& options, const Layout& layout, Stages& stages,
                   Training& training) {
  Evidence evidence;
  describe_paths(layout, training, evidence);
  if (options.mode == Mode::walk && !layout.components.empty()) {
    stages.begin("looking for cracks");
    if (!stages.ended()) {
      const Reached reached(layout, options.spacing);
      evidence.cracks = find_cracks(survey, crack_options(options, layout.measure), reached,
                                    [&](double done) { return stages.at(done); });
    }
    cross(survey, layout.measure, training, evidence);
  }
  training.trapped_radius = trapped_below(training.smallest, options.step);
  describe_decisive(layout, evidence, training);
  return evidence;
}

double trapped_below(double crack_radius, double step) {
  return crack_radius > step && step > 0.0 ? (crack_radius * crack_radius + step * step) / (2.0 * step) : 0.0;
}

void choose_body(const BodyKind& kind, const TrainOptions& options, const Evidence& evidence, Training& training) {
  const double most = training.largest.value_or(cap(kind, options));
  const double upper = training.largest ? inside_share * most : most;
  const double lower = carried_share * training.smallest;
  training.feasible = training.smallest <= most;
  training.radius = std::min(person, upper);
  if (training.feasible && training.radius < lower)
    training.radius = lower <= upper ? lower : 0.5 * (training.smallest + most);
  training.support_radius = 0.0;
  if (training.radius < carried_share * evidence.widest_anywhere)
    training.support_radius = std::min(options.support_max, evidence.widest_anywhere + foot_margin);
}

void add_regions(const Survey& survey, const TrainOptions& options, const Layout& layout, Stages& stages,
                 Training& training) {
  stages.begin("looking beside the paths");
  for (const Component& component : layout.components) {
    if (stages.ended()) return;
    const Rooms rooms = find_rooms(survey, layout.measure, layout.tree, component, training.radius);
    const std::vector<std::vector<Vec3>> ways = neck_ways(layout.tree, rooms);
    std::vector<Passage> openings(ways.size());
    tbb::parallel_for(std::size_t(0), ways.size(), [&](std::size_t i) {
      if (ways[i].size() > 1 && !stages.ended()) openings[i] = refine(survey, layout.measure, options.spacing, ways[i]);
    });
    if (stages.ended()) return;
    for (SizeRegion& region : make_regions(layout.measure, layout.tree, rooms, training.radius, openings)) {
      region.support_radius = training.support_radius;
      training.regions.push_back(std::move(region));
    }
  }
}

}  // namespace roam::training
