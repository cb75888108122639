#include "training/confirm.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "math/level_distance.h"
#include "training/crossings.h"
#include "training/judgement.h"
#include "training/over_gap.h"
#include "ways/trials/on_way.h"

namespace roam::training {
namespace {

/// How often the ways are planned again, at most.
constexpr int most_rounds = 12;
/// New places that the search for a way around may make.
constexpr std::uint64_t most_new_places = 100'000;
/// m: a way that rises by more at the stop is a climb. Then places at its top are closed, within this height above and
/// below.
constexpr double climbs = 0.1;
/// A closed place grows by this factor each time that the way is stopped nearby, up to most_shut metres.
constexpr double growth = 1.6;
constexpr double most_shut = 2.0;

/// A body that is stopped at a crack grows by this factor, most_larger times; then it gets a support disc.
constexpr double larger = 1.08;
constexpr int most_larger = 2;
/// A body larger than the radius that the rims carry by this factor is not stopped by them.
constexpr double unhindered = 1.25;
/// m: a body stopped within this distance and its radius of a gap may have been stopped by it.
constexpr double beside_gap = 0.2;

/// A closed part of the lattice: a disc, seen from above, at one level.
struct Shut {
  Vec3 place{0.0};
  double reach = 0.0;
  double level = 0.0;  ///< m above and below
  [[nodiscard]] bool holds(const Vec3& p) const {
    return level_distance(p, place) <= reach && std::abs(p.z - place.z) <= level;
  }
};

/// A stop of a walker.
struct Stop {
  Trial trial;
  double along = 0.0;                ///< m of the way
  std::optional<std::size_t> crack;  ///< the crack that stopped it
};

/// The attempts on one path.
struct Tries {
  std::vector<ways::NodeId> nodes;
  std::vector<Shut> shut;
  std::optional<Stop> stop;
  BodySize walked;    ///< the body that got through
  bool gone = false;  ///< no way is left
};

class Confirmation {
 public:
  Confirmation(const Survey& survey, const TrainOptions& options, const ways::BodyKind& kind, Evidence& evidence,
               Layout& layout, Stages& stages)
      : survey_(survey),
        options_(options),
        kind_(kind),
        evidence_(evidence),
        layout_(layout),
        stages_(stages),
        crossings_(survey, evidence.cracks, layout.measure.narrowest) {}

  void run() {
    std::vector<Tries> tries(layout_.paths.size());
    for (std::size_t i = 0; i < tries.size(); ++i)
      tries[i].nodes = layout_.tree.way(layout_.paths[i].ends.from, layout_.paths[i].ends.to);
    for (int round = 0; walk_all(tries) && !stages_.ended(); ++round) {
      if (try_other_bodies(tries)) {
        --round;
        continue;
      }
      for (std::size_t i = 0; i < tries.size(); ++i)
        if (tries[i].stop) go_round(layout_.paths[i], tries[i], round < most_rounds);
      plan_again(tries);
      take_out(tries);
      stages_.at(std::min(1.0, static_cast<double>(round) / most_rounds));
    }
  }

 private:
  /// Sends the body of the paths along each path that it has not walked yet. Returns false if no walker was stopped.
  bool walk_all(std::vector<Tries>& tries) {
    const BodySize body = body_of_paths(kind_, options_, evidence_, crossings_, layout_);
    tbb::parallel_for(std::size_t(0), tries.size(), [&](std::size_t i) {
      Tries& t = tries[i];
      PlannedPath& path = layout_.paths[i];
      // A path that is too narrow for that body gets one that fits.
      BodySize fitting = body;
      if (path.passage.limited && path.passage.radius < body.radius)
        fitting.radius = inside_share * path.passage.radius;
      if (path.walked && BodySize{path.walked->radius, path.walked->support_radius} == fitting) t.walked = fitting;
      if (t.walked == fitting) t.stop.reset();  // that was another body's stop
      if (stages_.ended() || t.walked == fitting) return;
      t.stop = stop_on(path, fitting);
      if (!t.stop) t.walked = fitting;
    });
    return std::any_of(tries.begin(), tries.end(), [](const Tries& t) { return t.stop.has_value(); });
  }

