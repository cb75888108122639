#include "roam/probe.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <list>
#include <map>

#include "math/boxes.h"
#include "math/floating_point.h"
#include "math/level_distance.h"
#include "math/parallel_floating_point.h"
#include "math/step_limit.h"
#include "motion/carrying.h"
#include "roam/standing.h"
#include "text/names.h"
#include "ways/probe/parts.h"
#include "ways/trials/on_way.h"
#include "ways/trials/trials.h"

namespace roam {

using namespace ways;

namespace {

/// Metres, and radii of the body: wider ways are not distinguished.
constexpr double wide = 1.0;
constexpr double wide_times = 1.25;
/// The narrowest ways searched for the opening that stops the body: metres, and parts of its radius.
constexpr double narrow = 0.05;
constexpr double narrow_part = 0.5;
/// Radii beyond the scene's box. At one there is no contact; beyond two a route counts as having left the scene.
constexpr double beside_scene = 1.9;

/// Metres: widths that differ by less are equal.
constexpr double same_width = 1e-3;

/// Metres. A body with less between its half balls is searched as a sphere: a knee leaves it no room.
constexpr double least_cylinder = 5e-3;

bool is_sphere(const ProbedSize& size) { return size.height <= 2.0 * size.radius; }
bool rolls(const ProbedSize& size) { return size.height < 2.0 * size.radius + least_cylinder; }

/// The half width (m) of the widest crack with level rims that carries such a body.
double spanned(const ProbeQuestion& question, double radius) {
  return question.support_radius > 0.0 ? std::max(question.support_radius, radius) : rim_sine * radius;
}

/// The nearest place of a box.
Vec3 nearest_in(const Box& box, const Vec3& place) { return glm::clamp(place, box.lower, box.upper); }

/// Moves a way onto a box wherever it runs outside; its ends stay. Straight pieces stay straight. On the box's sides,
/// the body's distance from the scene is the margin by which the box was grown.
std::vector<Vec3> taken_to(const Box& box, const std::vector<Vec3>& way) {
  std::vector<Vec3> near;
  const auto add = [&](const Vec3& place) {
    if (near.empty() || near.back() != place) near.push_back(place);
  };
  if (!way.empty()) add(way.front());
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    // Between two crossings of the sides' planes, a straight piece maps to a straight piece.
    std::vector<double> crossings{0.0, 1.0};
    const Vec3 along = way[i + 1] - way[i];
    for (int k = 0; k < 3; ++k) {
      for (const double side : {box.lower[k], box.upper[k]}) {
        const double at = (side - way[i][k]) / along[k];
        if (at > 0.0 && at < 1.0) crossings.push_back(at);
      }
    }
    std::sort(crossings.begin(), crossings.end());
    for (const double at : crossings) add(nearest_in(box, at < 1.0 ? way[i] + at * along : way[i + 1]));
    if (i + 2 == way.size()) add(way[i + 1]);
  }
  return near;
}

/// Sends the walker along the way.
ProbeWalk walk_way(const ProbeSearch& search, const ProbeAnswer& answer) {
  const auto& [survey, question, options] = search;
  const std::vector<Vec3> path = probed_path(survey, question, answer);
  // A flying end may lie above or beside the scene.
  const double beyond = question.mode == Mode::fly ? glm::length(box_around(path).size()) : 0.0;
  const Box scene = survey.world().bounds().grown(beyond);
  const WalkerSettings body = probed_body(question, answer.size, survey.slope_degrees());
  Walker walker(survey.world(), body, question.mode, path.front());
  const RouteResult result = follow(walker, path, {.scene = scene});
  ProbeWalk walk{result.outcome, result.end, Vec3(0.0)};
  if (question.mode == Mode::walk && has_sunk(path, result, result.end, body.step)) walk.outcome = Outcome::fell;
  // For a fall, report the place where the ground ended, not the depth reached.
  for (const RouteEvent& e : result.events) {
    if (walk.outcome != Outcome::fell || e.event.kind == EventKind::fell) break;
    if (e.event.kind == EventKind::airborne) walk.at = e.event.point;
  }
  walk.on_way = nearest_on(answer.passage.way, walk.at, question.mode).place;
  if (walk.outcome != Outcome::blocked || question.mode != Mode::walk) return walk;
  // The search grants up to 2 cm more than the walker.
  const double near = 2.0 * answer.size.radius;
  const Box around = Box{walk.on_way, walk.on_way}.grown(near);
  const ProbeLimit step = highest_step(search, answer.passage.way, around);
  if (step.size > options.step) walk.step = step.size;
  return walk;
}

/// Takes a way with steps down that the body cannot climb, if a walker goes it.
void step_down(const ProbeSearch& search, ProbeAnswer& answer) {
  const WalkerSettings body = probed_body(search.question, answer.size);
  WayDown down = way_down(search, {answer.start, answer.target}, body.radius, body.radius + body.step);
  if (!down.passage.found) {
    answer.passage.complete = down.passage.complete;
    if (!down.passage.complete) answer.passage.places += down.passage.places;
    return;
  }
  ProbeAnswer other = answer;
  other.passage = std::move(down.passage);
  other.drops = std::move(down.drops);
  other.walk = walk_way(search, other);
  other.wide_enough = true;
  if (other.walk->outcome == Outcome::reached) answer = std::move(other);
}

/// Sends a walker along the widest way. If that is too narrow, looks for one with steps down.
void take_way(const ProbeSearch& search, ProbeAnswer& answer) {
  answer.wide_enough = answer.passage.found && answer.passage.radius >= answer.size.radius;
  if (answer.wide_enough)
    answer.walk = walk_way(search, answer);
  else if (answer.passage.complete)
    step_down(search, answer);
}

bool falls(const ProbeSearch& search, const ProbeAnswer& answer) {
  return search.question.mode == Mode::walk && answer.walk &&
         (answer.walk->outcome == Outcome::fell || answer.walk->outcome == Outcome::left_scene);
}

/// After a fall: takes a way over no wider cracks than this body spans, if there is one. `search` becomes its search.
void go_round(ProbeSearch& search, ProbeAnswer& answer) {
  ProbeSearch careful = search;
  careful.options.support_max = spanned(search.question, answer.size.radius);
  if (careful.options.support_max >= search.options.support_max) return;  // the same search
  const Measure measure = careful.measure();
  // An end over a crack that the body does not span is no place for it.
  if (!foot_at(search.survey, measure, answer.start) || !foot_at(search.survey, measure, answer.target)) return;
  ProbeAnswer other = answer;
  other.walk.reset();
  other.passage = careful.widest();
  take_way(careful, other);
  if (!other.wide_enough && other.passage.complete) return;
  answer = std::move(other);
  search.options = careful.options;
}

/// The largest radius, to half a millimetre, with which a walker goes the way: it keeps a gap to both sides.
double passing_radius(const ProbeSearch& search, const ProbeAnswer& answer) {
  constexpr double unit = 5e-4;  // m
  constexpr int most_tries = 4;
  ProbeAnswer narrower = answer;
  const double widest = std::floor(answer.passage.radius / unit);
  for (int i = 0; i < most_tries && widest - i > 0.0; ++i) {
    narrower.size.radius = unit * (widest - i);
    if (is_sphere(answer.size)) narrower.size.height = 2.0 * narrower.size.radius;
    if (walk_way(search, narrower).outcome == Outcome::reached) return narrower.size.radius;
  }
  return 0.0;
}

bool falls_short(const ProbeLimit& limit) {
  return limit.kind == ProbeLimit::Kind::step ? limit.size > limit.needed : limit.size < limit.needed;
}

/// Whether the limit is the step beside which the body came down: a larger one comes down farther away.
bool is_beside_drop(const ProbeLimit& limit, const std::vector<ProbeDrop>& drops) {
  return limit.kind == ProbeLimit::Kind::edge && std::any_of(drops.begin(), drops.end(), [&](const ProbeDrop& drop) {
           return level_distance(limit.feet, drop.rim) < 2.0 * limit.size;
         });
}

/// The limits of a body that two obstacles stop: a height or step that stops narrow bodies, too, and the limit of wider
/// ones behind it.
std::optional<std::array<ProbeLimit, 2>> two_limits(const ProbeSearch& search, const ProbeEnds& ends, double radius) {
  constexpr double lower = 2e-3;  // m: a headroom is known to a millimetre
  ProbeSearch changed = search;
  std::optional<ProbeLimit> first = headroom(search, search.options.narrowest);
  Passage rest;
  if (first) {
    changed.options.height = first->size - lower;
    rest = changed.widest();
  } else if (auto step = step_up(search, search.options.narrowest)) {
    first = step->limit;
    rest = std::move(step->passage);
  }
  if (!first || rest.radius >= radius) return std::nullopt;
  const auto second = limit_of(changed, rest, ends, radius);
  if (!second) return std::nullopt;
  return std::array{*first, *second};
}

/// Finds the limits for one size of a search. `known`: the step of another size.
void find_limit(const ProbeSearch& search, ProbeAnswer& answer, std::optional<StepUp>& known) {
  const double radius = answer.size.radius;
  const ProbeEnds ends{answer.start, answer.target};
  answer.limit = limit_of(search, answer.passage, ends, radius);
  if (answer.limit && is_beside_drop(*answer.limit, answer.drops)) answer.limit.reset();
  const bool at_end = answer.limit && is_end(answer.limit->kind);
  // A lower body's way is measured anew, and may come out a little wider.
  const bool is_close = answer.passage.found && answer.limit && radius - answer.passage.radius < same_width;
  if (!answer.wide_enough && !at_end && !is_close) {
    auto other = headroom(search, radius);
    if (!other && !answer.passage.found && answer.passage.complete) {
      if (!known || radius < known->least || radius > known->passage.radius) known = step_up(search, radius);
      if (known) {
        other = known->limit;
      } else if (auto two = two_limits(search, ends, radius)) {
        other = two->front();
        answer.other = two->back();
      }
    }
    if (other) answer.limit = other;
  }
  if (!answer.limit || answer.limit->kind == ProbeLimit::Kind::apart) return;
  if (!answer.wide_enough && falls_short(*answer.limit))
    answer.missing = std::abs(answer.limit->needed - answer.limit->size);
  if (at_end && !answer.wide_enough) answer.room = nearest_room(search, answer.limit->feet, radius);
}

}  // namespace

