// roam walk: moves a body through a scene and reports the result.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <nlohmann/json.hpp>

#include "cli/histogram.h"
#include "cli/interrupt.h"
#include "cli/output_file.h"
#include "cli/progress.h"
#include "cli/standard_streams.h"
#include "cli/tell.h"
#include "cli/trace_file.h"
#include "draw/picture_file.h"
#include "draw/walk_sheet.h"
#include "measure/along.h"
#include "measure/slope.h"
#include "roam/error.h"
#include "roam/path_file.h"
#include "roam/route.h"
#include "roam/wander.h"
#include "scenes/arrivals.h"
#include "scenes/frame.h"
#include "scenes/open_scene.h"
#include "store/meshes.h"
#include "verbs.h"
#include "verify/verify_stored.h"
#include "walk/against.h"
#include "walk/certificate.h"
#include "walk/options.h"
#include "walk/report.h"
#include "words/measures.h"

namespace roam::app {
namespace {

/// The triangle in the scene; empty, after a note, if that part of a store cannot be read. A name costs no report.
std::optional<SourceTriangle> source_of(const OpenScene& scene, TriangleId triangle) {
  try {
    return scene.source(triangle);
  } catch (const Error& error) {
    tell(std::string("note: ") + error.what());
    return std::nullopt;
  }
}

/// Records every step of a walk.
class Recorder {
 public:
  /// `around`: see reach_of_steps().
  Recorder(const WalkOptions& options, OpenScene& scene, double around, double expected_steps)
      : options_(options),
        scene_(scene),
        around_(around),
        progress_(std::in_place, to_string(options.walker_mode()) + std::string("ing"), "steps"),
        expected_steps_(static_cast<std::uint64_t>(expected_steps)) {
    if (!options.trace.empty()) trace_.emplace(options.trace);
  }

  /// The walker must outlive the recorder's steps.
  void start(const Walker& walker) {
    along_.emplace(walker.space(), options_.settings, walker.mode());
    along_->put(walker.position());
    reach_ = measure::Room(walker.space(), options_.settings, walker.mode()).reach();
    take(walker.report(), 0.0);
  }

  /// Runs one step and records it.
  template <class Step>
  const StepReport& step(const Walker& walker, const Step& run) {
    const auto begin = std::chrono::steady_clock::now();
    const StepReport& report = run();
    const auto took = std::chrono::steady_clock::now() - begin;
    nanoseconds_.add(std::chrono::duration<double, std::nano>(took).count());
    const double begun = tally_.simulated;
    tally_.add_step(report);
    take(report, begun);
    along_->add(report);  // at once: a pager drops the tiles behind the body
    if (walker.mode() != Mode::ghost) scene_.wait_around(walker.body(), report.to, walker.velocity(), around_);
    goes_on_ = progress_->goes_on(tally_.steps, std::max(tally_.steps, expected_steps_));
    return report;
  }

  /// False after Ctrl-C.
  [[nodiscard]] bool goes_on() const { return goes_on_; }
  void finish() {
    progress_.reset();  // removes the progress line before the report
    if (trace_) trace_->close();
  }
  [[nodiscard]] StepTimes times() const {
    return {nanoseconds_.quantile(0.5), nanoseconds_.quantile(0.99), nanoseconds_.largest()};
  }
  /// Adds the measurements along the way.
  void describe(words::EndedWalk& report, const OpenScene& scene) const {
    report.narrowest = along_->narrowest();
    report.lowest = along_->lowest();
    report.ducked = along_->ducked();
    if (report.mode != Mode::ghost) report.reach = reach_;
    if (!report.narrowest || scene.objects() <= 1) return;
    if (const auto left = source_of(scene, report.narrowest->left_triangle)) report.left = left->object;
    if (const auto right = source_of(scene, report.narrowest->right_triangle)) report.right = right->object;
  }
  [[nodiscard]] const verification::PieceLog& pieces() const { return pieces_; }
  [[nodiscard]] const draw::Record& record() const { return record_; }

 private:
  /// `begun`: time at the start of the step, in s.
  void take(const StepReport& report, double begun) {
    if (trace_) trace_->add(tally_.steps, begun, report);
    if (options_.keeps_moves()) verification::append_pieces(pieces_, tally_.steps, report);
    if (!options_.picture.empty()) append(record_, report, tally_.steps == 0);
  }

