// roam walk: sends a body through a scene and tells how it went.
#include <fmt/format.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>
#include <utility>

#include "interrupt.h"
#include "open_scene.h"
#include "picture/picture.h"
#include "progress.h"
#include "recorded_body.h"
#include "roam/error.h"
#include "roam/path_file.h"
#include "roam/route.h"
#include "verbs.h"
#include "walk_record.h"
#include "walk_report.h"
#include "wander.h"

namespace roam::app {
namespace {

const CLI::Validator positive(
    [](const std::string& text) {
      double value = 0.0;
      const bool number = CLI::detail::lexical_cast(text, value) && std::isfinite(value);
      return number && value > 0.0 ? std::string() : "'" + text + "' is not a number greater than 0";
    },
    "");

struct WalkOptions {
  SceneOptions scene;
  std::filesystem::path path;
  std::optional<double> wander;  ///< seconds
  std::vector<double> from;      ///< where wandering starts: x, y, z, or nothing
  std::optional<std::string> mode;
  WalkerSettings settings;
  std::optional<double> radius, height, eye, step, slope;
  std::optional<RecordedBody> recorded;  ///< that the path was recorded with
  RouteOptions route;
  std::filesystem::path trace;
  std::filesystem::path picture;
  bool verify = false;
  StoreOptions store;
  SceneOptions against;  ///< the scene that a store was made of
  bool json = false;

  /// Whether every move is checked against triangles.
  [[nodiscard]] bool checks() const { return verify || !against.scenes.empty(); }
  [[nodiscard]] Mode walker_mode() const {
    if (!mode) return recorded ? recorded->mode : Mode::walk;
    return *mode == "fly" ? Mode::fly : *mode == "ghost" ? Mode::ghost : Mode::walk;
  }
};

/// The options as they are meant: the body that recorded the path, where its radius is left out; the height that
/// follows from the radius, the eye that follows from the height. Throws UsageError for what cannot be.
WalkerSettings walker_settings(const WalkOptions& options) {
  constexpr double sphere = 2.0;  // height of a sphere in radii
  WalkerSettings settings = options.settings;
  if (options.recorded && !options.radius) {
    const RecordedBody& body = *options.recorded;
    settings.radius = body.radius;
    settings.height = options.height.value_or(body.height);
    settings.eye = options.eye.value_or(std::min(body.eye, settings.height));
    settings.step = options.step.value_or(std::min(body.step, 0.5 * settings.height));
    settings.slope_degrees = body.slope_degrees;
  } else {
    settings.radius = options.radius.value_or(settings.radius);
    settings.height = options.height.value_or(sphere * settings.radius);
    settings.eye = options.eye.value_or(std::min(settings.eye, settings.height));
    settings.step = options.step.value_or(std::min(settings.step, 0.5 * settings.height));
  }
  settings.slope_degrees = options.slope.value_or(settings.slope_degrees);
  settings.speed = options.route.speed;
  try {
    check(settings);
  } catch (const Error& error) {
    throw UsageError(error.what());
  }
  return settings;
}

/// Takes down every step while a walk goes on.
class Recorder {
 public:
  Recorder(const WalkOptions& options, OpenScene& scene, double expected_steps)
      : options_(options),
        scene_(scene),
        progress_(name(options.walker_mode()) + std::string("ing"), "steps"),
        expected_steps_(static_cast<std::uint64_t>(expected_steps)) {
    if (!options.trace.empty()) trace_.emplace(options.trace);
  }

  void start(const StepReport& report) { take(report); }

  /// Runs one step and takes it down.
  template <class Step>
  const StepReport& step(const Walker& walker, const Step& run) {
    const auto begin = std::chrono::steady_clock::now();
    const StepReport& report = run();
    const auto took = std::chrono::steady_clock::now() - begin;
    nanoseconds_.push_back(static_cast<std::uint32_t>(
        std::min<std::int64_t>(std::chrono::duration_cast<std::chrono::nanoseconds>(took).count(),
                               std::numeric_limits<std::uint32_t>::max())));
    ++steps_;
    take(report);
    time_ += report.elapsed;
    scene_.follow(walker);
    progress_.at(steps_, std::max(steps_, expected_steps_));
    return report;
  }