const char* to_string(ProbeLimit::Kind kind) {
  return name_in({"door", "lintel", "gap", "edge", "end", "end", "height", "step", "apart"}, kind);
}

double climbed(const ProbeQuestion& question, const ProbedSize& size) {
  const DefaultFloatingPoint guard;
  // Rounded down, so that the body itself still fits above its knee.
  const double above_knee = rolls(size) ? size.radius : std::nextafter(size.height - 2.0 * size.radius, 0.0);
  return std::min({question.step, step_limit(size.height), above_knee});
}

WalkerSettings probed_body(const ProbeQuestion& question, const ProbedSize& size, double slope_degrees) {
  const DefaultFloatingPoint guard;
  WalkerSettings settings;
  settings.radius = size.radius;
  settings.height = size.height;
  settings.eye = is_sphere(size) ? size.radius : std::min(settings.eye, settings.height);
  settings.step = climbed(question, size);
  settings.slope_degrees = slope_degrees;
  settings.support_radius = question.support_radius;
  check(settings);
  return settings;
}

PassageOptions ways::options_for(const ProbeQuestion& question, const ProbedSize& largest, double smallest) {
  PassageOptions options;
  options.mode = question.mode;
  options.spacing = question.spacing;
  options.most_places = question.most_places;
  options.widest = std::max(wide, wide_times * largest.radius);
  options.narrowest = std::min(narrow, narrow_part * smallest);
  if (question.mode == Mode::fly) return options;
  options.height = rolls(largest) ? 0.0 : largest.height;
  options.step = climbed(question, largest);
  options.support_max = std::max(options.support_max, spanned(question, largest.radius));
  return options;
}

