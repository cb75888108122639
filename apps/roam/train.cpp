// roam train: finds the sizes of a body that suit a scene.
#include "roam/train.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "draw/picture_file.h"
#include "files/whole_file.h"
#include "math/step_limit.h"
#include "profile/write_profile.h"
#include "roam/error.h"
#include "scenes/body_options.h"
#include "scenes/frame.h"
#include "scenes/surveyed.h"
#include "train/report.h"
#include "verbs.h"
#include "words/training.h"

namespace roam::app {
namespace {

struct TrainVerbOptions {
  SceneOptions scene;
  TrainOptions train;
  std::optional<Mode> mode;
  std::string method = "interval";
  double slope = 45.0;
  std::optional<std::filesystem::path> picture, profile;
  std::optional<double> height, radius_min, radius_max, step;
  bool sphere = false;
  bool json = false;
  bool stats = false;
};

/// Progress of a training by stages, on standard error. The stages' durations vary between scenes, so it estimates no
/// time left.
class StagedProgress {
 public:
  bool at(TrainStage stage, double done) {
    if (!progress_ || stage != stage_) {
      progress_.emplace(std::string("training: ") + words::stage(stage), "", Progress::Rate::uneven);
      stage_ = stage;
    }
    constexpr std::uint64_t whole = 1000;
    return progress_->goes_on(static_cast<std::uint64_t>(done * whole), whole);
  }

