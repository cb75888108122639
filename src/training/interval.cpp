#include "training/interval.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "motion/carrying.h"
#include "training/detour.h"
#include "training/neck_ways.h"
#include "training/over_gap.h"
#include "training/places/regions.h"
#include "ways/refine/refine.h"

namespace roam::training {

namespace {

/// m, of a grown person: the default body.
constexpr double person = 0.3;
/// m: precision of FoundCrack::support_radius, which is for the thinnest body of the search.
constexpr double support_precision = 0.03;
/// Components searched for cracks, at most. None is smaller than least_searched of the largest one.
constexpr std::size_t most_searched = 8;
constexpr double least_searched = 0.01;

/// The largest radius of a body of this kind.
double cap(const ways::BodyKind& kind, const TrainOptions& options) {
  return std::min(options.radius_max, ways::largest_radius(kind));
}

/// m: openings narrower than this neither limit the body nor get a region.
double least_useful(const ways::BodyKind& kind, const TrainOptions& options) {
  return std::min(options.radius_min, cap(kind, options));
}

/// The smallest radius of the paths that let `useful` through; none if there are no such paths.
std::optional<double> least_from(double useful, const Training& training) {
  std::optional<double> least;
  for (const TrainedPath& path : training.paths) {
    const double most = path.largest.value_or(std::numeric_limits<double>::infinity());
    if (most >= useful && (!least || most < *least)) least = most;
  }
  return least;
}

/// Searches component by component: the floor at the bottom of a gap makes it a step down only if the same component
/// reaches it.
std::vector<cracks::FoundCrack> cracks_of(const Survey& survey, const TrainOptions& options, const Layout& layout,
                                          cracks::RimEdges& ahead, Stages& stages) {
  std::vector<cracks::FoundCrack> cracks;
  const cracks::CrackOptions how = crack_options(options, layout.measure);
  std::optional<cracks::RimEdges> others;
  cracks::RimEdges& edges = ahead.options() == how ? ahead : others.emplace(survey, how);
  const double least = least_searched * static_cast<double>(layout.components[0].nodes.size());
  const auto is_searched = [&](const Component& c) { return static_cast<double>(c.nodes.size()) >= least; };
  const auto small = std::find_if_not(layout.components.begin(), layout.components.end(), is_searched);
  const std::size_t count =
      std::min(most_searched, static_cast<std::size_t>(std::distance(layout.components.begin(), small)));
  for (std::size_t i = 0; i < count && !stages.ended(); ++i) {
    const Component& component = layout.components[i];
    const ReachedFloor reached(survey, layout, options.spacing, {&component, 1});
    std::vector<cracks::FoundCrack> found = find_cracks(
        survey, edges, [&](const Vec3& foot) { return reached(foot); },
        [&](double done) { return stages.at((static_cast<double>(i) + done) / static_cast<double>(count)); });
    // Rims behind a thin wall count only for open drops, because an open drop there exists on this side too.
    std::erase_if(found, [&](const cracks::FoundCrack& crack) {
      return crack.kind != Crack::Kind::open_drop &&
             std::none_of(crack.rim.begin(), crack.rim.end(), [&](const Vec3& rim) { return reached.in_sight(rim); });
    });
    cracks.insert(cracks.end(), std::make_move_iterator(found.begin()), std::make_move_iterator(found.end()));
  }
  std::stable_sort(cracks.begin(), cracks.end(),
                   [](const cracks::FoundCrack& a, const cracks::FoundCrack& b) { return a.radius > b.radius; });
  return cracks;
}

void note_width(const cracks::FoundCrack& crack, const TrainOptions& options, double narrowest, Evidence& evidence) {
  // Beside a wall a disc finds room where no body fits. Elsewhere the largest support disc bridges everything but open
  // drops.
  const bool is_beside_wall = crack.support_radius > crack.radius + support_precision;
  const double support = is_beside_wall ? crack.support_radius + support_precision + narrowest + support_margin
                                        : std::min(crack.radius + support_margin, options.support_max);
  evidence.least_support = std::max(evidence.least_support, support);
}

/// Fills in the results for each path.
class Paths {
 public:
  Paths(const Survey& survey, const TrainOptions& options, Layout& layout, Training& training, Evidence& evidence)
      : survey_(survey), options_(options), layout_(layout), training_(training), evidence_(evidence) {
    for (std::size_t i = 0; i < layout.paths.size(); ++i) describe(i);
  }

  void cross_all() {
    const Crossings crossings(survey_, evidence_.cracks, layout_.measure.narrowest);
    for (std::size_t i = 0; i < training_.paths.size(); ++i) cross(crossings, i);
    if (options_.paths == 0) add_crossings(crossings);
    training_.cracks.assign(evidence_.cracks.begin(), evidence_.cracks.end());
  }