  const WalkOptions& options_;
  OpenScene& scene_;
  double around_;
  std::optional<Progress> progress_;
  std::uint64_t expected_steps_;
  bool goes_on_ = true;
  std::optional<TraceFile> trace_;
  Histogram nanoseconds_;
  verification::PieceLog pieces_;
  draw::Record record_;
  Tally tally_;
  std::optional<measure::Along> along_;
  double reach_ = 0.0;  ///< m: measuring distance around the body
};

/// Moves along the waypoints without collision, to show where a path leads.
RouteResult haunt(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options, Recorder& recorder) {
  RouteResult result;
  result.waypoints = 1;
  for (const Vec3& waypoint : waypoints.subspan(1)) {
    double seconds = glm::distance(walker.position(), waypoint) / options.speed;
    while (seconds > 0.0 && recorder.goes_on()) {
      const double dt = std::min(seconds, options.dt);
      const Vec3 velocity = (waypoint - walker.position()) / seconds;
      result.add_step(
          recorder.step(walker, [&]() -> const StepReport& { return walker.step({.velocity = velocity}, dt); }));
      seconds = dt < seconds ? seconds - dt : 0.0;
    }
    if (!recorder.goes_on()) break;
    ++result.waypoints;
  }
  result.end = walker.position();
  return result;
}

RouteResult follow(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options, Recorder& recorder) {
  Route route(walker, waypoints, options);
  recorder.start(walker);
  while (!route.done() && recorder.goes_on()) {
    recorder.step(walker, [&]() -> const StepReport& { return route.advance(); });
  }
  return route.result();
}

RouteResult roam_about(Walker& walker, const RouteOptions& options, double seconds, Recorder& recorder) {
  Wander wander(walker, {.speed = options.speed, .dt = options.dt, .seconds = seconds});
  recorder.start(walker);
  while (!wander.done() && recorder.goes_on()) {
    wander.look();
    if (wander.done()) break;
    recorder.step(walker, [&]() -> const StepReport& { return wander.advance(); });
  }
  return wander.result();
}

/// The whole walk, or the part before Ctrl-C.
RouteResult go(const WalkOptions& options, Walker& walker, std::span<const Vec3> path, Recorder& recorder) {
  if (options.wander) return roam_about(walker, options.route, *options.wander, recorder);
  if (walker.mode() != Mode::ghost) return follow(walker, path, options.route, recorder);
  recorder.start(walker);
  return haunt(walker, path, options.route, recorder);
}

/// The title of a picture.
std::string title(const WalkOptions& options) {
  const std::string text = options.scene.file_names();
  return options.wander ? text + fmt::format(", wandering for {:g} s", *options.wander)
                        : text + " along " + options.path.filename().string();
}

/// The scene of --against is added to `sum`.
verification::Verification verified(const WalkOptions& options, const OpenScene& scene,
                                    const verification::PieceLog& pieces, checking::SceneSum& sum) {
  if (!options.against.scenes.empty()) {
    Progress progress("verifying against " + options.against.names(), "B");
    return verify_against(
        options.against, scene, pieces,
        [&](std::uint64_t done, std::uint64_t total) { return progress.goes_on(done, total) || has_time(); }, sum);
  }
  Progress progress("verifying", "pieces");
  const auto goes_on = [&](std::uint64_t done) { return progress.goes_on(done, pieces.size()) || has_time(); };
  return scene.store() ? verify(*scene.store(), pieces, goes_on) : verify(scene.loaded().meshes, pieces, goes_on);
}

/// Maximum bytes per segment while a picture is made.
constexpr std::uint64_t bytes_a_segment = 2048;

draw::Measured measured(OpenScene& scene, const WalkReport& report, const draw::Record& record) {
  // The pager has dropped the tiles along the path; a picture would show them as unknown. If Ctrl-C ended the walk,
  // there is no time to load them again.
  const auto arrive = [&](const Vec3& place, double reach) {
    stop_if_interrupted();
    scene.wait_around(Body{}, place, Vec3(0.0), reach);
  };
  return draw::measure(scene.space(), report, record, report.interrupted ? draw::Arrive() : draw::Arrive(arrive));
}

/// The drawing of a measured walk. Call it after OpenScene::leave if the scene is a store.
draw::Sheet sheet(const WalkOptions& options, const OpenScene& scene, const WalkReport& report,
                  const draw::Record& record, const draw::Measured& measured) {
  const auto triangles = [&](const Box& box, const std::function<void(std::span<const Mesh>)>& take) {
    if (!scene.store()) return take(scene.loaded().meshes);
    const auto missing = [](const std::string& what) { tell(fmt::format("note: left out of the picture: {}", what)); };
    store::each_mesh(
        *scene.store(), box,
        [&](const Mesh& mesh) {
          if (!report.interrupted) stop_if_interrupted();
          take({&mesh, 1});
        },
        missing);
  };
  const auto fit = static_cast<std::size_t>(scene.memory() / bytes_a_segment);
  return draw::make_sheet({title(options), report, record, measured, scene.walked_bounds(), triangles,
                           scene.store() ? std::min(fit, draw::usual_segments) : draw::usual_segments,
                           report.triangles});
}

/// Verifies all moves, unless Ctrl-C comes before.
void check_moves(const WalkOptions& options, const OpenScene& scene, const verification::PieceLog& pieces,
                 WalkReport& report, checking::SceneSum& sum) {
  const auto begin = std::chrono::steady_clock::now();
  finishes(fmt::format("the {} moves were not all verified", pieces.size()),
           [&] { report.verified = verified(options, scene, pieces, sum); });
  report.verify_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

ExitStatus walk(WalkOptions options) {
  check_way(options);
  take_kept_frame(options.scene);
  if (!options.against.scenes.empty()) prepare_against(options.scene, options.against);
  RecordedPath recorded = load_recorded_path(options.path);
  options.recorded = recorded.body;
  take_profile(options);
  options.settings = walker_settings(options);
  check_outputs(options);
  if (options.route.dt < Route::shortest_step) throw UsageError("--dt", "a step takes 1e-6 s at least");
  const Mode mode = options.walker_mode();
  if (options.keeps_moves() && mode == Mode::ghost) {
    throw UsageError(options.checks() ? "--verify with --mode ghost" : "--certify with --mode ghost",
                     "a ghost passes through walls, so there is nothing to verify");
  }
  if (options.wander && mode == Mode::ghost) {
    throw UsageError("--wander with --mode ghost", "a ghost meets nothing that could turn it; give it a --path");
  }
  const bool stored = options.scene.name_a_store();
  std::optional<SceneFrame> frame = stored ? std::nullopt : frame_of(options.scene);
  const std::vector<Vec3> path = positions(recorded.waypoints());
  recorded.places = {};  // they take four times as much
  demand_frame(recorded, frame, options.scene);
  if (options.recorded) {
    const std::string other = compare(*options.recorded, options.settings, mode);
    if (!other.empty()) tell("note: " + other);
  }
  std::optional<tbb::global_control> limit;
  if (options.scene.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.scene.threads));
  }
  std::optional<draw::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture, draw::PictureFile::Views::in_metres);
  const bool needs_triangles = options.verify || drawing || !options.certify.empty();
  OpenScene scene(options.scene, needs_triangles ? Source::keep : Source::release);
  if (stored) {
    frame = frame_of(*scene.store());
    demand_frame(recorded, frame, options.scene);
  }
  if (!options.against.scenes.empty() && scene.store()) read_as(options.against, *scene.store());
  if (options.profile) {
    demand_belongs(*options.profile, scene.store() ? identity_of(scene.store()->info()) : scene.loaded().identity,
                   options.scene.names());
    tell(describe(*options.profile));
  }
  const std::string size = words::note_on_size(options.settings, scene.bounds());
  if (!size.empty()) tell("note: " + size);