namespace {

std::vector<ProbeAnswer> answers_to(const Survey& survey, const ProbeQuestion& question,
                                    std::span<const ProbedSize> sizes) {
  for (const ProbedSize& size : sizes) {
    static_cast<void>(probed_body(question, size));
    if (question.mode == Mode::fly && !is_sphere(size))
      throw Error(fmt::format("what flies is a sphere: a height of {:g} m is not twice the radius of {:g} m",
                              size.height, size.radius));
  }
  if (!(question.spacing >= least_spacing && question.spacing <= Space::reach_limit))
    throw Error(fmt::format("cannot probe: the spacing is {} m; it must be at least {} and at most {} m",
                            question.spacing, least_spacing, Space::reach_limit));
  for (const auto& [end, place] : {std::pair("from", question.from), std::pair("to", question.to)}) {
    for (int k = 0; k < 3; ++k) {
      if (!(std::abs(place[k]) <= coordinate_limit))
        throw Error(
            fmt::format("cannot probe: \"{}\" is ({:g}, {:g}, {:g}); it must be a point within 1e9 m of the origin",
                        end, place.x, place.y, place.z));
    }
  }
  // Bodies of one kind have the same height, or 0 for spheres, and the same step.
  struct Radii {
    double least = std::numeric_limits<double>::infinity();
    ProbedSize largest{0.0, 0.0};
  };
  using Kind = std::pair<double, double>;
  const auto kind_of = [&](const ProbedSize& size) {
    if (question.mode == Mode::fly) return Kind{0.0, 0.0};
    return Kind{rolls(size) ? 0.0 : size.height, climbed(question, size)};
  };
  std::map<Kind, Radii> radii;
  for (const ProbedSize& size : sizes) {
    Radii& of_kind = radii[kind_of(size)];
    of_kind.least = std::min(of_kind.least, size.radius);
    if (size.radius > of_kind.largest.radius) of_kind.largest = size;
  }
  // Bodies of one kind that stand at the same ends share one search.
  struct Group {
    Kind kind;
    ProbeQuestion question;  ///< with ends that have room
    std::optional<ProbeSearch> search;
    Vec3 start{0.0}, target{0.0};
    std::optional<ProbeLimit> low;  ///< an end where no body of the kind can stand upright
    Passage passage;
    std::optional<StepUp> step;
  };
  std::list<Group> groups;
  const auto group_of = [&](const ProbedSize& size) -> Group& {
    const Kind kind = kind_of(size);
    const Radii& of_kind = radii.at(kind);
    Group& group = groups.emplace_back();
    group.kind = kind;
    group.question = question;
    group.search.emplace(ProbeSearch{survey, group.question, options_for(question, of_kind.largest, of_kind.least)});
    const auto stand = [&](Vec3& given, ProbeLimit::Kind end, const char* name) {
      refuse_far_end(*group.search, given, name);
      const auto place = stand_for(*group.search, given, size.radius);
      if (place) {
        if (is_moved(*place, given, question.mode)) given = *place;
        return *place;
      }
      const auto low = low_end(*group.search, given, end);
      if (!low) refuse_end(*group.search, given, name, of_kind.least);
      if (!group.low) group.low = low;
      return low->feet;
    };
    group.start = stand(group.question.from, ProbeLimit::Kind::start, "from");
    group.target = stand(group.question.to, ProbeLimit::Kind::target, "to");
    const auto same = std::find_if(groups.begin(), groups.end(), [&](const Group& g) {
      return g.kind == kind && g.start == group.start && g.target == group.target;
    });
    if (&*same != &group) {
      groups.pop_back();
      return *same;
    }
    if (!group.low) group.passage = group.search->widest();
    return group;
  };
  std::vector<ProbeAnswer> answers;
  for (const ProbedSize& size : sizes) {
    Group& group = group_of(size);
    ProbeSearch search = *group.search;
    ProbeAnswer answer;
    answer.size = size;
    answer.narrowest = search.options.narrowest;
    answer.passage = group.passage;
    answer.start = group.start;
    answer.target = group.target;
    if (!group.low) take_way(search, answer);
    if (falls(search, answer)) go_round(search, answer);
    const Passage& p = answer.passage;
    answer.proven = answer.wide_enough ? p.proven : p.bound < size.radius;
    if (group.low) {
      answer.limit = group.low;
      answer.missing = group.low->needed - group.low->size;
      answer.proven = true;
      answer.room = nearest_room(search, group.low->feet, size.radius);
    } else {
      find_limit(search, answer, group.step);
    }
    if (p.found && !answer.wide_enough) answer.passing = passing_radius(search, answer);
    answer.passable = answer.walk && answer.walk->outcome == Outcome::reached;
    answers.push_back(std::move(answer));
  }
  return answers;
}

}  // namespace

