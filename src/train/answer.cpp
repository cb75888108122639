#include "train/answer.h"

#include <fmt/format.h>

namespace roam::training {

namespace {

/// Contradictions that are told in full; of more only the number.
constexpr std::size_t most_told = 2;
/// A part that was left out is told of when it has more than this part of the places that were not.
constexpr std::size_t worth_telling = 10;

/// "all 5 paths", "the path".
std::string all_paths(const Training& training) {
  return training.paths.size() == 1 ? "the path" : fmt::format("all {} paths", training.paths.size());
}

const Decisive* decisive(const Training& training, Decisive::Kind kind) {
  for (const Decisive& d : training.decisive)
    if (d.kind == kind) return &d;
  return nullptr;
}

/// What limits a body, as two parts of a sentence: "the opening 0.752 m wide at (1.00, 2.00, 3.00)".
std::string opening_words(const Training& training) {
  const Decisive* opening = decisive(training, Decisive::Kind::opening);
  return opening ? fmt::format("the opening {:.3f} m wide at {}", opening->width, at(opening->point))
                 : std::string("the narrowest opening");
}

std::string split_words(const Training& training) {
  const Decisive* split = decisive(training, Decisive::Kind::split);
  return split ? fmt::format("the crack {:.3f} m wide at {}", split->width, at(split->point))
               : std::string("the widest crack");
}

std::string interval_words(const Training& training, bool cracks_known) {
  const char* const no_crack = cracks_known ? "no crack lies on the way" : "cracks were not looked for";
  const bool cracked = training.smallest > 0.0;
  if (!training.largest) {
    return cracked ? fmt::format("Any radius from {:.3f} m up does; {} decides, and no opening limits it.",
                                 training.smallest, split_words(training))
                   : fmt::format("No opening limits the radius, and {}.", no_crack);
  }
  if (!cracked) {
    return fmt::format("Any radius up to {:.3f} m does; {} decides, and {}.", *training.largest,
                       opening_words(training), no_crack);
  }
  return fmt::format("Any radius from {:.3f} to {:.3f} m does; {} decides the upper end, {} the lower.",
                     training.smallest, *training.largest, opening_words(training), split_words(training));
}

std::string feasible_words(const Training& training, bool cracks_known) {
  std::string text = fmt::format("A body with {} serves {}. {}", body_words(training.radius, training.support_radius),
                                 all_paths(training), interval_words(training, cracks_known));
  if (training.support_radius > 0.0 && training.smallest < training.radius)
    text += " The foot is for cracks beside the paths.";
  return text;
}

std::string infeasible_words(const Training& training) {
  if (!training.largest) {
    return fmt::format(
        "No one radius serves {}: {} carries none below {:.3f} m, more than such a body may have. Use {}.",
        all_paths(training), split_words(training), training.smallest,
        body_words(training.radius, training.support_radius));
  }
  if (training.smallest <= *training.largest) {
    return fmt::format("The body with {} did not come through on all paths. {}",
                       body_words(training.radius, training.support_radius), interval_words(training, true));
  }
  return fmt::format(
      "No one radius serves {}: {} lets at most {:.3f} m through, and {} carries none below {:.3f} m. "
      "Use {}.",
      all_paths(training), opening_words(training), *training.largest, split_words(training), training.smallest,
      body_words(training.radius, training.support_radius));
}

}  // namespace

std::string at(const Vec3& p) { return fmt::format("({:.2f}, {:.2f}, {:.2f})", p.x, p.y, p.z); }

std::string body_words(double radius, double support_radius) {
  if (support_radius > radius)
    return fmt::format("a radius of {:.3f} m on a foot (support radius) of {:.3f} m", radius, support_radius);
  return fmt::format("a radius of {:.3f} m", radius);
}

std::string nothing_to_train(const Survey& survey, const TrainOptions& options) {
  if (survey.triangles() == 0)
    return "There is no triangle in the scene: nothing limits a body, and nothing carries it.";
  if (options.mode == Mode::walk && survey.floor_triangles().empty()) {
    return fmt::format(
        "There is no floor: none of {} triangles is within {:g} degrees of level. If another axis than z "
        "points up, say so; else train for flying.",
        survey.triangles(), survey.slope_degrees());
  }
  return options.mode == Mode::walk
             ? "There is no free place: nowhere on the floor does even the smallest body fit. Is the height right, and "
               "the unit of length?"
             : "There is no free place: nowhere does even the smallest body fit. Is the unit of length right?";
}

std::string interval_answer(const Layout& layout, const Training& training, bool cracks_known) {
  const std::vector<std::string>& contradictions = training.contradictions;
  std::string text;
  if (training.paths.empty()) {
    text = fmt::format("There is room to stand but no way to go: a body with {} fits there.",
                       body_words(training.radius, training.support_radius));
  } else {
    text = training.feasible ? feasible_words(training, cracks_known) : infeasible_words(training);
  }
  if (layout.components.size() > 1) {
    text += fmt::format(" The scene has {} parts without a way between them; paths were planned in each.",
                        layout.components.size());
  }
  if (layout.left_out > layout.components[0].nodes.size() / worth_telling) {
    text +=
        fmt::format(" A part of {} places (beside {}) was left out: it seems to be outside, or on top of something.",
                    layout.left_out, layout.components[0].nodes.size());
  }
  for (std::size_t i = 0; i < std::min(contradictions.size(), most_told); ++i) text += " " + contradictions[i];
  if (contradictions.size() > most_told)
    text += fmt::format(" {} more trials contradict the geometry.", contradictions.size() - most_told);
  return text;
}

std::string paper_answer(const PaperResult& result, const Training& training) {
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
      return fmt::format("Of the radii tried so far {:.3f} m passed most.", result.radius);
  }
  return {};
}

std::string ended_early(const std::string& stage) {
  return fmt::format(" Ended early, while {}: this is the best known by then.", stage);
}

}  // namespace roam::training
