#include "view/options.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "exit_status.h"
#include "roam/error.h"
#include "roam/route.h"

namespace roam::app {
namespace {

constexpr int largest_side = 16384;  // pixels, of a picture

CLI::Validator within(double least, double most) {
  return CLI::Validator(
      [least, most](const std::string& text) {
        double value = 0.0;
        const bool fits = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;
        return fits ? std::string() : fmt::format("'{}' is not a number from {:g} to {:g}", text, least, most);
      },
      "");
}

/// "1280x720"
std::array<int, 2> parse_size(const std::string& text) {
  std::array<int, 2> size{};
  const char* const end = text.data() + text.size();
  const auto [cross, first] = std::from_chars(text.data(), end, size[0]);
  const bool crossed = first == std::errc() && cross != end && *cross == 'x';
  const auto [last, second] = std::from_chars(crossed ? cross + 1 : end, end, size[1]);
  const auto fits = [](int side) { return side >= 1 && side <= largest_side; };
  if (!crossed || second != std::errc() || last != end || !fits(size[0]) || !fits(size[1])) {
    throw UsageError(
        fmt::format("--size {}: a picture is WIDTHxHEIGHT, e.g. 1280x720, each from 1 to {}", text, largest_side));
  }
  return size;
}

WalkerSettings walker_settings(const ViewOptions& options, const ViewSettings& settings) {
  WalkerSettings walker;
  const bool replay = !options.path.empty();
  const bool described = options.radius.has_value() || replay;
  // What belongs together is taken from one place: a height from the settings is no height for a radius from the
  // command line.
  const auto body = [&](const std::optional<double>& option, const std::optional<double>& setting) {
    return option || described ? option : setting;
  };
  walker.radius = body(options.radius, settings.radius).value_or(walker.radius);
  const double sphere = 2.0 * walker.radius;
  const double tall = described || settings.radius ? sphere : walker.height;
  walker.height = body(options.height, settings.height).value_or(tall);
  // On the body's axis the camera is a radius from everything.
  const double eye = std::max(std::min(walker.eye, walker.height - walker.radius), 0.0);
  walker.eye = body(options.eye, settings.eye).value_or(eye);
  walker.step = body(options.step, settings.step).value_or(std::min(walker.step, 0.5 * walker.height));
  walker.slope_degrees = (options.slope ? options.slope
                          : replay      ? std::nullopt
                                        : settings.slope)
                             .value_or(walker.slope_degrees);
  walker.speed = (options.speed ? options.speed : replay ? std::nullopt : settings.speed).value_or(walker.speed);
  return walker;
}

/// Refuses to write over what is read.
void check_files(const ViewOptions& options) {
  const auto same = [](const std::filesystem::path& a, const std::filesystem::path& b) {
    std::error_code none;
    return !a.empty() && !b.empty() && std::filesystem::equivalent(a, b, none);
  };
  struct Written {
    const char* option;
    const std::filesystem::path& file;
  };
  for (const auto& [option, file] :
       {Written{"--screenshot", options.screenshot}, Written{"--record", options.record},
        Written{"--record-path", options.record_path}, Written{"--trace", options.trace}}) {
    const auto refuse = [&, o = option, f = file](const char* what) {
      throw UsageError(fmt::format("{} {} would overwrite the {}", o, f.string(), what));
    };
    for (const auto& scene : options.scene.scenes) {
      if (same(scene, file)) refuse("scene");
    }
    if (same(options.path, file)) refuse("path");
    if (same(options.settings, file)) refuse("settings");
  }
}

}  // namespace

void ViewOptions::add_to(CLI::App& verb) {
  scene.add_to(verb);
  // Not for --keys, which needs no scene.
  verb.get_option("SCENE")->required(false);
  constexpr double metres = 250.0;
  verb.add_option("--mode", mode, "walk, fly or ghost to begin with (default: walk)")
      ->check(CLI::IsMember({"fly", "walk", "ghost"}))
      ->type_name("MODE");
  verb.add_option("--radius", radius, "Of the body, in metres (default: 0.3)")
      ->check(within(1e-6, metres))
      ->type_name("R");
  verb.add_option("--height", height, "Whole height, in metres (default: a person's 1.8; with --radius or --path: 2 R)")
      ->check(within(1e-6, metres))
      ->type_name("H");
  verb.add_option("--eye", eye, "Camera above the body's lowest point, in metres (default: 1.6, at most H - R)")
      ->check(within(0.0, metres))
      ->type_name("E");
  verb.add_option("--step", step, "What walking steps up and down, in metres (default: 0.3, at most H / 2)")
      ->check(within(0.0, metres))
      ->type_name("M");
  verb.add_option("--slope", slope, "What walking climbs, in degrees (default: 45)")
      ->check(within(0.0, 89.0))
      ->type_name("DEG");
  verb.add_option("--speed", speed, "In metres per second (default: 1.4)")->check(within(1e-3, 1e4))->type_name("V");
  auto* from =
      verb.add_option("--at", at, "Start with the body's centre here, looking there, in degrees: yaw 0 is +x, 90 is +y")
          ->expected(3, 5)
          ->delimiter(',')
          ->type_name("X,Y,Z[,YAW[,PITCH]]");
  verb.add_option("--bookmark", bookmark, "Start at a place that was kept with the key B")
      ->excludes(from)
      ->type_name("NAME");
  auto* replay = verb.add_option("--path", path, "Go along a path file as `roam walk` does, and end")
                     ->excludes(from)
                     ->excludes("--bookmark")
                     ->type_name("FILE");
  verb.add_option("--dt", dt, "Of one step of the path, in seconds, 1e-6 or more (default: 1/60)")
      ->needs(replay)
      ->check(within(Route::shortest_step, 10.0))
      ->type_name("S");
  verb.add_option("--size", size, "Of the picture, in pixels (default: 1280x720)")->type_name("WxH");
  verb.add_flag("--fullscreen", fullscreen, "Fill the screen");
  verb.add_option("--fov", fov, "Height of the field of view, in degrees (default: 65)")
      ->check(within(least_fov, largest_fov))
      ->type_name("DEG");
  verb.add_option("--hud", hud, "full, minimal or off (default: full)")
      ->check(CLI::IsMember({"full", "minimal", "off"}))
      ->type_name("MODE");
  verb.add_flag("--headless", headless, "Draw without a screen");
  verb.add_option("--screenshot", screenshot,
                  "Write a picture (.png, .jpg) when all is loaded or the path has ended, and end")
      ->type_name("FILE");
  verb.add_option("--record", record, "Write a film (.mp4) of all that is shown; needs ffmpeg")->type_name("FILE");
  verb.add_option("--record-path", record_path, "Write the way as a path file, as the key R does")->type_name("FILE");
  verb.add_option("--time", time_limit, "End after so many seconds of roaming")
      ->check(within(0.0, 1e9))
      ->type_name("S");
  verb.add_option("--trace", trace, "Write every step to a CSV file")->type_name("FILE");
  verb.add_flag("--verify", verify, "At the end, check every move against all triangles, without the index");
  verb.add_flag("--json", json, "At the end, print one JSON object");
  verb.add_option("--settings", settings, "Instead of roam/settings.json in $XDG_CONFIG_HOME or ~/.config")
      ->type_name("FILE");
  verb.add_flag("--keys", keys, "Print what the keys do, as the settings have it, and end");
}

ViewPlan make_plan(const ViewOptions& options, const ViewSettings& settings) {
  check_files(options);
  ViewPlan plan;
  plan.walker = walker_settings(options, settings);
  try {
    check(plan.walker);
  } catch (const Error& error) {
    throw UsageError(settings.file.empty() ? error.what()
                                           : fmt::format("{} (with {})", error.what(), settings.file.string()));
  }
  const std::string mode = options.mode.value_or("walk");
  plan.mode = mode == "fly" ? Mode::fly : mode == "ghost" ? Mode::ghost : Mode::walk;
  plan.fov = options.fov.value_or(settings.fov.value_or(plan.fov));
  plan.sensitivity = settings.sensitivity.value_or(plan.sensitivity);
  plan.invert_y = settings.invert_y.value_or(plan.invert_y);
  plan.hud = options.hud ? parse_hud_mode(*options.hud).value_or(plan.hud) : settings.hud.value_or(plan.hud);
  const auto [width, height] = parse_size(options.size);
  plan.width = width;
  plan.height = height;
  if (!options.at.empty()) {
    for (const double x : options.at) {
      if (!std::isfinite(x)) throw UsageError("--at: not a finite number");
    }
    const auto value = [&](std::size_t i) { return i < options.at.size() ? options.at[i] : 0.0; };
    plan.at = Pose{{value(0), value(1), value(2)}, value(3), value(4)};
  }
  if (!options.path.empty() && plan.mode == Mode::ghost) {
    throw UsageError("--path with --mode ghost: a ghost meets nothing on its way; take walk or fly");
  }
  if (options.verify && plan.mode == Mode::ghost) {
    throw UsageError("--verify with --mode ghost: a ghost passes through walls, so there is nothing to verify");
  }
  const bool ends = !options.path.empty() || !options.screenshot.empty() || options.time_limit > 0.0;
  if (options.headless && !ends) {
    throw UsageError("--headless: without a screen nobody can roam; give it a --path, a --screenshot or a --time");
  }
  return plan;
}

}  // namespace roam::app