  const double seconds = options.wander ? *options.wander : path_length(path) / options.route.speed;
  const Vec3 start = !options.from.empty() ? Vec3(options.from[0], options.from[1], options.from[2])
                     : options.wander      ? scene.start(options.settings, mode)
                                           : path.front();
  const double around = reach_of_steps(options, scene.space());
  Recorder recorder(options, scene, around, seconds / options.route.dt);
  scene.wait_around(Body::capsule(options.settings.radius, options.settings.height), start, Vec3(0.0), around);
  Walker walker(scene.space(), options.settings, mode, start);
  if (options.profile) walker.set_regions(options.profile->profile.regions);
  WalkReport report;
  report.result = go(options, walker, path, recorder);
  give_time_to_write(longest_writing);
  report.interrupted = !recorder.goes_on();
  if (report.interrupted) report.result.end = walker.position();
  Unwritten unwritten;
  unwritten.attempt([&] { recorder.finish(); });

  report.scene = options.scene.names();
  report.frame = frame;
  report.triangles = scene.triangles();
  report.mode = mode;
  report.settings = options.settings;
  report.body = walker.body();
  report.bounds = scene.bounds();
  if (options.profile) report.profile = options.profile->file.string();
  report.waypoints = path.size();
  report.eye = walker.eye();
  if (report.result.outcome == Outcome::fell) {
    report.slope = measure::slope_below(scene.space(), walker.body(), walker.position());
  }
  if (report.result.blocked_at) {
    // Unknown space has no number in the scene; the report gives the reason instead.
    const TriangleId triangle = report.result.blocked_at->triangle;
    if (report.result.outcome == Outcome::held) {
      report.object = scene.why_unknown(triangle);
    } else if (const auto source = source_of(scene, triangle)) {
      report.object = source->object;
      report.result.blocked_at->triangle = source->scene;
    }
  }
  recorder.describe(report, scene);
  report.paging = scene.paging();
  report.times = recorder.times();
  std::optional<draw::Measured> seen;
  if (drawing) {
    finishes(options.picture.string() + " was not drawn", [&] { seen = measured(scene, report, recorder.record()); });
  }
  scene.leave();
  checking::SceneSum sum;
  if (options.checks()) check_moves(options, scene, recorder.pieces(), report, sum);
  unwritten.attempt([&] {
    const bool written = certify(options.certify, scene, recorder.pieces(), report.verified ? &sum : nullptr);
    const auto freed = words::first(report.result, EventKind::freed);
    if (!written || !freed) return;
    tell(fmt::format("note: the certificate begins at {}, where the body was put: it did not fit where it should start",
                     words::exactly_at(*freed)));
  });
  const std::string text =
      text_report(report) + kept_frame_line(options.scene) + (options.stats ? stats_report(report) : "");
  print_report(options.json, json_report(report), text, options.trace);
  if (seen) {
    // A walk that Ctrl-C ended is drawn, too, if that takes little time: the watchdog may end the program there.
    if (report.interrupted) unwritten.raise();
    unwritten.attempt([&] { drawing->draw([&] { return sheet(options, scene, report, recorder.record(), *seen); }); });
  }
  unwritten.raise();
  if (interrupted()) return failed;
  if (report.verified) {
    verification::demand_all_read(*report.verified, options.scene.names(), "check it by --against SCENE");
  }
  return report.result.outcome == Outcome::reached ? done : answer_no;
}

