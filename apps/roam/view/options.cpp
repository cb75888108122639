#include "view/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>
#include <sstream>

#include "cli/exit_status.h"
#include "cli/help.h"
#include "cli/standard_streams.h"
#include "cli/values.h"
#include "files/extension.h"
#include "roam/error.h"
#include "roam/route.h"

namespace roam::app {
namespace {

constexpr int largest_side = 16384;  // pixels, of a picture

/// "1280x720"
std::array<int, 2> parse_size(const std::string& text) {
  std::array<int, 2> size{};
  const char* const end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, size[0]);
  const bool crossed = first == std::errc() && cross != end && *cross == 'x';
  const auto [last, second] = std::from_chars(crossed ? cross + 1 : end, end, size[1]);
  const auto fits = [](int side) { return side >= 1 && side <= largest_side; };
  if (!crossed || second != std::errc() || last != end || !fits(size[0]) || !fits(size[1])) {
    throw UsageError(fmt::format("--size {}", text),
                     fmt::format("a picture is WIDTHxHEIGHT, e.g. 1280x720, each from 1 to {}", largest_side));
  }
  return size;
}

std::string not_a_place(const std::string& text) {
  return fmt::format("'{}' is no place: X,Y,Z[,YAW[,PITCH]], three to five numbers with commas and no blanks", text);
}

/// "1,2,1.5,90": position, optionally yaw and pitch.
std::vector<double> parse_place(const std::string& text) {
  std::vector<double> numbers;
  std::istringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');) {
    double value = 0.0;
    if (!CLI::detail::lexical_cast(part, value)) throw CLI::ValidationError("--at", not_a_place(text));
    numbers.push_back(value);
  }
  if (numbers.size() < 3 || numbers.size() > 5 || text.ends_with(','))
    throw CLI::ValidationError("--at", not_a_place(text));
  return numbers;
}

WalkerSettings walker_settings(const ViewOptions& options, const ViewSettings& settings,
                               const std::optional<RecordedBody>& recorded,
                               const std::optional<SceneProfile>& profile) {
  WalkerSettings walker;
  const bool replay = !options.path.empty();
  ViewSettings known = replay ? ViewSettings{} : settings;
  if (recorded) {
    const WalkerSettings& body = recorded->settings;
    known.radius = body.radius;
    known.height = body.height;
    known.eye = body.eye;
    known.step = body.step;
    known.slope = body.slope_degrees;
    if (!options.radius) walker.support_radius = body.support_radius;
  }
  if (profile && !options.radius) {
    const Profile& trained = profile->profile;
    known.radius = trained.radius;
    known.height = trained.height;
    if (known.eye) known.eye = std::min(*known.eye, trained.height);
    known.step = trained.step;
    known.slope = trained.slope_degrees;
    walker.support_radius = trained.support_radius;
  }
  const bool known_body = recorded || profile;
  const bool described = options.radius.has_value() || (replay && !known_body);
  // All sizes come from one source: a height from the settings does not fit a radius from the command line.
  const auto body = [&](const std::optional<double>& option, const std::optional<double>& setting) {
    return option || described ? option : setting;
  };
  walker.radius = body(options.radius, known.radius).value_or(walker.radius);
  const double sphere = 2.0 * walker.radius;
  const double tall = described || known.radius ? sphere : walker.height;
  walker.height = body(options.height, known.height).value_or(tall);
  // On the axis, the camera is a radius away from every surface.
  const double eye = std::max(std::min(walker.eye, walker.height - walker.radius), 0.0);
  walker.eye = body(options.eye, known.eye).value_or(eye);
  walker.step = body(options.step, known.step).value_or(std::min(walker.step, 0.5 * walker.height));
  if (known_body && options.height) {
    // A new height for a recorded or trained body: fit the rest to it.
    walker.eye = options.eye.value_or(std::min(walker.eye, walker.height));
    walker.step = options.step.value_or(std::min(walker.step, 0.5 * walker.height));
  }
  const bool same_body = !options.radius || !replay;
  walker.slope_degrees = (options.slope ? options.slope
                          : same_body   ? known.slope
                                        : std::nullopt)
                             .value_or(walker.slope_degrees);
  walker.speed = (options.speed ? options.speed : known.speed).value_or(walker.speed);
  return walker;
}

/// A file that a session writes, and the option that names it.
struct Written {
  const char* option;
  const std::filesystem::path& file;
};

bool ends_in(const std::filesystem::path& file, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), files::lower_extension(file)) != extensions.end();
}

/// Refuses file names of unknown kinds of picture or film.
void check_kinds(const ViewOptions& options) {
  if (!options.screenshot.empty() && !ends_in(options.screenshot, {".png", ".jpg", ".jpeg"})) {
    throw UsageError("--screenshot " + options.screenshot.string(), "a picture's name ends in .png, .jpg or .jpeg");
  }
  if (!options.record.empty() && options.record.extension() != ".mp4") {
    throw UsageError("--record " + options.record.string(), "a film's name ends in .mp4");
  }
}

