#include "words/training.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "math/floating_point.h"
#include "words/measures.h"

namespace roam::words {

namespace {

/// Contradictions described in full; further ones are only counted.
constexpr std::size_t most_told = 2;
/// A part left out is mentioned if it has more than 1 / worth_telling of the places of the largest part.
constexpr std::size_t worth_telling = 10;
/// Openings that stop the chosen body and are described; further ones are only counted.
constexpr std::size_t most_stops = 3;
/// Parts described one by one; further ones are only counted.
constexpr std::size_t most_parts = 3;

/// "a radius of 0.300 m", with the support disc if there is one.
std::string body_words(double radius, double support_radius) {
  if (support_radius > radius)
    return fmt::format("a radius of {:.3f} m on a support disc of {:.3f} m", radius, support_radius);
  return fmt::format("a radius of {:.3f} m", radius);
}

/// "all 5 paths", "the path".
std::string all_paths(const Training& training) {
  return training.paths.size() == 1 ? "the path" : fmt::format("all {} paths", training.paths.size());
}

/// The opening that limits a body, as part of a sentence: "the opening 0.752 m wide at (1.00, 2.00, 3.00)".
std::string opening_words(const Training& training) {
  const auto& opening = training.narrowest;
  return opening ? fmt::format("the opening {:.3f} m wide at {}", opening->width, at(opening->point))
                 : std::string("the narrowest opening");
}

std::string split_words(const Training& training) {
  const auto& split = training.widest;
  return split ? fmt::format("the crack {:.3f} m wide at {}", 2.0 * split->radius, at(split->point))
               : std::string("the widest crack");
}

/// The lower end of the interval: the crack into which smaller bodies fall.
struct LowerEnd {
  double radius = 0.0;  ///< m; infinite if no body that was tried is carried
  std::string why;
};

LowerEnd lower_end(const Training& training) {
  if (!training.hardest) return {training.smallest, split_words(training)};
  const Crack& crack = *training.hardest;
  return {training.least,
          fmt::format("the crack {:.3f} m wide at {}, up over its higher rim,", 2.0 * crack.radius, at(crack.point))};
}

/// "carries none below 0.600 m".
std::string carries_none(const LowerEnd& lower) {
  return std::isfinite(lower.radius) ? fmt::format("{} carries none below {:.3f} m", lower.why, lower.radius)
                                     : fmt::format("{} carried none that was tried", lower.why);
}

std::string interval_words(const Training& training) {
  const char* const no_crack = training.all_cracks ? "no crack lies on the way" : "not all cracks were looked for";
  const bool cracked = training.smallest > 0.0;
  const LowerEnd lower = lower_end(training);
  if (!std::isfinite(lower.radius)) return fmt::format("Without a support disc {}.", carries_none(lower));
  if (!training.largest) {
    return cracked ? fmt::format("Any radius from {:.3f} m up does; {} decides, and no opening limits it.",
                                 lower.radius, lower.why)
                   : fmt::format("No opening limits the radius, and {}.", no_crack);
  }
  if (!cracked) {
    return fmt::format("Any radius up to {:.3f} m does; {} decides, and {}.", *training.largest,
                       opening_words(training), no_crack);
  }
  return fmt::format("Any radius from {:.3f} to {:.3f} m does; {} decides the upper end, {} the lower.", lower.radius,
                     *training.largest, opening_words(training), lower.why);
}

std::string feasible_words(const Training& training) {
  std::string text = fmt::format("A body with {} serves {}. {}", body_words(training.radius, training.support_radius),
                                 all_paths(training), interval_words(training));
  if (training.support_radius > 0.0 && training.smallest < training.radius) {
    const bool is_carried = training.radius >= training.carried;
    text += is_carried ? " The support disc is for cracks beside the paths."
                       : " The support disc is for that crack: a body hardly wider than the crack sags into it.";
  }
  return text;
}

/// For a body too wide for some paths and chosen for the others: how many paths it serves, and what stops it on the
/// rest.
std::string for_most_words(const Training& training) {
  std::vector<std::string> stops;
  std::size_t served = 0;
  for (std::size_t i = 0; i < training.paths.size(); ++i) {
    const TrainedPath& path = training.paths[i];
    if (!path.largest || *path.largest >= training.radius) {
      ++served;
      continue;
    }
    stops.push_back(fmt::format("path {} lets {:.3f} m through", i + 1, *path.largest) +
                    (path.opening ? " at " + at(path.opening->point) : ""));
  }
  std::string text = fmt::format(
      "No useful size serves {}: {} lets at most {:.3f} m through. Use {}: it serves {} of them. Of the "
      "others ",
      all_paths(training), opening_words(training), *training.largest,
      body_words(training.radius, training.support_radius), served);
  for (std::size_t i = 0; i < std::min(stops.size(), most_stops); ++i) text += (i == 0 ? "" : ", ") + stops[i];
  if (stops.size() > most_stops)
    text += fmt::format(", and {} more let less than that through", stops.size() - most_stops);
  text += ".";
  if (training.support_radius > training.radius && training.smallest > 0.0)
    text += fmt::format(" The support disc is for {}.", split_words(training));
  return text;
}

std::string infeasible_words(const Training& training) {
  if (training.largest && training.radius > *training.largest) return for_most_words(training);
  const std::string body = body_words(training.radius, training.support_radius);
  const LowerEnd lower = lower_end(training);
  const bool has_interval = training.largest ? lower.radius <= *training.largest : training.radius >= lower.radius;
  if (has_interval)
    return fmt::format("The body with {} did not come through on all paths. {}", body, interval_words(training));
  if (!training.largest)
    return fmt::format("No one radius serves {}: {}, more than such a body may have. Use {}.", all_paths(training),
                       carries_none(lower), body);
  return fmt::format("No one radius serves {}: {} lets at most {:.3f} m through, and {}. Use {}.", all_paths(training),
                     opening_words(training), *training.largest, carries_none(lower), body);
}

std::string size_words(const ConnectedPart& part) {
  return part.area > 0.0 ? fmt::format("{:.0f} m2", part.area) : fmt::format("{} places", part.places);
}

/// Parts that were left out, with the reason, and parts that were only partly searched.
std::string parts_words(const std::vector<ConnectedPart>& parts) {
  std::string text;
  std::size_t left_out = 0, told = 0;
  for (const ConnectedPart& part : parts) {
    if (part.trained && !part.whole)
      text += fmt::format(" Of the part about {} only {} were looked at.", at(part.place), size_words(part));
    if (part.trained || part.places <= parts.front().places / worth_telling) continue;
    if (++left_out > most_parts) continue;
    text += fmt::format("{} the {} about {} ({})", told++ == 0 ? " Left out:" : ",", size_words(part), at(part.place),
                        why(part.left_out));
  }
  if (left_out > most_parts) text += fmt::format(", and {} more", left_out - most_parts);
  return left_out > 0 ? text + "." : text;
}

/// Why there is nothing to train.
std::string nowhere_words(const Training& training) {
  switch (*training.nowhere) {
    case Nowhere::empty_scene:
      return "There is no triangle in the scene: nothing limits a body, and nothing carries it.";
    case Nowhere::no_floor:
      return fmt::format(
          "There is no floor: none of {} triangles is within {:g} degrees of level. If another axis than z points up, "
          "say so; else train for flying.",
          training.triangles, training.slope_degrees);
    case Nowhere::over_low_rooms: {
      const auto low = std::find_if(training.parts.begin(), training.parts.end(),
                                    [](const ConnectedPart& part) { return part.left_out == LeftOut::over_low_rooms; });
      return fmt::format(
          "A body {:g} m high stands nowhere inside: where it fits at all, as on the {:.0f} m2 about {}, is on top of "
          "rooms that are lower. Take a lower body.",
          training.height, low->area, at(low->place));
    }
    case Nowhere::no_room:
      break;
  }
  return training.mode == Mode::walk
             ? "There is no free place: nowhere on the floor does even the smallest body fit. Is the height right, and "
               "the unit of length?"
             : "There is no free place: nowhere does even the smallest body fit. Is the unit of length right?";
}

/// There is room to stand, and nothing else was found.
std::string no_path_words(const Training& training) {
  return fmt::format("There is room to stand but no way to go: the body with {} is a person's, and was not tested.",
                     body_words(training.radius, training.support_radius));
}

std::string ends_words(const Training& training, bool ended) {
  std::string text;
  const bool has_conflict = training.largest && lower_end(training).radius > *training.largest;
  if (ended && training.paths.empty())
    return fmt::format("No path was planned yet: a body with {} is only what a person has.",
                       body_words(training.radius, training.support_radius));
  if (ended && !has_conflict) {
    text = fmt::format("A body with {} is the best so far. {}", body_words(training.radius, training.support_radius),
                       interval_words(training));
  } else if (training.paths.empty()) {
    text = no_path_words(training);
  } else {
    text = training.feasible ? feasible_words(training) : infeasible_words(training);
  }
  if (training.separate > 1) {
    const auto planned = static_cast<std::size_t>(std::count_if(
        training.parts.begin(), training.parts.end(), [](const ConnectedPart& part) { return part.trained; }));
    text += fmt::format(" The scene has {} parts without a way between them; paths were planned in {}.",
                        training.separate, planned == training.separate ? "each" : fmt::format("{} of them", planned));
  }
  text += parts_words(training.parts);
  if (training.uncertain_ways > 0)
    text += fmt::format(" {} more ways that were planned could not be certified for any size, and do not count.",
                        training.uncertain_ways);
  if (!training.unwalked.empty()) {
    const UnwalkedPath& first = training.unwalked.front();
    const std::size_t count = training.unwalked.size();
    const std::string ends = count == 1
                                 ? "1 end that was drawn cannot be walked to, and does not count"
                                 : fmt::format("{} ends that were drawn cannot be walked to, and do not count", count);
    const bool falls = first.outcome == Outcome::fell || first.outcome == Outcome::left_scene;
    text += fmt::format(" {}: from {} to {} a walker {} at {}.", ends, at(first.from), at(first.to),
                        falls ? "falls" : "is stopped", at(first.at));
  }
  const std::size_t contradictions = training.contradictions.size();
  for (std::size_t i = 0; i < std::min(contradictions, most_told); ++i)
    text.append(" ").append(contradiction(training.contradictions[i]));
  if (contradictions > most_told)
    text += fmt::format(" {} more trials contradict the geometry.", contradictions - most_told);
  return text;
}

std::string trench_words(const Trench& trench) {
  return fmt::format(
      " No support disc helps over the trench {:.3f} m wide at {}: its bottom is only {:.3f} m down. A radius from "
      "{:.3f} m up rolls over it, and a step of {:.2f} m leads through it.",
      2.0 * trench.crack.radius, at(trench.crack.point), trench.depth, trench.crack.radius,
      std::ceil(100.0 * trench.depth) / 100.0);
}

std::string interval_answer(const Training& training, const TrainOptions& options) {
  std::string text = ends_words(training, !training.complete);
  if (training.least_support > options.support_max && training.support_radius > 0.0)
    text += fmt::format(
        " A crack beside a wall needs a support disc of {:.2f} m, more than --support-max allows: it is not bridged.",
        training.least_support);
  return training.trench ? text + trench_words(*training.trench) : text;
}

/// How the paper's procedure ended.
std::string paper_words(const PaperResult& result, const Training& training) {
  using Ending = PaperResult::Ending;
  const auto fell = [&] {
    return fmt::format("{:.3f} m falls on path {} at {}", result.fallen->radius, result.fallen->path + 1,
                       at(result.fallen->at));
  };
  const auto stopped = [&] {
    return fmt::format("{:.3f} m cannot enter on path {} at {}", result.blocked->radius, result.blocked->path + 1,
                       at(result.blocked->at));
  };
  switch (result.ending) {
    case Ending::settled: {
      std::string text = fmt::format("A radius of {:.3f} m passes {}", result.radius, all_paths(training));
      if (result.fallen) text += "; " + fell();
      if (result.blocked) text += "; " + stopped();
      return text + ".";
    }
    case Ending::contradiction:
      return fmt::format("No one radius passes {}, a contradiction: {}, and {}.", all_paths(training), fell(),
                         stopped());
    case Ending::too_small:
      return fmt::format("Not even the smallest radius enters: {}.", stopped());
    case Ending::too_large:
      return fmt::format("Not even the largest radius is carried: {}.", fell());
    case Ending::out_of_trials:
      return "The radius did not settle in 20 trials of a path.";
    case Ending::cancelled:
      return "The paths were not roamed to the end.";
  }
  return {};
}

std::string paper_answer(const PaperResult& result, const Training& training) {
  if (training.paths.empty()) return no_path_words(training);
  std::string text = paper_words(result, training);
  if (result.ending == PaperResult::Ending::settled) return text;
  return text + (result.radius > 0.0 ? fmt::format(" Of all that were tried {:.3f} m passed most paths.", result.radius)
                                     : fmt::format(" As none passed any path, {} is only what a person has.",
                                                   body_words(training.radius, 0.0)));
}

}  // namespace

std::vector<Decisive> decisive(const Training& training) {
  std::vector<Decisive> all;
  if (const auto& opening = training.narrowest)
    all.push_back({false, opening->point, opening->width, opening->direction});
  if (const auto& crack = training.widest) all.push_back({true, crack->point, 2.0 * crack->radius, crack->direction});
  return all;
}

std::string answer(const Training& training, const TrainOptions& options) {
  const DefaultFloatingPoint guard;
  std::string text = training.nowhere       ? nowhere_words(training)
                     : training.places == 0 ? "No place was found."
                     : training.paper       ? paper_answer(*training.paper, training)
                                            : interval_answer(training, options);
  if (training.ended)
    text += fmt::format(" Ended early, while {}: this is the best known by then.", stage(*training.ended));
  return text;
}

const char* why(LeftOut left_out) {
  switch (left_out) {
    case LeftOut::none:
      return "";
    case LeftOut::backs:
      return "outside, or within walls: the backs of triangles look at it";
    case LeftOut::on_top:
      return "on top of something";
    case LeftOut::over_low_rooms:
      return "on top of rooms that are lower than the body";
    case LeftOut::small_or_open:
      return "small beside the rest, or open to the sky";
    case LeftOut::unfinished:
      return "open country, not looked at whole";
    case LeftOut::much_smaller:
      return "much smaller than the rest";
    case LeftOut::no_path:
      return "no path was planned in it";
  }
  return "";
}

const char* stage(TrainStage stage) {
  switch (stage) {
    case TrainStage::places:
      return "looking for places";
    case TrainStage::planning:
      return "planning paths";
    case TrainStage::cracks:
      return "looking for cracks";
    case TrainStage::walking:
      return "walking the paths";
    case TrainStage::beside_paths:
      return "looking beside the paths";
    case TrainStage::trials:
      return "trials";
    case TrainStage::roaming_paths:
      return "roaming the paths";
  }
  return "";
}

}  // namespace roam::words
