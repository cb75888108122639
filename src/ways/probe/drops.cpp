// Ways down steps that a body cannot climb back. The lattice has no such steps: its places are neighbours in both
// directions. So this joins parts of the lattice by drops.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "math/level_distance.h"
#include "roam/error.h"
#include "ways/lattice/walk_place.h"
#include "ways/probe/parts.h"
#include "ways/refine/stations.h"
#include "ways/trials/trials.h"

namespace roam::ways {
namespace {

constexpr double touch = 1e-3;                                     ///< m: levels that differ by less are equal
constexpr double rim_precision = 1e-3;                             ///< m: of a rim's position
constexpr std::size_t most_parts = 64;                             ///< of the lattice
constexpr int most_failures = 16;                                  ///< of ways to a drop, for each part
constexpr std::uint64_t first_growth = 20'000, growth_factor = 4;  ///< places of one part
constexpr NodeId places_between_checks = 256;

/// The feet before and after a drop.
struct Drop {
  Vec3 from{0.0}, to{0.0};
  NodeId near = no_node;  ///< the lattice place beside `from`
  /// The body moves level to this place, then down.
  [[nodiscard]] Vec3 over() const { return {to.x, to.y, from.z}; }
};

/// The search over one lattice, whose places have room for `narrowest`.
class Descent {
 public:
  Descent(const ProbeSearch& search, double narrowest, double radius, double deepest, std::uint64_t most_places)
      : search_(search),
        measure_(measure_of(search, narrowest)),
        spacing_(search.options.spacing),
        radius_(radius),
        deepest_(deepest),
        most_places_(most_places),
        tree_(search.survey, measure_, spacing_) {}

  /// Not found and not complete: a limit ended the search.
  WayDown run(const ProbeEnds& ends);
  /// After a search in vain: whether the lattice joins places between which the body has no room.
  [[nodiscard]] bool has_narrow_places() const { return has_narrow_places_; }

 private:
  /// A part of the lattice that is reached from the start.
  struct Part {
    NodeId root = no_node;
    Vec3 entry{0.0};
    std::size_t before = 0;  ///< the part from which the drop leads here; itself for the start's
    Passage leg;             ///< from that part's entry to the drop
    Drop drop;
  };

  static Measure measure_of(const ProbeSearch& search, double narrowest) {
    Measure measure = search.measure();
    measure.narrowest = narrowest;
    return measure;
  }
  void watch(std::uint64_t places) const;
  bool grow(NodeId root, std::uint64_t most, NodeId until);
  bool may_be_joined(NodeId start, NodeId target);
  template <class F>
  bool any_missing(NodeId root, const F& f) const;
  [[nodiscard]] bool has_floor_above(const Vec3& place, const Vec3& direction) const;
  [[nodiscard]] std::optional<double> floor_below(const Vec3& place) const;
  [[nodiscard]] bool is_drop(double from, double to) const { return to < from - measure_.step - touch; }
  [[nodiscard]] bool is_rim(const Vec3& place, const Vec3& beyond) const;
  [[nodiscard]] std::optional<Drop> drop_from(const Vec3& place, const Vec3& direction) const;
  [[nodiscard]] bool goes_down(const Drop& drop, double radius) const;
  [[nodiscard]] bool walked(const Drop& drop) const;
  [[nodiscard]] std::vector<Drop> drops_of(const Part& part, const Vec3& target) const;
  [[nodiscard]] Passage leg(const Vec3& from, const Vec3& to);
  [[nodiscard]] bool is_joined(NodeId one, NodeId other) const;
  void follow(std::size_t at, NodeId target, const Vec3& place);
  [[nodiscard]] WayDown joined(std::size_t last, const Passage& end) const;
  [[nodiscard]] Vec3 rim_of(const Drop& drop) const;

