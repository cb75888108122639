#include "roam/train.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>

#include "math/parallel_floating_point.h"
#include "math/step_limit.h"
#include "training/confirm.h"
#include "training/interval.h"
#include "training/layout.h"
#include "training/paper.h"
#include "training/places/inside.h"
#include "training/stages.h"
#include "ways/trials/trials.h"

namespace roam {

namespace {

using namespace training;

/// m, the default body's radius.
constexpr double usual_radius = 0.3;
/// The paper's number of paths.
constexpr int usual_paths = 5;
/// m: the smallest radius that the paper's procedure tries, and the largest allowed length.
constexpr double smallest_radius = 0.05;
constexpr double most_metres = 100.0;

void check(const TrainOptions& options) {
  const auto in = [](const char* what, double value, double low, double high) {
    if (!(value >= low && value <= high))
      throw Error(fmt::format("training: the {} is {:g}; it must be from {:g} to {:g}", what, value, low, high));
  };
  if (options.mode == Mode::ghost) throw Error("training: a ghost passes everything; train to walk or to fly");
  in("smallest radius", options.radius_min, 0.01, most_metres);
  in("largest radius", options.radius_max, 0.01, most_metres);
  in("largest support radius", options.support_max, 0.1, most_metres);
  in("step", options.step, 0.0, most_metres);
  in("spacing", options.spacing, 0.02, most_metres);
  in("speed", options.speed, 0.01, 1e4);
  in("number of threads", options.threads, 0, std::numeric_limits<int>::max());
  in("number of paths", options.paths, 0, 10'000);
  if (options.mode == Mode::walk && options.height != 0.0) {
    in("height", options.height, 0.1, most_metres);
    const double step = std::min(options.step, step_limit(options.height));
    if (options.height <= step + 2.0 * smallest_radius)
      throw Error(
          fmt::format("training: a body {:g} m high that steps up {:g} m has nothing left above its knee; "
                      "take a smaller step or height 0, a sphere",
                      options.height, step));
  }
}

/// Sets the default body.
void take_usual_body(const TrainOptions& options, const ways::BodyKind& kind, Training& training) {
  training.radius = std::min({usual_radius, options.radius_max, ways::largest_radius(kind)});
}

/// Marks parts without a path as not trained. There may be fewer requested paths than parts.
void leave_out_parts_without_paths(const Layout& layout, Training& training) {
  auto part = training.parts.begin();
  for (const Component& component : layout.components) {
    if (is_scrap(component)) continue;
    const auto leads_through = [&](const PlannedPath& path) {
      return std::binary_search(component.nodes.begin(), component.nodes.end(), path.ends.from);
    };
    if (std::none_of(layout.paths.begin(), layout.paths.end(), leads_through)) {
      part->trained = false;
      part->left_out = LeftOut::no_path;
    }
    ++part;
  }
}

/// Adds the results of planning and confirming the paths, and the paths that do not count.
void describe_paths(const Layout& layout, Training& training) {
  for (std::size_t i = 0; i < training.paths.size(); ++i) training.paths[i].opening = layout.paths[i].passage.opening;
  for (const Unwalked& u : layout.unwalked) training.unwalked.push_back({u.from, u.to, u.last.outcome, u.end});
  training.uncertain_ways = layout.uncertain;
}

void describe_cracks(const Evidence& evidence, Training& training) {
  training.least = least_on_paths(evidence, training);
  training.carried = carried_on_paths(evidence, training);
  training.least_support = evidence.least_support;
  training.all_cracks = evidence.complete;
  if (evidence.hardest && training.least > training.smallest) training.hardest = evidence.cracks[*evidence.hardest];
  if (!evidence.shallow) return;
  const cracks::FoundCrack& shallow = evidence.cracks[*evidence.shallow];
  if (sinks_into(training.radius, shallow)) training.trench = Trench{shallow, shallow.shallow_depth};
}

/// The reason why no place was found.
Nowhere nowhere(const Survey& survey, const TrainOptions& options, const std::vector<ConnectedPart>& parts) {
  if (survey.triangles() == 0) return Nowhere::empty_scene;
  if (options.mode == Mode::walk && survey.floor_triangles().empty()) return Nowhere::no_floor;
  const bool is_over_low_rooms = std::any_of(
      parts.begin(), parts.end(), [](const ConnectedPart& part) { return part.left_out == LeftOut::over_low_rooms; });
  return is_over_low_rooms ? Nowhere::over_low_rooms : Nowhere::no_room;
}

void find_interval(const Survey& survey, const TrainOptions& options, const ways::BodyKind& kind, Layout& layout,
                   cracks::RimEdges& rims, Stages& stages, Training& training) {
  Evidence evidence = find_cracks(survey, options, layout, rims, stages);
  if (options.mode == Mode::walk && !stages.ended()) confirm_paths(survey, options, kind, evidence, layout, stages);
  find_ends(survey, options, layout, evidence, training);
  choose_body(kind, options, evidence, training);
  if (!stages.ended()) add_regions(survey, options, layout, stages, training);
  if (!stages.ended()) prove(survey, kind, layout, evidence, stages, training);
  leave_out_parts_without_paths(layout, training);
  describe_paths(layout, training);
  describe_cracks(evidence, training);
}

bool rolls(const TrainOptions& options) { return options.mode == Mode::walk && options.height == 0.0; }

/// With a step that a body of the height climbs.
TrainOptions with_possible_step(TrainOptions options) {
  if (options.mode == Mode::walk && !rolls(options)) options.step = std::min(options.step, step_limit(options.height));
  return options;
}

/// Options for the first layout: a sphere climbs at most its radius.
TrainOptions first_laid_out(TrainOptions options) {
  if (options.method == Method::paper && options.paths == 0) options.paths = usual_paths;
  if (rolls(options)) options.step = std::min(options.step, std::min(usual_radius, options.radius_max));
  return options;
}

/// Lays out for the step of the resulting body. A smaller step never gives a larger body, so this converges.
Layout lay_out_for_body(const Survey& survey, TrainOptions options, const ways::BodyKind& kind, Stages& stages) {
  constexpr double same_step = 1e-4;  // m
  for (;;) {
    Layout layout = lay_out(survey, options, stages);
    if (!rolls(options) || stages.ended() || options.method == Method::paper) return layout;
    Training first;
    for (const PlannedPath& path : layout.paths) {
      TrainedPath& described = first.paths.emplace_back();
      if (!path.passage.limited) continue;
      described.largest = path.passage.radius;
      first.largest = std::min(first.largest.value_or(path.passage.radius), path.passage.radius);
    }
    choose_body(kind, options, {}, first);
    if (first.radius >= options.step - same_step) return layout;
    options.step = first.radius;
  }
}

void follow_paper(const Survey& survey, const TrainOptions& options, const ways::BodyKind& kind, const Layout& layout,
                  Stages& stages, Training& training) {
  stages.begin(TrainStage::roaming_paths);
  for (const PlannedPath& path : layout.paths) {
    const std::vector<Vec3>& way = path.passage.way;
    training.paths.push_back(
        {.from = way.front(), .to = way.back(), .way = way, .largest = {}, .opening = {}, .trials = {}});
  }
  PaperOptions how;
  how.largest = std::min(options.radius_max, ways::largest_radius(kind));
  how.smallest = std::min({smallest_radius, options.radius_min, how.largest});
  std::size_t furthest = 0;
  const PaperRun result =
      adjust_radius(layout.paths.size(), how, [&](std::size_t path, double radius) -> std::optional<Trial> {
        furthest = std::max(furthest, path);
        const auto progress = [&] {
          return stages.at(static_cast<double>(furthest) / static_cast<double>(layout.paths.size()));
        };
        if (!progress()) return std::nullopt;
        Trial trial = try_way(survey, kind, radius, 0.0, training.paths[path].way, progress);
        trial.path = path;
        return stages.ended() ? std::nullopt : std::optional(trial);
      });
  for (const Trial& trial : result.trials) training.paths[trial.path].trials.push_back(trial);
  training.feasible = result.ending == PaperResult::Ending::settled && !layout.paths.empty();
  training.radius = result.radius;
  if (!(training.radius > 0.0)) take_usual_body(options, kind, training);
  if (result.fallen) training.smallest = result.fallen->radius;
  if (result.blocked) training.largest = result.blocked->radius;
  leave_out_parts_without_paths(layout, training);
  training.paper = result;
}

Training trained(const Survey& survey, const TrainOptions& given) {
  check(given);
  const TrainOptions options = with_possible_step(given);
  const auto start = std::chrono::steady_clock::now();
  Stages stages(options.progress);
  Training training;
  training.mode = options.mode;
  training.method = options.method;
  training.slope_degrees = survey.slope_degrees();
  training.triangles = survey.triangles();
  const TrainOptions laid = first_laid_out(options);
  cracks::RimEdges rims(survey, crack_options(laid, measure_of(laid)));
  if (options.mode == Mode::walk && options.method == Method::interval) rims.look_ahead();
  Layout layout = lay_out_for_body(survey, laid, kind_of(survey, options), stages);
  // The next steps must use the same step, or they would search for other cracks than the ways cross.
  TrainOptions settled = options;
  settled.step = training.step = layout.measure.step;
  const ways::BodyKind kind = kind_of(survey, settled);
  for (const Component& component : layout.components) training.places += component.nodes.size();
  training.parts = layout.parts;
  training.separate = layout.components.size();
  if (layout.components.empty()) {
    take_usual_body(options, kind, training);
    if (!stages.ended()) training.nowhere = nowhere(survey, options, layout.parts);
  } else if (options.method == Method::paper) {
    follow_paper(survey, settled, kind, layout, stages, training);
  } else {
    find_interval(survey, settled, kind, layout, rims, stages, training);
  }
  stages.complete();
  training.complete = !stages.ended();
  if (!training.complete) {
    training.feasible = false;
    training.ended = stages.stage();
  }
  training.height = kind.height > 0.0 ? kind.height : 2.0 * training.radius;
  training.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return training;
}

}  // namespace

const char* to_string(Method method) { return method == Method::paper ? "paper" : "interval"; }

Profile profile_of(const Training& training, const SceneIdentity& scene) {
  Profile profile;
  static_cast<FittingBody&>(profile) = training;
  profile.scene = scene;
  // For a flying body, any step was accepted.
  profile.step = std::min(training.step, step_limit(training.height));
  profile.method = to_string(training.method);
  return profile;
}

Profile profile_of(const Training& training, const Survey& survey) {
  return profile_of(training, identity_of(survey.meshes()));
}

Training train(const Survey& survey, const TrainOptions& options) {
  return in_default_floating_point([&] { return trained(survey, options); }, options.threads);
}

}  // namespace roam
