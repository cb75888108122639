#include "roam/passage.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <utility>

#include "math/parallel_floating_point.h"
#include "ways/flight/way.h"
#include "ways/lattice/walk_place.h"
#include "ways/passage/ends.h"
#include "ways/refine/refine.h"

namespace roam {
namespace {

using namespace ways;

/// Searches for ways through other openings, at most.
constexpr int most_others = 32;
/// Metres: widths that differ by less are equal.
constexpr double same_width = 1e-3;
/// Metres: a bound as near as this to the radius proves it.
constexpr double proof = 5e-3;

[[noreturn]] void refuse(const std::string& what) { throw Error("cannot look for a way: " + what); }

void check(const Vec3& from, const Vec3& to, const PassageOptions& o) {
  const auto positive = [](double value, const char* what) {
    if (!(value > 0.0 && value <= Space::reach_limit))
      refuse(fmt::format("{} is {} m; it must be more than 0 and at most 1000 m", what, value));
  };
  for (const auto& [end, p] : {std::pair("start", from), std::pair("end", to)}) {
    for (int k = 0; k < 3; ++k)
      if (!(std::abs(p[k]) <= coordinate_limit))
        refuse(fmt::format("its {} is ({:g}, {:g}, {:g}); it must be a point within 1e9 m of the origin", end, p.x, p.y,
                           p.z));
  }
  if (o.mode == Mode::ghost) refuse("a ghost passes everything; say walk or fly");
  positive(o.widest, "the widest radius");
  positive(o.narrowest, "the narrowest radius");
  if (!(o.spacing >= least_spacing && o.spacing <= Space::reach_limit))
    refuse(fmt::format("the spacing is {} m; it must be at least {} and at most {} m", o.spacing, least_spacing,
                       Space::reach_limit));
  positive(o.support_max, "the largest support disc");
  if (!(o.narrowest < o.widest)) refuse("the narrowest radius must be less than the widest");
  if (o.mode == Mode::fly) return;
  if (!(o.step >= 0.0 && o.step <= Space::reach_limit)) refuse("the step must be between 0 and 1000 m");
  if (o.height == 0.0) return;
  if (!(o.height >= o.step + 2.0 * o.narrowest && o.height <= Space::reach_limit))
    refuse(fmt::format("a body {} m high leaves no room above the step for the narrowest radius", o.height));
}

Vec3 end_at(const Survey& survey, const Measure& measure, const Vec3& point) {
  const auto place = free_end(survey, measure, point);
  if (place) return *place;
  refuse(fmt::format(
      "no body with a radius of {} m fits at ({}, {}, {}) or within sight of it; choose a place with free space "
      "around it{}",
      measure.narrowest, point.x, point.y, point.z, measure.mode == Mode::walk ? " and floor below" : ""));
}

/// The budget that all searches for one passage share.
class Budget {
 public:
  explicit Budget(const PassageOptions& options) : options_(options) {}

  /// Whether a search goes on. `places`: those that it has made so far.
  bool goes_on(std::uint64_t places) {
    places += before_;
    ended_ = ended_ || places >= options_.most_places || (options_.progress && !options_.progress(places));
    return !ended_;
  }
  [[nodiscard]] bool ended() const { return ended_; }
  /// Ends a search. Returns the places of all searches so far.
  std::uint64_t add(std::uint64_t places) { return before_ += places; }

 private:
  const PassageOptions& options_;
  std::uint64_t before_ = 0;
  bool ended_ = false;
};

/// One search on foot with one step.
class Search {
 public:
  Search(const Survey& survey, const PassageOptions& options, const Measure& measure, Budget& budget)
      : survey_(survey),
        options_(options),
        measure_(measure),
        budget_(budget),
        tree_(survey, measure, options.spacing) {}

  Passage run(const Vec3& from, const Vec3& to) {
    from_ = end_at(survey_, measure_, from);
    to_ = end_at(survey_, measure_, to);
    const auto a = tree_.seed(from_), b = tree_.seed(to_);
    Passage best;
    best.bound = end_bound();
    if (a && b) {
      const bool joined = grow_together(*a, *b);
      const std::vector<NodeId> way = joined ? tree_.way(*a, *b) : std::vector<NodeId>{};
      if (!way.empty()) {
        best = refined(way);
        others(*a, *b, way, best);
      } else if (!budget_.ended()) {
        best.opening = gap_between(tree_, *a, *b);
        only_floor_separates_ = best.opening && only_floor_separates(survey_, measure_, tree_, *a, *b);
      }
    }
    best.proven = best.found && best.bound - best.radius <= proof;
    best.complete = !budget_.ended() && !tree_.is_cut();
    best.places = budget_.add(tree_.size());
    return best;
  }
  /// If the lattice lies badly, a search may find steep stairs, or a gap below a sill, from one end only. If walls
  /// separate the ends everywhere, a search from the other end is useless.
  [[nodiscard]] bool may_be_found_from_other_end() const { return only_floor_separates_; }