 private:
  std::optional<Progress> progress_;
  TrainStage stage_ = TrainStage::places;
};

/// The file of the profile; empty: none.
std::filesystem::path profile_file(const TrainVerbOptions& o) {
  if (o.scene.no_profile) return {};
  if (o.profile) {
    check_output("-o", *o.profile);
    return *o.profile;
  }
  const std::string& scene = o.scene.scenes.front().native();
  if (Store::is_address(scene))
    throw UsageError(scene, "no profile can be written beside an address; name a file by -o, or say --no-profile");
  std::filesystem::path beside = profile_path(o.scene.scenes);
  if (const std::optional<Obstacle> found = obstacle(beside))
    throw UsageError(
        Error::at(beside.string(), fmt::format("the profile {}: {}; name a file elsewhere by -o, or say --no-profile",
                                               beside.string(), found->what)));
  return beside;
}

/// Writes the profile, or reports why there is none to write.
void write_profile(const TrainVerbOptions& o, const std::filesystem::path& file, const SceneIdentity& identity,
                   TrainReport& report) {
  const Training& t = report.training;
  if (file.empty() || t.places == 0) return;
  if (t.paths.empty()) {
    tell(fmt::format("{} was not written: this training {}{}", file.string(),
                     t.complete ? "found no path" : "ended before it had learned anything", earlier_stays(file)));
  } else if (!t.complete && !o.profile && std::filesystem::exists(std::filesystem::symlink_status(file))) {
    tell(fmt::format("{} is left as it is: this training ended early", file.string()));
  } else {
    Profile learnt = profile_of(t, identity);
    learnt.frame = frame_to_keep(o.scene);
    if (o.profile) {
      write_profile(learnt, file, files::Naming::exact, profiles());
    } else {
      write_profile(learnt, file, files::Naming::beside, {});
    }
    report.profile = file;
    std::error_code none;
    report.is_beside = std::filesystem::equivalent(file, profile_path(o.scene.scenes), none);
  }
}

/// Sets the trained body: a person of a fixed height, or a sphere, which has none.
void describe_body(TrainVerbOptions& o) {
  if (o.train.mode == Mode::fly && !o.sphere) throw UsageError("--mode fly", flight_is_for_spheres);
  o.train.radius_min = o.radius_min.value_or(o.train.radius_min);
  o.train.step = o.step.value_or(o.train.step);
  if (o.sphere) {
    o.train.radius_max = o.radius_max.value_or(o.train.radius_max);
    return;
  }
  o.train.height = o.height.value_or(default_height(o.train.radius_min, false));
  if (o.step) demand_possible_step(*o.step, o.train.height);
  constexpr double least_above_knee = 0.1;  // m
  const double step = std::min(o.train.step, step_limit(o.train.height));
  if (o.train.height <= step + least_above_knee)
    throw UsageError(fmt::format("--height {:g} with a step of {:g} m", o.train.height, step),
                     "nothing is left above the knee; take a smaller --step, or --sphere");
  const double widest = 0.5 * o.train.height;
  if (o.radius_max && *o.radius_max > widest)
    throw UsageError(fmt::format("--radius-max {:g}", *o.radius_max),
                     fmt::format("a body {:g} m high has a radius of at most {:g} m; take a larger --height, or "
                                 "--sphere",
                                 o.train.height, widest));
  o.train.radius_max = o.radius_max.value_or(std::min(o.train.radius_max, widest));
}

ExitStatus train(TrainVerbOptions o) {
  o.train.mode = o.mode.value_or(Mode::walk);
  o.train.method = o.method == "paper" ? Method::paper : Method::interval;
  o.train.threads = o.scene.threads;
  describe_body(o);
  if (o.radius_min.value_or(0.0) > o.train.radius_max)
    throw UsageError(
        fmt::format("--radius-min {:g}", *o.radius_min),
        fmt::format("the largest radius is {:g} m; take a smaller one, or a larger --radius-max or --height",
                    o.train.radius_max));
  o.scene.check_there();
  if (o.scene.no_profile && o.profile)
    throw UsageError("-o and --no-profile", "they exclude each other; leave one out");
  const std::filesystem::path profile = profile_file(o);
  take_kept_frame(o.scene);
  if (o.picture) check_output("--picture", *o.picture);
  const NamedFile outputs[] = {{"-o", o.profile.value_or(""), profiles()}, {"--picture", o.picture.value_or("")}};
  demand_no_overwriting(named_scenes(o.scene.scenes), outputs);
  // -o may name the scene's own profile, in any spelling.
  const NamedFile kept{"the profile", profile_path(o.scene.scenes)};
  demand_no_overwriting({&kept, 1}, {&outputs[1], 1});
  std::optional<draw::PictureFile> drawing;
  if (o.picture) drawing.emplace(*o.picture, draw::PictureFile::Views::in_metres);
  const Surveyed scene = survey_scene(o.scene, o.slope);
  constexpr double narrow_door = 0.6;  // m: width of a person without clearance
  check_spacing(scene, o.train.spacing, narrow_door);
  TrainReport report{o.scene.names(), scene.survey.triangles(), o.train, {}, {}, {}, {}};
  report.frame = frame_of(o.scene);
  {
    StagedProgress progress;
    o.train.progress = [&](TrainStage stage, double done) { return progress.at(stage, done); };
    report.training = train(scene.survey, o.train);
    o.train.progress = {};
  }
  give_time_to_write(longest_writing);
  for (const words::Decisive& d : words::decisive(report.training))
    report.names.push_back(scene.names_at(d.point, d.direction, d.width));
  Unwritten unwritten;
  unwritten.attempt([&] { write_profile(o, profile, scene.identity, report); });
  print_report(o.json, json_report(report),
               text_report(report) + kept_frame_line(o.scene) + (o.stats ? stats_report(report) : ""));
  if (drawing && !report.training.complete) {
    tell(fmt::format("{} was not drawn: this training ended early{}", o.picture->string(), earlier_stays(*o.picture)));
  } else if (drawing) {
    const std::vector<draw::OpeningView> views = views_of(report);
    // Without a deciding opening, draw the answer alone.
    const std::string text = views.empty() ? words::answer(report.training, o.train) : std::string();
    unwritten.attempt([&] {
      drawing->draw([&] { return draw::opening_sheet(o.scene.file_names(), views, scene.survey.meshes(), text); });
    });
  }
  unwritten.raise();
  if (interrupted() || !report.training.complete) return failed;
  return report.training.feasible ? done : answer_no;
}

constexpr const char* train_help =
    R"(Training plans paths between the scene's rooms. The narrowest opening on them gives the largest
radius; the widest crack gives the smallest radius. Bodies of these sizes then walk the paths as proof. The result is
saved beside the scene, in SCENE.roam.json, for `roam walk` and `roam view`. Exit status 0 if one body without a
support disc serves all paths, else 3; the report then says why, where, and which body to use. Ctrl-C ends training with
the best result so far.

--method paper is that of Xie and Niu: bodies roam the paths in turn. The radius shrinks where a body cannot enter and
grows where it falls. Theirs are spheres.

Examples:
  roam train gallery.ply
  roam train gallery.ply --method paper --sphere --seed 7 --json --no-profile
  roam train mine.dae --height 1.7 --picture decides.svg
  roam train pipes.ply --mode fly --sphere --radius-max 0.8
)";

}  // namespace