 private:
  void describe(std::size_t i) {
    const Passage& passage = layout_.paths[i].passage;
    TrainedPath path;
    path.from = passage.way.front();
    path.to = passage.way.back();
    path.way = passage.way;
    if (passage.limited) path.largest = passage.radius;
    if (path.largest && (!training_.largest || *path.largest < *training_.largest)) {
      training_.largest = path.largest;
      evidence_.limiting_path = i;
    }
    training_.paths.push_back(std::move(path));
  }

  void cross(const Crossings& crossings, std::size_t i) {
    TrainedPath& path = training_.paths[i];
    for (const Crossing& crossing : crossings.on(path.way)) {
      cracks::FoundCrack& crack = evidence_.cracks[crossing.crack];
      crack.on_a_path = true;
      if (crack.kind != Crack::Kind::crack) continue;
      evidence_.crossings.push_back({i, crossing});
      path.smallest = std::max(path.smallest, crack.radius);
      if (crack.radius > training_.smallest) {
        training_.smallest = crack.radius;
        evidence_.limiting_crack = crossing.crack;
      }
      note_hardest(crossing.crack);
    }
  }

  void note_hardest(std::size_t crack) {
    const double carried = evidence_.carried_radius[crack];
    if (carried <= carried_share * evidence_.cracks[crack].radius) return;
    if (!evidence_.hardest || carried > evidence_.carried_radius[*evidence_.hardest]) evidence_.hardest = crack;
  }

  /// The cracks are sorted by width: the first one that must be crossed decides.
  void add_crossings(const Crossings& crossings) {
    const ReachedFloor reached(survey_, layout_, options_.spacing, layout_.components);
    for (const cracks::FoundCrack& crack : evidence_.cracks) {
      if (crack.kind != Crack::Kind::crack || crack.on_a_path) continue;
      if (crack.radius <= training_.smallest) return;
      const std::optional<Ends> ends = must_be_crossed(survey_, layout_, reached, crack);
      if (!ends) continue;
      Passage passage = plan_path(survey_, layout_, options_.spacing, *ends);
      if (passage.way.size() < 2 || !passage.found) continue;
      layout_.paths.push_back({*ends, std::move(passage)});
      describe(layout_.paths.size() - 1);
      cross(crossings, layout_.paths.size() - 1);
    }
  }