std::vector<ProbeAnswer> probe(const Survey& survey, const ProbeQuestion& question, std::span<const ProbedSize> sizes) {
  return in_default_floating_point([&] { return answers_to(survey, question, sizes); });
}

std::vector<Vec3> probed_path(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer) {
  const DefaultFloatingPoint guard;
  const std::vector<Vec3>& way = answer.passage.way;
  if (question.mode != Mode::fly) return standing(way, probed_body(question, answer.size, survey.slope_degrees()));
  const Box box = survey.world().bounds();
  return box.empty() ? way : taken_to(box.grown(beside_scene * answer.size.radius), way);
}

ProbeAnswer probe(const Survey& survey, const ProbeQuestion& question, const ProbedSize& size) {
  return probe(survey, question, std::span(&size, 1)).front();
}

namespace {

ProbeReach reached(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer, std::uint64_t most) {
  const ProbeSearch search{survey, question, options_for(question, answer.size)};
  WidestTree tree(survey, search.measure(), question.spacing);
  const auto grown = [&](const Vec3& end) {
    std::vector<Vec3> places;
    const auto root = tree.seed(end);
    if (!root) return places;
    const std::uint64_t until = tree.size() + most;
    bool wanted = true;
    static_cast<void>(tree.grow(*root, no_node, [&](std::uint64_t now) {
      wanted = !question.progress || question.progress(now);
      return wanted && now < until;
    }));
    if (!wanted) throw Cancelled();
    for (NodeId id = 0; id < static_cast<NodeId>(tree.size()); ++id) {
      if (tree.root(id) == *root) places.push_back(tree.node(id).place);
    }
    return places;
  };
  return {grown(answer.start), grown(answer.target)};
}

}  // namespace

ProbeReach probed_reach(const Survey& survey, const ProbeQuestion& question, const ProbeAnswer& answer,
                        std::uint64_t most) {
  return in_default_floating_point([&] { return reached(survey, question, answer, most); });
}

}  // namespace roam