constexpr const char* walk_help =
    R"(The report says how the walk ended: reached, blocked (where and by what), fell, left_scene
or held; then the narrowest place of the way and the headroom. Exit status 0 if the end is reached, 3 if not. After
Ctrl-C, report and trace of the way so far are still written, and the picture if that takes under 2 s (status 130).

A path file has one waypoint `x y z` in each line, or the lines `t x y z qx qy qz qw` that osgViewer records. Times and
rotations are ignored: --speed and --dt set the pace. Positions are of the body's centre. A waypoint is reached if
it is in the body; on foot also at most the step height above or below it, or in sight at most 2 m above its feet. A path that `roam view` recorded
names its body and mode; --radius, --sphere and --mode override them.

The body is a person of radius 0.3 m and height 1.8 m, or the one that `roam train` saved beside the scene, in
SCENE.roam.json. The saved body is smaller in places where only a smaller one fits; other options of the body change
it. A profile of another scene is refused.

Examples:
  roam walk mine.dae --path tour.path
  roam walk gallery.ply --path gallery-straight.path --mode fly --speed 50 --verify
  roam walk house.glb --path in.path --radius 0.25 --height 1.8 --json --trace in.csv
  roam walk house.glb --path in.path --picture in.svg
  roam walk Terrain/ --wander 60 --verify
  roam walk mine.dae --path tour.path --certify tour.certificate
)";

}  // namespace

void add_walk(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("walk", "Send a body along a path through a scene and report how it went");
  verb->footer(walk_help);
  const auto options = std::make_shared<WalkOptions>();
  options->add_to(*verb);
  verb->callback([options, &run] { run = [options] { return walk(*options); }; });
}

}  // namespace roam::app