 private:
  /// Clearance at the ends, and the height, bound every way. A sphere that may lift has no such bound: a larger one may
  /// fit.
  [[nodiscard]] double end_bound() const {
    constexpr double rounding = 1e-4;  // m: of a clearance
    constexpr double unknown = std::numeric_limits<double>::infinity();
    if (measure_.height == 0.0) return unknown;
    const double limit = largest_radius(measure_);
    const double ends = std::min(clearance_at(survey_, measure_, from_), clearance_at(survey_, measure_, to_));
    if (ends < limit) return ends + rounding + survey_.world().largest_error();
    return limit < measure_.widest ? limit : unknown;
  }
  /// Grows from both ends in turn, four times as far each time, until they meet or one end's reach is exhausted. So an
  /// end in a closet does not cost a search of the whole scene. Returns whether they meet.
  bool grow_together(NodeId a, NodeId b) {
    constexpr std::uint64_t first = 20'000;
    constexpr std::uint64_t factor = 4;
    std::uint64_t budget = first;
    const auto grows_whole = [&](NodeId root, NodeId until) {
      const std::uint64_t most = tree_.size() + budget;
      return tree_.grow(root, until, [&](std::uint64_t places) { return goes_on()(places) && places < most; });
    };
    for (;; budget *= factor) {
      for (const auto& [root, until] : {std::pair(a, b), std::pair(b, a)}) {
        const bool whole = grows_whole(root, until);
        if (tree_.root(until) == tree_.root(root)) return true;
        if (budget_.ended()) return false;
        if (!whole) continue;
        // Grows the other side as far, to find where the two come nearest.
        (void)grows_whole(until, root);
        return false;
      }
    }
  }
  [[nodiscard]] std::function<bool(std::uint64_t)> goes_on() {
    return [this](std::uint64_t places) { return budget_.goes_on(places); };
  }
  [[nodiscard]] Passage refined(const std::vector<NodeId>& way) const {
    std::vector<Vec3> places{from_};
    for (const NodeId id : way) places.push_back(tree_.node(id).place);
    places.push_back(to_);
    Passage passage = refine(survey_, measure_, options_.spacing, places);
    passage.bound = end_bound();
    return passage;
  }
  /// Searches ways around the openings found so far, as long as one may be wider.
  void others(NodeId a, NodeId b, const std::vector<NodeId>& first, Passage& best) {
    // All ways share these ends, so this bounds their width.
    const double most = std::min(clearance_at(survey_, measure_, from_), clearance_at(survey_, measure_, to_));
    std::vector<Opening> found;
    std::vector<NodeId> before = first;
    Passage last = best;
    while (last.limited && last.opening && best.limited && best.radius + proof < best.bound &&
           best.radius + same_width < most && !budget_.ended() && found.size() < most_others) {
      found.push_back(*last.opening);
      const double around = best.radius + options_.spacing;
      // A way through an opening has a lattice place this narrow there. Wider places beside the opening stay open.
      const double narrow = std::hypot(best.radius, lattice_error * options_.spacing) + same_width;
      const auto blocked = [&](const Node& node) {
        return node.clearance < narrow && std::any_of(found.begin(), found.end(), [&](const Opening& o) {
                 const Vec3 off = o.point - node.place;
                 const double above = std::max(off.z - tall(), std::min(0.0, off.z));
                 return std::hypot(off.x, off.y) < around && std::abs(above) < around;
               });
      };
      const double least = std::max(measure_.narrowest, best.radius - lattice_error * options_.spacing);
      std::vector<NodeId> way = tree_.way_round(a, b, blocked, least, goes_on());
      if (way.empty() || way == before) return;
      last = refined(way);
      before = std::move(way);
      if (last.found && last.radius > best.radius) best = last;
    }
  }
  [[nodiscard]] double tall() const { return measure_.height > 0.0 ? measure_.height : 2.0 * measure_.widest; }

  const Survey& survey_;
  const PassageOptions& options_;
  const Measure measure_;
  Budget& budget_;
  WidestTree tree_;
  Vec3 from_{0.0}, to_{0.0};
  bool only_floor_separates_ = false;
};

Passage reversed(Passage passage) {
  std::reverse(passage.way.begin(), passage.way.end());
  if (passage.opening) passage.opening->direction = -passage.opening->direction;
  return passage;
}

Passage found_way(const Survey& survey, const Vec3& from, const Vec3& to, const PassageOptions& options) {
  check(from, to, options);
  Measure measure{options.mode,      options.mode == Mode::fly ? 0.0 : options.height,
                  options.step,      options.widest,
                  options.narrowest, options.support_max};
  if (options.mode == Mode::fly) {
    const Vec3 first = end_at(survey, measure, from), last = end_at(survey, measure, to);
    Passage passage =
        widest_flight(survey, measure, first, last, {options.spacing, options.most_places, options.progress});
    passage.proven = passage.found && passage.bound - passage.radius <= proof;
    return passage;
  }
  const bool rolls = options.height == 0.0;
  if (rolls) measure.step = std::min(options.step, options.widest);
  Budget budget(options);
  const auto search = [&] {
    std::optional<Search> there(std::in_place, survey, options, measure, budget);
    Passage passage = there->run(from, to);
    const bool again = there->may_be_found_from_other_end();
    there.reset();  // one tree in memory at a time
    if (!again) return passage;
    Passage back = Search(survey, options, measure, budget).run(to, from);
    if (back.found) return reversed(std::move(back));
    passage.complete = back.complete;
    passage.places = back.places;
    return passage;
  };
  for (;;) {
    Passage passage = search();
    // A sphere climbs at most its radius. Repeat with the found radius as step until both agree: a smaller step never
    // gives a larger radius.
    constexpr double same_step = 1e-4;
    if (!rolls || !passage.found || passage.radius >= measure.step - same_step) return passage;
    measure.step = passage.radius;
  }
}

}  // namespace

Passage widest_way(const Survey& survey, const Vec3& from, const Vec3& to, const PassageOptions& options) {
  return in_default_floating_point([&] { return found_way(survey, from, to, options); });
}

}  // namespace roam