  void finish() {
    if (trace_) trace_->close();
  }
  [[nodiscard]] StepTimes times() const { return summarize(nanoseconds_); }
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const picture::Record& record() const { return record_; }

 private:
  void take(const StepReport& report) {
    if (trace_) trace_->add(steps_, time_, report);
    if (options_.checks() || !options_.picture.empty())
      append_pieces(pieces_, steps_, report);
    if (!options_.picture.empty()) append(record_, report, steps_ == 0);
  }

  const WalkOptions& options_;
  OpenScene& scene_;
  Progress progress_;
  std::uint64_t expected_steps_;
  std::optional<TraceFile> trace_;
  std::vector<std::uint32_t> nanoseconds_;
  std::vector<Piece> pieces_;
  picture::Record record_;
  std::uint64_t steps_ = 0;
  double time_ = 0.0;
};

double path_length(std::span<const Vec3> points) {
  double sum = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) sum += glm::distance(points[i - 1], points[i]);
  return sum;
}

/// Along the waypoints without collision: shows where a path leads.
RouteResult haunt(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options, Recorder& recorder) {
  RouteResult result;
  result.waypoints = 1;
  for (const Vec3& waypoint : waypoints.subspan(1)) {
    double seconds = glm::distance(walker.position(), waypoint) / options.speed;
    while (seconds > 0.0) {
      const double dt = std::min(seconds, options.dt);
      const Vec3 velocity = (waypoint - walker.position()) / seconds;
      const StepReport& report =
          recorder.step(walker, [&]() -> const StepReport& { return walker.step({.velocity = velocity}, dt); });
      result.length += glm::distance(report.from, report.to);
      result.simulated += dt;
      ++result.steps;
      seconds = dt < seconds ? seconds - dt : 0.0;
    }
    ++result.waypoints;
  }
  result.end = walker.position();
  return result;
}

RouteResult follow(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options, Recorder& recorder) {
  Route route(walker, waypoints, options);
  recorder.start(walker.report());
  while (!route.done()) recorder.step(walker, [&]() -> const StepReport& { return route.advance(); });
  return route.result();
}

/// Refuses to write an output over what is read.
void check_output(const WalkOptions& options, const char* option, const std::filesystem::path& output) {
  const auto is_output = [&](const std::filesystem::path& file) {
    std::error_code none;
    return !file.empty() && std::filesystem::equivalent(file, output, none);
  };
  if (output.empty()) return;
  const std::string what = std::string(option) + " " + output.string();
  for (const auto& scene : options.scene.scenes) {
    if (is_output(scene)) throw UsageError(what + " would overwrite the scene");
  }
  if (is_output(options.path)) throw UsageError(what + " would overwrite the path");
}

void check_outputs(const WalkOptions& options) {
  check_output(options, "--trace", options.trace);
  check_output(options, "--picture", options.picture);
  if (options.picture.empty()) return;
  if (!picture::is_picture(options.picture)) {
    throw UsageError("--picture " + options.picture.string() + ": a picture is an .svg or a .png, by its extension");
  }
  std::error_code none;
  if (std::filesystem::weakly_canonical(options.picture, none) ==
      std::filesystem::weakly_canonical(options.trace, none)) {
    throw UsageError("--picture " + options.picture.string() + " would overwrite the trace");
  }
}

/// What a picture is called.
std::string title(const WalkOptions& options) {
  std::string text;
  for (const auto& scene : options.scene.scenes) {
    // A folder may be given with a slash behind it.
    const auto name = scene.has_filename() ? scene.filename() : scene.parent_path().filename();
    text += (text.empty() ? "" : ", ") + name.string();
  }
  return options.wander ? text + fmt::format(", wandering for {:g} s", *options.wander)
                        : text + " along " + options.path.filename().string();
}

Verification verified(const WalkOptions& options, const OpenScene& scene, const std::vector<Piece>& pieces) {
  if (!options.against.scenes.empty()) {
    Progress progress("verifying against " + options.against.names(), "B");
    return verify_against(options.against, pieces,
                          [&](std::uint64_t done, std::uint64_t total) { return progress.goes_on(done, total); });
  }
  Progress progress("verifying", "pieces");
  return scene.verified(pieces, [&](std::uint64_t done) { return progress.goes_on(done, pieces.size()); });
}

/// Metres. How far around the way a picture of a part of a store looks.
constexpr double picture_reach = 20.0;

ExitStatus walk(WalkOptions options) {
  if (!options.against.scenes.empty()) {
    // Of a store, they can only mean the scene that it is checked against.
    SceneOptions& scene = options.scene;
    options.against.up = std::exchange(scene.up, {});
    options.against.unit = std::exchange(scene.unit, "m");
    options.against.ignore = std::exchange(scene.ignore, {});
    check_against(options.against);
  }
  if (!options.path.empty()) options.recorded = recorded_body(options.path);
  options.settings = walker_settings(options);
  check_outputs(options);
  if (options.route.dt < Route::shortest_step) throw UsageError("--dt: a step takes 1e-6 s at least");
  const Mode mode = options.walker_mode();
  if (options.checks() && mode == Mode::ghost) {
    throw UsageError("--verify with --mode ghost: a ghost passes through walls, so there is nothing to verify");
  }
  if (options.wander && mode == Mode::ghost) {
    throw UsageError("--wander with --mode ghost: a ghost meets nothing that could turn it; give it a --path");
  }
  std::vector<Vec3> path;
  if (!options.path.empty()) path = positions(load_path(options.path));
  if (options.recorded) {
    const std::string other = compare(*options.recorded, options.settings, mode);
    if (!other.empty()) fmt::print(stderr, "roam: note: {}\n", other);
  }
  std::optional<tbb::global_control> limit;
  if (options.scene.threads > 0) {
    limit.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(options.scene.threads));
  }
  std::optional<picture::PictureFile> drawing;
  if (!options.picture.empty()) drawing.emplace(options.picture);
  const bool needs_triangles = options.verify || drawing;
  OpenScene scene(options.scene, options.store, needs_triangles ? Source::keep : Source::release);