  /// For each crack that stopped a walker, raises its Evidence::carried_radius, or demands a support disc, a limited
  /// number of times. If nothing helps, restores the old value. Returns whether there is another body to send.
  bool try_other_bodies(std::vector<Tries>& tries) {
    std::set<std::size_t> cracks;
    for (const Tries& t : tries)
      if (t.stop && t.stop->crack) cracks.insert(*t.stop->crack);
    for (const std::size_t crack : cracks) {
      double& carried = evidence_.carried_radius[crack];
      const auto [attempts, is_new] = attempts_.try_emplace(crack, Attempts{carried, 0});
      ++attempts->second.times;
      if (attempts->second.times <= most_larger) {
        carried *= larger;
      } else if (attempts->second.times == most_larger + 1) {
        carried = std::numeric_limits<double>::infinity();
      } else {
        carried = attempts->second.before;
      }
    }
    for (Tries& t : tries) {
      if (!t.stop || !t.stop->crack) continue;
      t.stop.reset();
      t.walked = {};
    }
    return !cracks.empty();
  }

  /// The crack near a body that stops between two places of a way.
  [[nodiscard]] std::optional<std::size_t> crack_at(const std::vector<Vec3>& way, double from, double to,
                                                    const BodySize& body) const {
    for (const Crossing& crossing : crossings_.on(way)) {
      if (!may_change(crossing.crack, body)) continue;
      const double radius = evidence_.cracks[crossing.crack].radius;
      const auto gap = gap_on(survey_, way, crossing.at, radius, layout_.measure.step);
      if (gap && to >= gap->from - body.radius - beside_gap && from <= gap->to + body.radius + beside_gap)
        return crossing.crack;
    }
    return std::nullopt;
  }

  /// Whether Evidence::carried_radius of the crack that stopped such a body may still change.
  [[nodiscard]] bool may_change(std::size_t crack, const BodySize& body) const {
    const cracks::FoundCrack& found = evidence_.cracks[crack];
    const auto attempts = attempts_.find(crack);
    const bool given_up = attempts != attempts_.end() && attempts->second.times > most_larger + 1;
    return found.kind == Crack::Kind::crack && found.shallow_depth == 0.0 && !given_up &&
           (body.support_radius < found.radius || attempts != attempts_.end()) &&
           (attempts != attempts_.end() || body.radius < unhindered * evidence_.carried_radius[crack]);
  }

  /// The place where a body is stopped on its way back, up over a gap that it came down over.
  [[nodiscard]] std::optional<Stop> stop_back(const std::vector<Vec3>& way, const BodySize& body) const {
    for (const Crossing& crossing : crossings_.on(way)) {
      if (!may_change(crossing.crack, body)) continue;
      const double radius = evidence_.cracks[crossing.crack].radius;
      const auto gap = gap_on(survey_, way, crossing.at, radius, layout_.measure.step);
      if (!gap) continue;
      const std::vector<Vec3> back = back_over(survey_, way, *gap, body.radius, layout_.measure.step);
      if (back.empty()) continue;
      const Trial trial =
          try_way(survey_, kind_, body.radius, body.support_radius, back, [this] { return !stages_.ended(); });
      if (trial.outcome != Outcome::reached) return Stop{trial, gap->to, crossing.crack};
    }
    return std::nullopt;
  }