/// Refuses outputs that would overwrite an input or another output, or whose folder does not exist.
void check_files(const ViewOptions& options, const ViewSettings& settings) {
  const auto same = [](const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code none;
    if (a.empty() || b.empty()) return false;
    return std::filesystem::equivalent(a, b, none) ||
           std::filesystem::weakly_canonical(std::filesystem::absolute(a), none) ==
               std::filesystem::weakly_canonical(std::filesystem::absolute(b), none);
  };
  const Written outputs[] = {{"--screenshot", options.screenshot},
                             {"--record", options.record},
                             {"--record-path", options.record_path},
                             {"--trace", options.trace}};
  if (is_standard(options.record_path))
    throw UsageError("--record-path -", "standard output does not take a path; name a file");
  demand_one_output("--trace", options.trace, options.json);
  for (const Written& output : outputs) {
    if (output.file.empty()) continue;
    const std::string where = fmt::format("{} {}", output.option, output.file.string());
    const auto refuse = [&](const std::string& what) {
      throw UsageError(where, fmt::format("this would overwrite {}; name another file", what));
    };
    for (const auto& scene : options.scene.scenes) {
      if (same(scene, output.file)) refuse("the scene");
    }
    if (same(options.path, output.file)) refuse("the path");
    if (same(settings.file, output.file)) refuse("the settings");
    for (const Written& other : outputs) {
      if (&other == &output) break;
      if (same(other.file, output.file)) refuse(std::string("what ") + other.option + " writes");
    }
    const std::filesystem::path folder = output.file.parent_path();
    std::error_code none;
    if (!folder.empty() && !std::filesystem::is_directory(folder, none)) {
      throw UsageError(where, fmt::format("there is no folder {}; make it, or name another", folder.string()));
    }
  }
}

}  // namespace

void ViewOptions::add_to(CLI::App& verb) {
  scene.add_to(verb);
  // --keys needs no scene.
  verb.get_option("SCENE")->required(false);
  verb.get_option("--memory")->description("Memory for a store's collision (default: 64M)");
  verb.option_defaults()->group(scene_group);
  verb.add_option("--store", store,
                  "Use this store for collision (default: SCENE.roam beside the scene, if you built it from SCENE)")
      ->type_name("STORE");
  constexpr double metres = Space::reach_limit / 4.0;
  verb.option_defaults()->group("Start");
  auto* from = verb.add_option_function<std::string>(
                       "--at", [this](const std::string& text) { at = parse_place(text); },
                       "Place of the body's centre, and where it looks, in degrees: yaw 0 is +x, 90 is +y")
                   ->type_name("X,Y,Z[,YAW[,PITCH]]");
  verb.add_option("--bookmark", bookmark, "Start at a place that was kept with the key B")
      ->excludes(from)
      ->type_name("NAME");
  verb.add_option("--mode", mode, "walk, fly or ghost (default: walk)")
      ->check(one_of({"fly", "walk", "ghost"}))
      ->type_name("MODE");
  verb.option_defaults()->group("Path");
  auto* replay = verb.add_option("--path", path, "Follow this path file as `roam walk` does, with its body, and end")
                     ->excludes(from)
                     ->excludes("--bookmark")
                     ->type_name("FILE");
  verb.add_option("--speed", speed, "Metres per second (default: 1.4)")->check(from_to(1e-3, 1e4))->type_name("V");
  verb.add_option("--dt", dt, "Length of one time step of the path, in seconds, at least 1e-6 (default: 1/60)")
      ->needs(replay)
      ->check(from_to(Route::shortest_step, 10.0))
      ->type_name("S");
  verb.option_defaults()->group("Body, in metres");
  verb.add_option("--radius", radius, "Radius (default: as trained, or 0.3)")
      ->check(from_to(1e-6, 0.5 * metres))
      ->type_name("R");
  verb.add_option("--height", height, "Whole height (default: a person's 1.8; with --radius or --path: 2 R)")
      ->check(from_to(1e-6, metres))
      ->type_name("H");
  verb.add_option("--eye", eye, "Height of the camera above the body's lowest point (default: 1.6, at most H - R)")
      ->check(from_to(0.0, metres))
      ->type_name("E");
  verb.add_option("--step", step, "Highest step (stair, kerb) that the body climbs (default: 0.3, at most H / 2)")
      ->check(from_to(0.0, metres))
      ->type_name("M");
  verb.add_option("--slope", slope, "Slope that the body climbs, in degrees (default: 45)")
      ->check(from_to(0.0, 89.0))
      ->type_name("DEG");
  verb.add_flag("--no-profile", no_profile, "Ignore the trained body in SCENE.roam.json");
  verb.add_flag("--adapt", adapt,
                "Learn on the way: a smaller body at an opening that stops it, a larger support disc where it falls; "
                "SCENE.roam.json keeps them");
  verb.option_defaults()->group("Window");
  verb.add_option("--size", size, "Size of the picture in pixels (default: 1280x720)")->type_name("WxH");
  verb.add_flag("--fullscreen", fullscreen, "Fill the screen");
  verb.add_option("--fov", fov, "Vertical field of view, in degrees (default: 65)")
      ->check(from_to(least_fov, largest_fov))
      ->type_name("DEG");
  verb.add_option("--hud", hud, "Display: full, minimal or off (default: full)")
      ->check(one_of({"full", "minimal", "off"}))
      ->type_name("MODE");
  verb.add_option("--quality", quality, "Drawing: auto, full, light or plain (default: auto, plain without a graphics card)")
      ->check(one_of({quality_names.begin(), quality_names.end()}))
      ->type_name("Q");
  verb.add_flag("--headless", headless, "Draw without a screen");
  verb.add_option("--time", time_limit, "End after S seconds of roaming")
      ->excludes(replay)
      ->check(from_to(1e-3, 1e9))
      ->type_name("S");
  verb.option_defaults()->group("Results");
  verb.add_option("--screenshot", screenshot,
                  "Write a picture (.png, .jpg) when all is loaded or the path ends, and end")
      ->type_name("FILE");
  verb.add_option("--record", record, "Write a film (.mp4) of all that is shown; needs ffmpeg")->type_name("FILE");
  verb.add_option("--record-path", record_path, "Write the way as a path file, as the key R does")->type_name("FILE");
  verb.add_option("--trace", trace, "Write every step to this CSV file (-: standard output)")->type_name("FILE");
  verb.add_flag("--verify", verify, "At the end, check every move against all triangles, without the index");
  verb.add_flag("--json", json, "At the end, print one JSON object");
  verb.option_defaults()->group(other_group);
  verb.add_option("--settings", settings,
                  "Settings file (default: roam/settings.json in $XDG_CONFIG_HOME or ~/.config)")
      ->type_name("FILE");
  verb.add_flag("--keys", keys, "Print the keys, as the settings have them, and end");
}