  const double seconds = options.wander ? *options.wander : path_length(path) / options.route.speed;
  Recorder recorder(options, scene, seconds / options.route.dt);
  const Vec3 start = !options.from.empty() ? Vec3(options.from[0], options.from[1], options.from[2])
                     : options.wander      ? scene.start(options.settings, mode)
                                           : path.front();
  scene.wait_at(Body::capsule(options.settings.radius, options.settings.height), start);
  Walker walker(scene.space(), options.settings, mode, start);
  WalkReport report;
  if (options.wander) {
    Wander wander(walker, options.route, *options.wander);
    recorder.start(walker.report());
    while (!wander.done()) {
      wander.look();
      if (wander.done()) break;
      recorder.step(walker, [&]() -> const StepReport& { return wander.advance(); });
    }
    report.result = wander.result();
  } else if (mode == Mode::ghost) {
    recorder.start(walker.report());
    report.result = haunt(walker, path, options.route, recorder);
  } else {
    report.result = follow(walker, path, options.route, recorder);
  }
  recorder.finish();

  report.scene = options.scene.names();
  report.triangles = scene.triangles();
  report.mode = mode;
  report.settings = options.settings;
  report.waypoints = path.size();
  report.eye = walker.eye();
  if (report.result.blocked_at) {
    // What was not known has no number in the scene: it is named by why it is not.
    const TriangleId triangle = report.result.blocked_at->triangle;
    if (walker.report().met_unknown) {
      report.object = scene.space().object_name(triangle);
    } else {
      const SourceTriangle source = scene.source(triangle);
      report.object = source.object;
      report.result.blocked_at->triangle = source.scene;
    }
  }
  report.paging = scene.paging();
  report.times = recorder.times();
  if (options.checks()) {
    const auto begin = std::chrono::steady_clock::now();
    report.verified = verified(options, scene, recorder.pieces());
    report.verify_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  }
  if (drawing) {
    // Of a store, what lies along the way has left the pager's memory again: a picture would call it unknown.
    std::vector<Mesh> around;
    if (scene.store()) around.push_back(scene.stored_triangles(recorder.pieces(), picture_reach));
    const World near = World::build(around);
    const Space& space = scene.store() ? static_cast<const Space&>(near) : scene.space();
    const std::span<const Mesh> meshes = scene.store() ? around : scene.loaded().meshes;
    drawing->write(picture::make_sheet({title(options), report, recorder.record(), space, meshes}));
  }
  if (options.json) {
    print(json_report(report));
  } else {
    print(text_report(report));
  }
  return report.result.outcome == Outcome::reached ? done : answer_no;
}