  const ProbeSearch& search_;
  const Measure measure_;
  const double spacing_, radius_, deepest_;
  const std::uint64_t most_places_;
  WidestTree tree_;
  std::vector<Part> parts_;
  bool has_narrow_places_ = false, ended_ = false;
};

void Descent::watch(std::uint64_t places) const {
  if (search_.question.progress && !search_.question.progress(places)) throw Cancelled();
}

/// Returns whether the growth is complete. It ends early at `until`.
bool Descent::grow(NodeId root, std::uint64_t most, NodeId until) {
  most += tree_.size();
  return tree_.grow(root, no_node, [&](std::uint64_t places) {
    watch(places);
    ended_ = ended_ || places >= most_places_;
    return !ended_ && places < most && (until == no_node || tree_.root(until) != root);
  });
}

/// Calls f(id, direction) for each place of the part and unit vector from it to a lattice point that is no neighbour,
/// until f returns true.
template <class F>
bool Descent::any_missing(NodeId root, const F& f) const {
  for (NodeId id = 0; id < static_cast<NodeId>(tree_.size()); ++id) {
    if (id % places_between_checks == 0) watch(tree_.size());
    if (tree_.root(id) != root) continue;
    const Vec3& place = tree_.node(id).place;
    const Neighbours neighbours = tree_.neighbours(id);
    for (int k = 0; k < 8; ++k) {
      const double angle = 0.25 * std::numbers::pi * k;
      const Vec3 direction(std::cos(angle), std::sin(angle), 0.0);
      const bool known = std::any_of(neighbours.begin(), neighbours.end(), [&](NodeId other) {
        const Vec3 run = tree_.node(other).place - place;
        return run.x * direction.x + run.y * direction.y > 0.95 * std::hypot(run.x, run.y);
      });
      if (!known && f(id, direction)) return true;
    }
  }
  return false;
}

/// Whether a floor from which a body steps down to `place` may lie in a direction.
bool Descent::has_floor_above(const Vec3& place, const Vec3& direction) const {
  for (double away = 0.5 * spacing_; away <= measure_.narrowest + 2.0 * spacing_; away += 0.5 * spacing_) {
    const Vec3 above = place + away * direction + Vec3(0.0, 0.0, deepest_ + touch);
    if (search_.survey.floor().first_impact({0.0, 0.0}, above, {0.0, 0.0, measure_.step - deepest_}).hit) return true;
  }
  return false;
}

/// The height of the floor at `place` or below, as far as the body goes down.
std::optional<double> Descent::floor_below(const Vec3& place) const {
  const Vec3 from = place + Vec3(0.0, 0.0, touch);
  const Impact down = search_.survey.floor().ray(from, {0.0, 0.0, -deepest_ - touch});
  return down.hit ? std::optional(down.point.z) : std::nullopt;
}

/// Whether the floor beyond a place is too low to climb back, but no lower than the body goes down.
bool Descent::is_rim(const Vec3& place, const Vec3& beyond) const {
  const auto floor = floor_below(beyond);
  return floor && is_drop(place.z, *floor);
}

bool Descent::goes_down(const Drop& drop, double radius) const {
  if (!goes_straight(search_.survey, measure_, drop.from, drop.over(), radius)) return false;
  const Vec3 down(0.0, 0.0, drop.to.z - drop.from.z);
  const Vec3 centre = centre_of(measure_, drop.over(), {radius, measure_.step});
  return !search_.survey.world().first_impact(body_of(measure_, radius), centre, down).hit;
}

std::optional<Drop> Descent::drop_from(const Vec3& place, const Vec3& direction) const {
  // Beside a place with the rim ahead lies a lattice point beyond the rim.
  if (!is_rim(place, place + spacing_ * direction)) return std::nullopt;
  const double reach = lattice_error * spacing_;
  const auto with_room = [&](const Vec3& foot) {
    Station here = station_at(search_.survey, measure_, foot);
    if (here.free < radius_ && here.free > 0.0) here = widest_beside(search_.survey, measure_, here, direction, reach);
    return here.free >= radius_ ? std::optional(here.place) : std::nullopt;
  };
  const auto from = with_room(place);
  if (!from) return std::nullopt;
  // On steep stairs the body goes down several at once.
  double level = from->z;
  for (double away = 0.5 * spacing_; away <= 2.0 * (radius_ + spacing_); away += 0.5 * spacing_) {
    const Vec3 there = *from + away * direction;
    const auto floor = floor_below({there.x, there.y, level});
    if (!floor) continue;
    level = std::min(level, *floor);
    if (!is_drop(from->z, *floor)) continue;
    const auto to = with_room({there.x, there.y, *floor});
    if (to && goes_down({*from, *to}, radius_)) return Drop{*from, *to};
  }
  return std::nullopt;
}

/// Whether a walker that steps off the rim comes to the other floor without a fall.
bool Descent::walked(const Drop& drop) const {
  const BodyKind kind{
      .height = search_.options.height, .step = measure_.step, .slope_degrees = search_.survey.slope_degrees()};
  const std::array way{drop.from, drop.over(), drop.to};
  return try_way(search_.survey, kind, radius_, search_.question.support_radius, way).outcome == Outcome::reached;
}

/// The drops of a part, those on a short way to `target` first.
std::vector<Drop> Descent::drops_of(const Part& part, const Vec3& target) const {
  std::vector<Drop> drops;
  any_missing(part.root, [&](NodeId id, const Vec3& direction) {
    if (const auto drop = drop_from(tree_.node(id).place, direction)) drops.push_back({drop->from, drop->to, id});
    return false;
  });
  const auto length = [&](const Drop& drop) {
    return glm::distance(part.entry, drop.from) + glm::distance(drop.to, target);
  };
  std::stable_sort(drops.begin(), drops.end(), [&](const Drop& a, const Drop& b) { return length(a) < length(b); });
  return drops;
}

Passage Descent::leg(const Vec3& from, const Vec3& to) {
  ProbeQuestion question = search_.question;
  question.from = from;
  question.to = to;
  Passage way = ProbeSearch{search_.survey, question, search_.options}.widest();
  const bool is_wide = way.found && way.radius >= radius_;
  if (is_wide) return way;
  ended_ = ended_ || !way.complete;
  has_narrow_places_ = true;
  return {};
}

/// Whether the body goes from one place of a part to another, by the widths of the lattice.
bool Descent::is_joined(NodeId one, NodeId other) const {
  const std::vector<NodeId> way = tree_.way(one, other);
  return !way.empty() &&
         std::all_of(way.begin(), way.end(), [&](NodeId id) { return tree_.node(id).clearance >= radius_; });
}

/// Adds the parts to which drops lead.
void Descent::follow(std::size_t at, NodeId target, const Vec3& place) {
  struct Failure {
    Drop drop;
    NodeId root = no_node;  ///< of the part below
    bool walked = false;    ///< then no way leads to the drop
  };
  std::vector<Failure> failures;
  for (const Drop& drop : drops_of(parts_[at], place)) {
    const auto seed = tree_.seed(drop.to);
    if (!seed) continue;
    const NodeId root = tree_.root(*seed) == no_node ? *seed : tree_.root(*seed);
    if (std::any_of(parts_.begin(), parts_.end(), [&](const Part& part) { return part.root == root; })) continue;
    // Beside a drop that failed, and where the body would come from its rim, others fail too.
    const bool fails = std::any_of(failures.begin(), failures.end(), [&](const Failure& failed) {
      return (failed.root == root && glm::distance(failed.drop.from, drop.from) < 2.0 * radius_) ||
             (failed.walked && is_joined(failed.drop.near, drop.near));
    });
    if (fails) continue;
    ended_ = ended_ || parts_.size() >= most_parts || failures.size() >= most_failures;
    if (ended_) return;
    const bool goes = walked(drop);
    Passage way = goes ? leg(parts_[at].entry, drop.from) : Passage{};
    if (!way.found) {
      failures.push_back({drop, root, goes});
      continue;
    }
    grow(root, std::numeric_limits<std::uint32_t>::max(), no_node);
    parts_.push_back({root, drop.to, at, std::move(way), drop});
    if (ended_ || tree_.root(target) == root) return;
  }
}

/// Grows both parts until one is complete, so that an end in a closet does not cost a search of the whole scene.
/// Returns whether the ends belong to two parts, and drops may lead from the one and to the other.
bool Descent::may_be_joined(NodeId start, NodeId target) {
  const auto leads = [&](NodeId id, const Vec3& direction) {
    const Vec3& place = tree_.node(id).place;
    return is_rim(place, place + spacing_ * direction);
  };
  const auto is_led_to = [&](NodeId id, const Vec3& direction) {
    return has_floor_above(tree_.node(id).place, direction);
  };
  const auto are_two = [&] {
    has_narrow_places_ = tree_.root(target) == tree_.root(start);
    return !has_narrow_places_;
  };
  for (std::uint64_t most = first_growth;; most *= growth_factor) {
    const bool whole = grow(start, most, target);
    if (ended_ || !are_two()) return false;
    if (whole) return any_missing(start, leads);
    const bool target_whole = grow(target, most, start);
    if (ended_ || !are_two()) return false;
    if (!target_whole) continue;
    return any_missing(target, is_led_to) && grow(start, std::numeric_limits<std::uint32_t>::max(), target) &&
           are_two();
  }
}

/// The place where the floor ends.
Vec3 Descent::rim_of(const Drop& drop) const {
  double floor = 0.0, air = 1.0;
  const Vec3 run = drop.over() - drop.from;
  const double precision = rim_precision / std::max(glm::length(run), rim_precision);
  while (air - floor > precision) {
    const double middle = 0.5 * (floor + air);
    (is_rim(drop.from, drop.from + middle * run) ? air : floor) = middle;
  }
  return drop.from + floor * run;
}

WayDown Descent::joined(std::size_t last, const Passage& end) const {
  std::vector<const Part*> order;
  for (std::size_t at = last; parts_[at].before != at; at = parts_[at].before) order.push_back(&parts_[at]);
  WayDown found;
  Passage& passage = found.passage;
  passage.found = true;
  passage.radius = std::numeric_limits<double>::infinity();
  passage.bound = std::numeric_limits<double>::infinity();
  const auto add = [&](const Passage& leg) {
    passage.way.insert(passage.way.end(), leg.way.begin(), leg.way.end());
    passage.complete = passage.complete && leg.complete;
    passage.places += leg.places;
    if (leg.radius >= passage.radius) return;
    passage.radius = leg.radius;
    passage.limited = leg.limited;
    passage.opening = leg.opening;
  };
  for (auto part = order.rbegin(); part != order.rend(); ++part) {
    add((*part)->leg);
    passage.way.push_back((*part)->drop.over());
    found.drops.push_back({rim_of((*part)->drop), (*part)->drop.from, (*part)->drop.to});
  }
  add(end);
  passage.places += tree_.size();
  for (const Part* part : order) {
    while (passage.radius > radius_ && !goes_down(part->drop, passage.radius)) {
      passage.radius = passage.radius > radius_ + touch ? 0.5 * (passage.radius + radius_) : radius_;
      passage.limited = true;
      passage.opening.reset();
    }
  }
  for (std::size_t i = 1; i < passage.way.size(); ++i)
    passage.length += glm::distance(passage.way[i - 1], passage.way[i]);
  return found;
}

WayDown Descent::run(const ProbeEnds& ends) {
  const auto start = tree_.seed(ends.start), target = tree_.seed(ends.target);
  if (start && target && may_be_joined(*start, *target)) parts_.push_back({*start, ends.start, 0, {}, {}});
  for (std::size_t at = 0; at < parts_.size() && !ended_; ++at) {
    if (tree_.root(*target) == parts_[at].root) {
      const Passage end = leg(parts_[at].entry, ends.target);
      if (end.found) return joined(at, end);
    } else {
      follow(at, *target, ends.target);
    }
  }
  WayDown none;
  none.passage.complete = !ended_ && !tree_.is_cut();
  none.passage.places = tree_.size();
  return none;
}

}  // namespace

WayDown way_down(const ProbeSearch& search, const ProbeEnds& ends, double radius, double deepest) {
  if (search.options.mode != Mode::walk || deepest <= search.options.step + touch) return {};
  for (const Vec3& end : {ends.start, ends.target}) {
    if (clearance_at(search.survey, search.measure(), end) < radius) return {};
  }
  // A lattice may underestimate widths: places with less room may belong to a way. If these join places by a way that
  // is too narrow, only places with room for the body count.
  const double narrower = std::max(search.options.narrowest, radius - lattice_error * search.options.spacing);
  const std::uint64_t most = search.options.most_places;
  WayDown none;
  for (const double narrowest : {narrower, radius}) {
    Descent descent(search, narrowest, radius, deepest, most - std::min(most, none.passage.places));
    WayDown way = descent.run(ends);
    if (way.passage.found) return way;
    none.passage.places += way.passage.places;
    none.passage.complete = none.passage.complete && way.passage.complete;
    if (!descent.has_narrow_places()) break;
  }
  return none;
}

}  // namespace roam::ways