void add_train(CLI::App& program, Run& run) {
  CLI::App* verb =
      program.add_subcommand("train", "Find the sizes of a body that get everywhere in a scene and fall nowhere");
  verb->footer(train_help);
  const auto options = std::make_shared<TrainVerbOptions>();
  TrainVerbOptions& o = *options;
  add_surveyed_to(*verb, o.scene);
  verb->option_defaults()->group("Body, in metres");
  verb->add_option("--height", o.height, "Whole height (default: a person's 1.8)")
      ->check(from_to(0.1, 100.0))
      ->type_name("H");
  add_sphere_to(*verb, o.sphere);
  verb->add_option("--radius-min", o.radius_min, "Smallest radius; narrower openings are ignored (default: 0.15)")
      ->check(from_to(0.01, 100.0))
      ->type_name("R");
  verb->add_option("--radius-max", o.radius_max, "Largest radius, at most H / 2 (default: 1, or H / 2 if less)")
      ->check(from_to(0.01, 100.0))
      ->type_name("R");
  verb->add_option(
          "--support-max", o.train.support_max,
          "Largest radius of the support disc, which carries the body over cracks; wider cracks are open drops "
          "(default: 1)")
      ->check(from_to(0.1, 100.0))
      ->type_name("R");
  add_mode_to(*verb, o.mode, {Mode::walk, Mode::fly}, "walk: on the ground; fly: through the air (default: walk)");
  verb->add_option("--step", o.step, "Highest step (stair, kerb) that the body climbs, at most H / 2 (default: 0.3)")
      ->check(from_to(0.0, 100.0))
      ->type_name("M");
  verb->add_option("--slope", o.slope, "Slope that the body climbs, in degrees (default: 45)")
      ->check(from_to(0.0, 89.0))
      ->type_name("DEG");
  verb->option_defaults()->group("Method");
  verb->add_option("--method", o.method,
                   "interval: compute sizes from the scene; paper: try sizes, as Xie and Niu do (default: interval)")
      ->check(one_of({"interval", "paper"}))
      ->type_name("METHOD");
  verb->add_option("--paths", o.train.paths, "Number of paths (default: 5, or one for each dead end if these are more)")
      ->check(from_to<std::int64_t>(1, 10'000))
      ->type_name("N");
  verb->add_option("--seed", o.train.seed, "Seed of the paths: the same seed, the same result (default: 1)")
      ->check(seed())
      ->type_name("S");
  verb->add_option("--spacing", o.train.spacing,
                   "Metres between tested places (default: 0.2); openings under 0.7 of it may be missed")
      ->check(from_to(0.02, 100.0))
      ->type_name("M");
  verb->option_defaults()->group("Results");
  verb->add_option("--picture", o.picture, "Draw the openings that decide (.svg, .png or .dxf)")->type_name("FILE");
  verb->add_option("-o,--output", o.profile, "Write the profile to this file (default: SCENE.roam.json)")
      ->type_name("FILE");
  verb->get_option("--no-profile")->description("Neither read nor write SCENE.roam.json");
  verb->add_flag("--stats", o.stats, "Print the interval, all regions, parts and counts, too");
  verb->add_flag("--json", o.json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return train(*options); }; });
}

}  // namespace roam::app