constexpr const char* help =
    "Sends a body along a path and tells how it ended: reached, blocked where and by what, fell, left_scene or held;\n"
    "how near it came to anything, certified; and how long its steps took. Exit status 0 when reached, 3 when not.\n\n"
    "A path file holds waypoints `x y z`, one a line, or the lines `t x y z qx qy qz qw` that osgViewer records; "
    "times\n"
    "and rotations are not used, --speed and --dt say how it is walked. Positions are of the body's centre. A "
    "waypoint\n"
    "counts as reached within the body's radius, and, walking, within the step height above and below. A path that\n"
    "`roam view` recorded says its body and mode: they are taken where --radius or --mode do not say another.\n\n"
    "Examples:\n"
    "  roam walk mine.dae --path tour.path\n"
    "  roam walk gallery.ply --path gallery-straight.path --mode fly --speed 50 --verify\n"
    "  roam walk house.glb --path in.path --radius 0.25 --height 1.8 --json --trace in.csv\n"
    "  roam walk house.glb --path in.path --height 1.8 --picture in.svg\n"
    "  roam walk Terrain/ --wander 60 --height 1.8 --verify\n";

}  // namespace

void add_walk(CLI::App& program, Run& run) {
  CLI::App* verb = program.add_subcommand("walk", "Sends a body through a scene and tells how it went");
  verb->footer(help);
  const auto options = std::make_shared<WalkOptions>();
  WalkOptions& o = *options;
  o.scene.add_to(*verb);
  auto* ways = verb->add_option_group("Way", "One of");
  ways->add_option("--path", o.path, "Waypoints to go along")->type_name("FILE");
  auto* wander =
      ways->add_option("--wander", o.wander, "Without a path: go where the body has been least, for S seconds")
          ->check(positive)
          ->type_name("S");
  ways->require_option(1);
  verb->add_option("--from", o.from, "Where to start wandering (default: where there is most room and walls in sight)")
      ->expected(3)
      ->delimiter(',')
      ->type_name("X,Y,Z")
      ->needs(wander);
  verb->add_option("--mode", o.mode, "fly: no gravity; walk: on the ground; ghost: through everything (default: walk)")
      ->check(CLI::IsMember({"fly", "walk", "ghost"}))
      ->type_name("MODE");
  verb->add_option("--radius", o.radius, "Of the body, in metres (default: 0.3)")->type_name("R");
  verb->add_option("--height", o.height, "Whole height, in metres (default: 2 R, a sphere)")->type_name("H");
  verb->add_option("--eye", o.eye, "Camera above the body's lowest point, in metres (default: 1.6, at most H)")
      ->type_name("E");
  verb->add_option("--step", o.step, "What walking steps up and down, in metres (default: 0.3, at most H / 2)")
      ->type_name("M");
  verb->add_option("--slope", o.slope, "What walking climbs, in degrees (default: 45)")->type_name("DEG");
  verb->add_option("--speed", o.route.speed, "In metres per second (default: 1.4)")->check(positive)->type_name("V");
  verb->add_option("--dt", o.route.dt, "Of one step, in seconds, 1e-6 or more (default: 1/60)")
      ->check(positive)
      ->type_name("S");
  verb->add_option("--trace", o.trace, "Write every step to a CSV file")->type_name("FILE");
  verb->add_option("--picture", o.picture, "Draw plan and section of the way, as .svg or .png")->type_name("FILE");
  verb->add_flag("--verify", o.verify,
                 "Check every move against all triangles, in higher precision, without the index");
  verb->add_option("--against", o.against.scenes,
                   "For a store: check every move against the triangles of the scene that it was made of, as they are "
                   "read")
      ->type_name("SCENE");
  o.store.add_to(*verb);
  verb->add_flag("--json", o.json, "Print one JSON object");
  verb->callback([options, &run] { run = [options] { return walk(*options); }; });
}

}  // namespace roam::app