ViewPlan make_plan(const ViewOptions& options, const ViewSettings& settings,
                   const std::optional<RecordedBody>& recorded, const std::optional<SceneProfile>& profile) {
  for (const auto& scene : options.scene.scenes) {
    if (scene.empty()) throw UsageError("view", "a scene has no name: \"\"; give it a file or a folder");
  }
  check_kinds(options);
  check_files(options, settings);
  ViewPlan plan;
  plan.walker = walker_settings(options, settings, recorded, profile);
  if (!options.radius) plan.profile = profile;
  try {
    check(plan.walker);
  } catch (const Error& error) {
    if (settings.file.empty()) throw UsageError(error);
    throw UsageError(
        Error::at(settings.file.string(), fmt::format("{} (with {})", error.what(), settings.file.string())));
  }
  const std::string mode = options.mode.value_or(to_string(recorded ? recorded->mode : Mode::walk));
  plan.mode = mode == "fly" ? Mode::fly : mode == "ghost" ? Mode::ghost : Mode::walk;
  plan.fov = options.fov.value_or(settings.fov.value_or(plan.fov));
  plan.sensitivity = settings.sensitivity.value_or(plan.sensitivity);
  plan.invert_y = settings.invert_y.value_or(plan.invert_y);
  plan.hud = options.hud ? parse_hud_mode(*options.hud).value_or(plan.hud) : settings.hud.value_or(plan.hud);
  plan.quality = options.quality.value_or(settings.quality.value_or(plan.quality));
  plan.edges = settings.edges.value_or(plan.edges);
  const auto [width, height] = parse_size(options.size);
  plan.width = width;
  plan.height = height;
  if (!options.at.empty()) {
    for (const double x : options.at) {
      if (!(std::abs(x) <= coordinate_limit)) {
        throw UsageError("--at",
                         fmt::format("{:g} is no number from {:g} to {:g}", x, -coordinate_limit, coordinate_limit));
      }
    }
    const auto value = [&](std::size_t i) { return i < options.at.size() ? options.at[i] : 0.0; };
    plan.at = Pose{{value(0), value(1), value(2)}, value(3), value(4)};
  }
  if (recorded) plan.note = compare(*recorded, plan.walker, plan.mode);
  if (options.scene.memory && *options.scene.memory < Pager::least_memory) {
    throw UsageError("--memory", fmt::format("a store needs {}M at least", Pager::least_memory >> 20));
  }
  if (!options.path.empty() && plan.mode == Mode::ghost) {
    throw UsageError("--path with --mode ghost", "a ghost meets nothing on its way; take walk or fly");
  }
  if (options.verify && plan.mode == Mode::ghost) {
    throw UsageError("--verify with --mode ghost", "a ghost passes through walls, so there is nothing to verify");
  }
  const bool ends = !options.path.empty() || !options.screenshot.empty() || options.time_limit > 0.0;
  if (options.headless && !ends) {
    throw UsageError("--headless", "without a screen nobody can roam; give it a --path, a --screenshot or a --time");
  }
  return plan;
}

}  // namespace roam::app