  /// The place where a body is stopped or falls. None if it gets through, which is recorded in `path`, or if it sinks
  /// into a shallow trench.
  [[nodiscard]] std::optional<Stop> stop_on(PlannedPath& path, const BodySize& body) const {
    const Passage& passage = path.passage;
    const auto tried = [&](const std::vector<Vec3>& way) {
      return try_way(survey_, kind_, body.radius, body.support_radius, way, [this] { return !stages_.ended(); });
    };
    Stop stop{.trial = tried(passage.way), .crack = {}};
    if (stop.trial.outcome == Outcome::reached) {
      std::optional<Stop> back = stop_back(passage.way, body);
      if (!back) path.walked = stop.trial;
      return back;
    }
    if (sinks_into_shallow(passage.way, body.radius)) return std::nullopt;
    stop.along = ways::nearest_on(passage.way, feet(stop.trial), kind_.mode).along;
    if (judged(stop.trial.outcome) != Judgement::flies_off) {
      if (stop.trial.outcome == Outcome::blocked) stop.crack = crack_at(passage.way, stop.along, stop.along, body);
      return stop;
    }
    // Finds the place where it left the level of the way, not the one where it came to rest.
    double goes = 0.0, falls = passage.length;
    while (falls - goes > 0.5 * options_.spacing && !stages_.ended()) {
      const double half = 0.5 * (goes + falls);
      (tried(stretch(passage.way, 0.0, half)).outcome == Outcome::reached ? goes : falls) = half;
    }
    stop.along = goes;
    stop.crack = crack_at(passage.way, goes, falls, body);
    return stop;
  }

  /// No support disc bridges such a trench; the result reports it.
  [[nodiscard]] bool sinks_into_shallow(const std::vector<Vec3>& way, double radius) const {
    const std::vector<Crossing> on = crossings_.on(way);
    return std::any_of(on.begin(), on.end(), [&](const Crossing& crossing) {
      const cracks::FoundCrack& crack = evidence_.cracks[crossing.crack];
      return crack.kind == Crack::Kind::crack && crack.shallow_depth > 0.0 && sinks_into(radius, crack);
    });
  }

  [[nodiscard]] Vec3 feet(const Trial& trial) const {
    const double height = kind_.height > 0.0 ? kind_.height : 2.0 * trial.radius;
    return trial.at - Vec3(0.0, 0.0, 0.5 * height);
  }

  /// Closes the lattice where the walker was stopped, and searches for another way.
  void go_round(const PlannedPath& path, Tries& t, bool may_try) {
    t.gone = true;
    if (!may_try || t.stop->trial.outcome == Outcome::held) return;
    shut_at(path.passage, t);
    const Vec3 end = layout_.tree.node(path.ends.to).place;
    const auto blocked = [&](const ways::Node& node) {
      return node.place != end &&
             std::any_of(t.shut.begin(), t.shut.end(), [&](const Shut& s) { return s.holds(node.place); });
    };
    const std::uint64_t most = layout_.tree.size() + most_new_places;
    t.nodes = layout_.tree.way_round(path.ends.from, path.ends.to, blocked, 0.0,
                                     [&](std::uint64_t places) { return places < most && !stages_.ended(); });
    t.gone = t.nodes.size() < 2;
  }

  void shut_at(const Passage& passage, Tries& t) const {
    const double spacing = options_.spacing, from = t.stop->along, ahead = t.stop->trial.radius + spacing;
    const Vec3 behind = place_on(passage.way, from - spacing);
    Vec3 top = behind;
    for (double at = 0.0; at <= ahead; at += 0.25 * spacing) {
      const Vec3 place = place_on(passage.way, from + at);
      if (place.z > top.z + 0.2 * climbs) top = place;
    }
    const bool up = top.z - behind.z > climbs;
    Shut shut{up ? top : place_on(passage.way, from + 0.5 * ahead), (up ? 1.5 : 1.0) * spacing,
              up ? climbs : layout_.measure.step};
    const double most = up ? most_shut : 3.0 * spacing;
    for (const Shut& other : t.shut) {
      if (level_distance(other.place, shut.place) <= other.reach + 2.0 * spacing &&
          std::abs(other.place.z - shut.place.z) <= shut.level)
        shut.reach = std::max(shut.reach, std::min(most, growth * other.reach));
    }
    t.shut.push_back(shut);
    // At least one place of the way itself is closed.
    if (t.nodes.size() < 3) return;
    const auto apart = [&](ways::NodeId id) { return glm::distance(layout_.tree.node(id).place, shut.place); };
    const ways::NodeId nearest = *std::min_element(t.nodes.begin() + 1, t.nodes.end() - 1,
                                                   [&](ways::NodeId a, ways::NodeId b) { return apart(a) < apart(b); });
    t.shut.push_back({layout_.tree.node(nearest).place, 0.01 * spacing, climbs});
  }

