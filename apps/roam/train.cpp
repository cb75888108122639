// roam train: which sizes of a body serve a scene.
#include "roam/train.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>

#include "cli/interrupt.h"
#include "cli/numbers.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/tell.h"
#include "draw/picture.h"
#include "roam/error.h"
#include "scenes/surveyed.h"
#include "train/report.h"
#include "verbs.h"
#include "words/training.h"

namespace roam::app {
namespace {

struct TrainVerbOptions {
  SceneOptions scene;
  TrainOptions train;
  std::string mode = "walk", method = "interval";
  double slope = 45.0;
  std::optional<std::filesystem::path> picture, profile;
  bool no_profile = false;
  bool json = false;
  bool stats = false;
};

/// A whole number from `least` to `most`.
CLI::Validator whole_number(std::int64_t least, std::int64_t most) {
  return {[=](std::string& text) {
            std::int64_t value = 0;
            const bool within = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
            return within ? std::string() : fmt::format("'{}' is not a whole number from {} to {}", text, least, most);
          },
          ""};
}

/// Training in the stages that it names, on standard error. Stages take what they take in each scene: no time left
/// follows from the share that is done.
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

/// Where the profile goes; empty: nowhere.
std::filesystem::path profile_file(const TrainVerbOptions& o) {
  if (o.no_profile) return {};
  if (o.profile) {
    check_output(o.scene.scenes, "-o", *o.profile);
    return *o.profile;
  }
  const std::filesystem::path beside = profile_path(o.scene.scenes);
  if (const std::optional<Obstacle> found = obstacle(beside))
    throw UsageError(fmt::format("the profile {}: {}; name a file elsewhere by -o, or say --no-profile",
                                 beside.string(), found->what));
  return beside;
}

/// Nothing where there is none to write, and why.
void write_profile(const TrainVerbOptions& o, const std::filesystem::path& file, const SceneIdentity& identity,
                   TrainReport& report) {
  const Training& t = report.training;
  if (file.empty() || t.places == 0) return;
  const bool learned = t.complete || !t.paths.empty();
  if (!learned) {
    tell(fmt::format("{} was not written: this training ended before it had learned anything", file.string()));
  } else if (!t.complete && !o.profile && std::filesystem::exists(file)) {
    tell(fmt::format("{} is left as it is: this training ended early", file.string()));
  } else {
    save_profile(profile_of(t, identity), file);
    report.profile = file;
  }
}

ExitStatus train(TrainVerbOptions o) {
  o.train.mode = o.mode == "fly" ? Mode::fly : Mode::walk;
  o.train.method = o.method == "paper" ? Method::paper : Method::interval;
  o.train.threads = o.scene.threads;
  if (o.train.mode == Mode::fly && o.train.height > 0.0)
    throw UsageError("--height with --mode fly: what flies is a sphere; leave it out");
  constexpr double least_above_knee = 0.1;  // m
  if (o.train.height > 0.0 && o.train.height <= o.train.step + least_above_knee)
    throw UsageError(fmt::format(
        "--height {:g} with --step {:g}: nothing is left above the knee; take a smaller step or leave --height out",
        o.train.height, o.train.step));
  o.scene.check_there();
  if (o.no_profile && o.profile) throw UsageError("-o and --no-profile: one of them");
  const std::filesystem::path profile = profile_file(o);
  if (o.picture) check_output(o.scene.scenes, "--picture", *o.picture);
  if (o.picture) draw::check_picture(*o.picture);
  std::optional<draw::PictureFile> drawing;
  if (o.picture) drawing.emplace(*o.picture);
  const Surveyed scene = survey_scene(o.scene, o.slope);
  constexpr double narrow_door = 0.6;  // m: a person with nothing to spare
  check_spacing(scene, o.train.spacing, narrow_door);
  TrainReport report{o.scene.names(), scene.survey.triangles(), o.train, {}, {}, {}};
  {
    StagedProgress progress;
    o.train.progress = [&](TrainStage stage, double done) { return progress.at(stage, done); };
    report.training = train(scene.survey, o.train);
  }
  for (const Decisive& d : report.training.decisive)
    report.names.push_back(scene.names_at(d.point, d.direction, d.width));
  Unwritten unwritten;
  unwritten.attempt([&] { write_profile(o, profile, scene.identity, report); });
  if (o.json) {
    print(json_report(report));
  } else {
    print(o.stats ? text_report(report) + stats_report(report) : text_report(report));
  }
  if (drawing && interrupted()) {
    tell(fmt::format("{} was not drawn: this training ended early", o.picture->string()));
  } else if (drawing) {
    const std::vector<draw::OpeningView> views = views_of(report);
    // Where nothing decides there is nothing to draw but what was found.
    drawing->write(draw::opening_sheet(o.scene.file_names(), views, scene.survey.meshes(),
                                       views.empty() ? words::answer(report.training, o.train) : std::string()));
  }
  unwritten.raise();
  if (!report.training.complete) return failed;
  return report.training.feasible ? done : answer_no;
}

constexpr const char* help =
    "Finds the sizes of a body that go everywhere in a scene and fall nowhere: paths between its rooms, the narrowest\n"
    "opening on them (the largest radius), the widest crack they cross (the smallest), proven by bodies that walk "
    "them.\n"
    "What it answers is kept beside the scene, in SCENE.roam.json, for `roam walk` and `roam view`. Exit status 0 "
    "when\n"
    "one body serves all paths, 3 when none does: then the report says why, where and what to use. Ctrl-C ends it "
    "with\n"
    "what is known by then, marked as such.\n\n"
    "--method paper is Xie and Niu's: paths are roamed in turn with a radius that goes down where it cannot enter and\n"
    "up where it falls. Without --height the body is their sphere.\n\n"
    "Examples:\n"
    "  roam train gallery.ply --height 1.8\n"
    "  roam train gallery.ply --method paper --seed 7 --json --no-profile\n"
    "  roam train mine.dae --height 1.9 --picture decides.svg\n"
    "  roam train pipes.ply --mode fly --radius-max 0.8\n";

}  // namespace

void add_train(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("train", "Finds which sizes of a body serve a scene");
  verb->footer(help);
  const auto options = std::make_shared<TrainVerbOptions>();
  TrainVerbOptions& o = *options;
  add_surveyed_to(*verb, o.scene);
  verb->add_option("--paths", o.train.paths, "To plan (default: 5, or one for each dead end where there are more)")
      ->check(whole_number(1, 10'000))
      ->type_name("N");
  verb->add_option("--seed", o.train.seed, "Of the paths: the same seed, the same answer (default: 1)")
      ->check(whole_number(0, std::numeric_limits<std::int64_t>::max()))
      ->type_name("S");
  verb->add_option("--radius-min", o.train.radius_min,
                   "In metres: what lets less through decides nothing and gets no region (default: 0.15)")
      ->check(from_to(0.01, 100.0))
      ->type_name("R");
  verb->add_option("--radius-max", o.train.radius_max, "The largest radius looked for, in metres (default: 1)")
      ->check(from_to(0.01, 100.0))
      ->type_name("R");
  verb->add_option("--support-max", o.train.support_max,
                   "The largest foot, in metres: wider cracks are open drops (default: 1)")
      ->check(from_to(0.1, 100.0))
      ->type_name("R");
  verb->add_option("--height", o.train.height, "Whole height, in metres (default: a sphere)")
      ->check(from_to(0.1, 100.0))
      ->type_name("H");
  verb->add_option("--mode", o.mode, "walk: on the ground; fly: through the air (default: walk)")
      ->check(CLI::IsMember({"walk", "fly"}))
      ->type_name("MODE");
  verb->add_option("--method", o.method, "interval: from the scene; paper: by trials (default: interval)")
      ->check(CLI::IsMember({"interval", "paper"}))
      ->type_name("METHOD");
  verb->add_option("--step", o.train.step, "What walking steps up and down, in metres (default: 0.3)")
      ->check(from_to(0.0, 100.0))
      ->type_name("M");
  verb->add_option("--slope", o.slope, "What walking climbs, in degrees (default: 45)")
      ->check(from_to(0.0, 89.0))
      ->type_name("DEG");
  verb->add_option("--spacing", o.train.spacing,
                   "Between the places that are looked at, in metres (default: 0.2); openings under 0.7 of it may be "
                   "overlooked")
      ->check(from_to(0.02, 100.0))
      ->type_name("M");
  verb->add_option("--picture", o.picture, "Draw what decides, as .svg or .png")->type_name("FILE");
  verb->add_option("-o,--output", o.profile, "Write the profile there (default: SCENE.roam.json)")->type_name("FILE");
  verb->add_flag("--no-profile", o.no_profile, "Write no profile");
  verb->add_flag("--stats", o.stats, "Print the interval, all regions, parts and counts, too");
  verb->add_flag("--json", o.json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return train(*options); }; });
}

}  // namespace roam::app