  const Survey& survey_;
  const TrainOptions& options_;
  Layout& layout_;
  Training& training_;
  Evidence& evidence_;
};

/// The lower end for which `carried` (m) includes the margin. For level rims it is half the width.
double without_margin(double carried, double smallest) {
  return carried > carried_share * smallest ? std::max(smallest, carried / (carried_share * rim_sine)) : smallest;
}

/// `lower` (m): the least radius that all cracks on the paths carry.
void choose(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence, double lower,
            Training& training) {
  const double largest = training.largest.value_or(cap(kind, options));
  // A size below `useful` helps no one. If some paths need one, the other paths decide.
  const double useful = least_useful(kind, options);
  const bool too_narrow = largest < useful;
  const std::optional<double> most_of_others = too_narrow ? least_from(useful, training) : std::nullopt;
  const double most = std::min(most_of_others.value_or(largest), cap(kind, options));
  const double upper = training.largest && (!most_of_others || most < cap(kind, options)) ? inside_share * most : most;
  const double least = without_margin(lower, training.smallest);
  training.feasible = !training.paths.empty() && !too_narrow && least <= most;
  training.radius = std::min(std::max(person, useful), upper);
  if (training.feasible && training.radius < lower) training.radius = lower <= upper ? lower : 0.5 * (least + most);
  training.support_radius = 0.0;
  const auto widest = std::max_element(evidence.carried_radius.begin(), evidence.carried_radius.end());
  if (widest != evidence.carried_radius.end() && training.radius < *widest)
    training.support_radius = std::min(options.support_max, evidence.least_support);
  // Only a larger body rolls up over uneven rims. Here the support disc must still exceed the body, or it would be no
  // support disc.
  if (training.support_radius > 0.0 && training.support_radius <= training.radius)
    training.support_radius = std::min(options.support_max, training.radius + support_margin);
  if (training.support_radius <= training.radius) training.support_radius = 0.0;
}

void describe_decisive(const Layout& layout, const Evidence& evidence, Training& training) {
  if (evidence.limiting_path) {
    const Passage& passage = layout.paths[*evidence.limiting_path].passage;
    training.narrowest = passage.opening.value_or(Opening{.width = 2.0 * passage.radius});
  }
  if (evidence.limiting_crack) training.widest = evidence.cracks[*evidence.limiting_crack];
}

}  // namespace

cracks::CrackOptions crack_options(const TrainOptions& options, const ways::Measure& measure) {
  cracks::CrackOptions how;
  how.step = options.step;
  how.knee = cracks::knee_height(options.step);
  how.smallest = std::max(cracks::smallest_disc, std::min(measure.narrowest, 0.5 * options.support_max));
  how.support_max = options.support_max;
  how.threads = options.threads;
  return how;
}

Evidence find_cracks(const Survey& survey, const TrainOptions& options, const Layout& layout, cracks::RimEdges& ahead,
                     Stages& stages) {
  Evidence evidence;
  if (options.mode != Mode::walk || layout.components.empty() || stages.ended()) return evidence;
  stages.begin(TrainStage::cracks);
  evidence.cracks = cracks_of(survey, options, layout, ahead, stages);
  evidence.complete = !stages.ended();
  evidence.carried_radius.assign(evidence.cracks.size(), 0.0);
  for (std::size_t i = 0; i < evidence.cracks.size(); ++i) {
    const cracks::FoundCrack& crack = evidence.cracks[i];
    if (crack.kind != Crack::Kind::crack) continue;
    if (crack.shallow_depth == 0.0) {
      note_width(crack, options, layout.measure.narrowest, evidence);
      const double rise = rise_of(survey, crack, layout.measure.step);
      // No support disc carries a body above its band; a body climbs higher rims by its step.
      evidence.carried_radius[i] =
          carried_from(crack.radius, rise > carrying_band ? 0.0 : rise, survey.slope_degrees());
    } else if (!evidence.shallow || crack.radius > evidence.cracks[*evidence.shallow].radius) {
      evidence.shallow = i;
    }
  }
  return evidence;
}

BodySize body_of_paths(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence,
                       const Crossings& crossings, const Layout& layout) {
  Training first;
  double carried = 0.0;
  for (const PlannedPath& planned : layout.paths) {
    const Passage& passage = planned.passage;
    TrainedPath& path = first.paths.emplace_back();
    if (passage.limited) path.largest = passage.radius;
    if (path.largest) first.largest = std::min(first.largest.value_or(passage.radius), passage.radius);
    for (const Crossing& crossing : crossings.on(passage.way)) {
      const cracks::FoundCrack& crack = evidence.cracks[crossing.crack];
      if (crack.kind != Crack::Kind::crack) continue;
      first.smallest = std::max(first.smallest, crack.radius);
      carried = std::max(carried, evidence.carried_radius[crossing.crack]);
    }
  }
  choose(kind, options, evidence, std::max(carried, carried_share * first.smallest), first);
  return {first.radius, first.support_radius};
}

void find_ends(const Survey& survey, const TrainOptions& options, Layout& layout, Evidence& evidence,
               Training& training) {
  Paths paths(survey, options, layout, training, evidence);
  if (!evidence.cracks.empty()) paths.cross_all();
  training.trapped_radius = trapped_below(training.smallest, options.step);
  describe_decisive(layout, evidence, training);
}

bool sinks_into(double radius, const Crack& crack) { return radius < carried_share * crack.radius; }

double trapped_below(double crack_radius, double step) {
  return crack_radius > step && step > 0.0 ? (crack_radius * crack_radius + step * step) / (2.0 * step) : 0.0;
}

double carried_on_paths(const Evidence& evidence, const Training& training) {
  const double level = carried_share * training.smallest;
  return evidence.hardest ? std::max(level, evidence.carried_radius[*evidence.hardest]) : level;
}

double least_on_paths(const Evidence& evidence, const Training& training) {
  return without_margin(carried_on_paths(evidence, training), training.smallest);
}

void choose_body(const ways::BodyKind& kind, const TrainOptions& options, const Evidence& evidence,
                 Training& training) {
  choose(kind, options, evidence, carried_on_paths(evidence, training), training);
}

void add_regions(const Survey& survey, const TrainOptions& options, const Layout& layout, Stages& stages,
                 Training& training) {
  stages.begin(TrainStage::beside_paths);
  const double least = least_useful(kind_of(survey, options), options);
  for (const Component& component : layout.components) {
    if (stages.ended()) return;
    const Rooms rooms = find_rooms(survey, layout.measure, layout.tree, component, training.radius);
    const std::vector<std::vector<Vec3>> ways = neck_ways(layout.tree, rooms);
    std::vector<Passage> openings(ways.size());
    tbb::parallel_for(std::size_t(0), ways.size(), [&](std::size_t i) {
      if (ways[i].size() > 1 && !stages.ended()) openings[i] = refine(survey, layout.measure, options.spacing, ways[i]);
    });
    if (stages.ended()) return;
    for (SizeRegion& region : make_regions(layout.measure, layout.tree, rooms, least, training.radius, openings)) {
      region.support_radius = training.support_radius;
      training.regions.push_back(std::move(region));
    }
  }
}

}  // namespace roam::training