  void plan_again(std::vector<Tries>& tries) {
    tbb::parallel_for(std::size_t(0), tries.size(), [&](std::size_t i) {
      Tries& t = tries[i];
      if (!t.stop || t.gone || stages_.ended()) return;
      Passage passage = plan_along(survey_, layout_, options_.spacing, t.nodes);
      // A way around that is too narrow for the stopped body does not help it.
      const bool enough = passage.found && !(passage.limited && passage.radius < t.stop->trial.radius);
      t.gone = !enough || passage.way.size() < 2;
      if (t.gone) return;
      layout_.paths[i].passage = std::move(passage);
      layout_.paths[i].is_widest = false;
      layout_.paths[i].walked.reset();
      t.walked = {};
      t.stop.reset();
    });
  }

  void take_out(std::vector<Tries>& tries) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < tries.size(); ++i) {
      if (tries[i].gone) {
        const Passage& p = layout_.paths[i].passage;
        const Trial& last = tries[i].stop->trial;
        layout_.unwalked.push_back({layout_.paths[i].ends, p.way.front(), p.way.back(), last, feet(last)});
        continue;
      }
      if (kept != i) {
        tries[kept] = std::move(tries[i]);
        layout_.paths[kept] = std::move(layout_.paths[i]);
      }
      ++kept;
    }
    tries.resize(kept);
    layout_.paths.resize(kept);
  }

  const Survey& survey_;
  const TrainOptions& options_;
  const ways::BodyKind& kind_;
  Evidence& evidence_;
  Layout& layout_;
  Stages& stages_;
  const Crossings crossings_;
  /// The attempts at one crack.
  struct Attempts {
    double before = 0.0;  ///< Evidence::carried_radius, before
    int times = 0;
  };
  std::map<std::size_t, Attempts> attempts_;
};

}  // namespace

void confirm_paths(const Survey& survey, const TrainOptions& options, const ways::BodyKind& kind, Evidence& evidence,
                   Layout& layout, Stages& stages) {
  stages.begin(TrainStage::walking);
  Confirmation(survey, options, kind, evidence, layout, stages).run();
  if (layout.unwalked.empty() || stages.ended()) return;
  // Draws other ends, once, in components whose ends could not be walked to.
  const std::size_t before = layout.paths.size();
  for (std::size_t i = 0; i < layout.components.size(); ++i) {
    const std::vector<ways::NodeId>& nodes = layout.components[i].nodes;
    const auto count = std::count_if(layout.unwalked.begin(), layout.unwalked.end(), [&](const Unwalked& u) {
      return std::binary_search(nodes.begin(), nodes.end(), u.ends.from);
    });
    if (count == 0) continue;
    for (const Ends& ends : draw_paths(layout.tree, layout.components[i], layout.rooms[i], static_cast<int>(count),
                                       options.seed + i + layout.components.size())) {
      Passage passage = plan_path(survey, layout, options.spacing, ends);
      if (passage.found && passage.way.size() > 1) layout.paths.push_back({ends, std::move(passage)});
    }
  }
  if (layout.paths.size() > before) Confirmation(survey, options, kind, evidence, layout, stages).run();
}

}  // namespace roam::training
