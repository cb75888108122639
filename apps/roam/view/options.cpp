#include "view/options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <initializer_list>

#include "cli/exit_status.h"
#include "cli/help.h"
#include "cli/output_file.h"
#include "cli/standard_streams.h"
#include "cli/trace_file.h"
#include "cli/values.h"
#include "files/extension.h"
#include "graphics/capture.h"
#include "roam/error.h"
#include "roam/profile.h"
#include "roam/route.h"
#include "roam/store.h"
#include "scenes/recorded_body.h"
#include "scenes/web_options.h"
#include "text/stream_of.h"
#include "view/section.h"

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
  for (const std::string& part : parts_of(text, ',')) {
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
  const bool replay = !options.path.empty();
  const ViewSettings set = replay ? ViewSettings{} : settings;
  BodySizes known{set.radius, set.height, set.eye, set.step, set.slope, std::nullopt};
  if (recorded) known = sizes_of(*recorded);
  if (profile) {
    const std::optional<double> eye = known.eye;
    known = sizes_of(profile->profile);
    if (eye) known.eye = std::min(*eye, *known.height);
  }
  WalkerSettings walker = body_of(options.body, known);
  // The sizes belong to one body, the slope to all that the person walks.
  if (options.body.describe_a_body() && !options.body.slope && set.slope) walker.slope_degrees = *set.slope;
  walker.speed = (options.speed ? options.speed : set.speed).value_or(walker.speed);
  return walker;
}

bool ends_in(const std::filesystem::path& file, std::initializer_list<const char*> extensions) {
  return std::find(extensions.begin(), extensions.end(), files::lower_extension(file)) != extensions.end();
}

/// Refuses file names of unknown kinds of picture or film.
void check_kinds(const ViewOptions& options) {
  if (!options.screenshot.empty() && !ends_in(options.screenshot, {".png", ".jpg", ".jpeg"})) {
    throw UsageError("--screenshot " + options.screenshot.string(), "a picture's name ends in .png, .jpg or .jpeg");
  }
  if (!options.record.empty() && !graphics::Video::is_film(options.record)) {
    throw UsageError("--record " + options.record.string(), "a film's name ends in .mp4, .webm, .gif or .webp");
  }
}

/// The film's pictures a second. Headless frames are 1/60 s: other rates would jerk.
int film_rate(const ViewOptions& options) {
  if (!options.film_rate) return graphics::Video::usual_rate(options.record);
  const int rate = *options.film_rate;
  if (60 % rate != 0) {
    throw UsageError(fmt::format("--fps {}", rate), "take 60, 30, 20, 15, 12 or 10, which divide 60");
  }
  if (files::lower_extension(options.record) == ".gif" && 100 % rate != 0) {
    throw UsageError(fmt::format("--fps {} with --record {}", rate, options.record.string()),
                     "the pictures of a GIF last hundredths of a second: take 20 or 10");
  }
  return rate;
}

/// Refuses outputs that would overwrite an input or another output, or that cannot be written.
void check_files(const ViewOptions& options, const ViewSettings& settings) {
  const NamedFile outputs[] = {{"--screenshot", options.screenshot, marked("picture")},
                               {"--record", options.record, marked("film")},
                               {"--record-path", options.record_path, paths()},
                               {"--trace", options.trace, traces()}};
  if (is_standard(options.record_path))
    throw UsageError("--record-path -", "standard output does not take a path; name a file");
  demand_one_output("--trace", options.trace, options.json);
  std::vector<NamedFile> inputs = named_scenes(options.scene.scenes);
  inputs.push_back({"the path", options.path});
  inputs.push_back({"the settings", settings.file});
  inputs.push_back({"the store", options.store});
  inputs.push_back({"the profile", profile_path(options.scene.scenes)});
  demand_no_overwriting(inputs, outputs);
  for (const NamedFile& output : outputs) {
    if (!output.file.empty() && !is_standard(output.file)) check_output(output.name, output.file);
  }
}

/// Rewrites STORE/CURRENT as STORE: file managers open a store by that file, because they know no types of folders.
CLI::Validator store_of_its_file() {
  return {[](std::string& text) {
            const std::filesystem::path file(text), folder = file.parent_path();
            if (file.filename() == "CURRENT" && !folder.empty() && Store::is_store(folder)) text = folder.string();
            return std::string();
          },
          ""};
}

}  // namespace

void ViewOptions::add_to(CLI::App& verb) {
  scene.add_to(verb);
  // --keys needs no scene.
  verb.get_option("SCENE")->required(false)->transform(store_of_its_file());
  add_web_options(verb, *verb.get_option("SCENE"), scene.web);
  verb.get_option("--memory")->description("Memory for a store's collision (default: 64M)");
  verb.option_defaults()->group(scene_group);
  verb.add_option("--store", store,
                  "Use this store for collision (default: SCENE.roam beside the scene, if you built it from SCENE)")
      ->type_name("STORE");
  take_query_of(*verb.get_option("--store"), scene.web);
  verb.option_defaults()->group("Start");
  auto* from = verb.add_option_function<std::string>(
                       "--at", [this](const std::string& text) { at = parse_place(text); },
                       "Place of the body's centre, and its gaze in degrees: yaw 0 is +x, 90 is +y")
                   ->type_name("X,Y,Z[,YAW[,PITCH]]");
  verb.add_option("--bookmark", bookmark, "Start at a bookmark, a place that the key B kept")
      ->excludes(from)
      ->type_name("NAME");
  add_mode_to(verb, mode, {Mode::fly, Mode::walk, Mode::ghost}, "walk, fly or ghost (default: walk)");
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
  body.add_to(verb);
  verb.add_flag(
      "--adapt", adapt,
      "Learn on the way: a smaller body at an opening that stops it, a larger support disc everywhere after a fall; "
      "SCENE.roam.json keeps them");
  verb.option_defaults()->group("Window");
  verb.add_option("--size", size, "Size of the picture in pixels (default: 1280x720)")->type_name("WxH");
  verb.add_flag("--fullscreen", fullscreen, "Fill the screen");
  verb.add_option("--fov", fov, "Vertical field of view, in degrees (default: 65)")
      ->check(from_to(least_fov, largest_fov))
      ->type_name("DEG");
  verb.add_option("--hud", hud,
                  "Display: plain, full (with figures for programmers), minimal or off (default: plain). With this "
                  "option, --screenshot shows the display too")
      ->check(one_of({"plain", "full", "minimal", "off"}))
      ->type_name("MODE");
  verb.add_option(
          "--quality", quality,
          "Drawing: auto, full, light or plain (default: auto: full; plain in a window without a graphics card)")
      ->check(one_of({quality_names.begin(), quality_names.end()}))
      ->type_name("Q");
  verb.add_option("--tile-error", tile_error,
                  "Draw 3D Tiles so finely that their error is at most N pixels (default: 16; 0: the finest tiles)")
      ->check(from_to(0.0, largest_tile_error))
      ->type_name("N");
  verb.add_option("--page-memory", page_memory, "Memory for the pages of the picture (default: 1G)")
      ->transform(bytes())
      ->type_name("SIZE");
  verb.add_option("--picture-scale", picture_scale,
                  "The key P writes pictures N times as wide and high as the window (default: 1)")
      ->check(from_to(1.0, largest_picture_scale))
      ->type_name("N");
  verb.add_option("--section", section,
                  "Show only this side of a plane, to look into buildings: 'z<2.5', 'x>10'; or only the inside of a "
                  "box between "
                  "two corners: 'box 0 0 0, 10 10 3'; may be repeated. The body still meets the rest")
      ->type_name("PLANE|BOX")
      ->expected(1)
      ->take_all();
  verb.add_option("--hide", hide,
                  "Do not draw objects whose name, or an ancestor's, matches, e.g. 'Roof*'; may be repeated. The body "
                  "still meets them: --ignore leaves them out for the body, too")
      ->type_name("PATTERN")
      ->expected(1)
      ->take_all();
  verb.add_flag("--pass-hidden", pass_hidden,
                "The body passes through what --hide and --section hide: objects, and triangles that lie as a whole "
                "beyond a plane or one side of the box. With a store only such triangles")
      ->excludes(replay);
  add_place(verb, "--origin", origin,
            "Coordinates of the scene's zero at the site, in metres: the display shows those of the body, too")
      ->check(from_to(-coordinate_limit, coordinate_limit));
  verb.add_flag("--headless", headless, "Draw without a screen");
  verb.add_option("--time", time_limit, "End after S seconds of roaming")
      ->excludes(replay)
      ->check(from_to(1e-3, 1e9))
      ->type_name("S");
  verb.option_defaults()->group("Results");
  verb.add_option("--screenshot", screenshot,
                  "Write a picture (.png, .jpg) without the display when all is loaded or the path ends, and end")
      ->type_name("FILE");
  auto* film =
      verb.add_option("--record", record, "Write a film (.mp4, .webm, .gif, .webp) of the session; needs ffmpeg")
          ->type_name("FILE");
  verb.add_option("--turntable", turntable,
                  "Film the scene from outside, turning once in S seconds, without the display, and end")
      ->needs(film)
      ->excludes(replay)
      ->excludes(from)
      ->excludes("--bookmark")
      ->excludes("--time")
      ->check(from_to(1.0, 600.0))
      ->type_name("S");
  verb.add_option("--fps", film_rate, "Pictures a second of the film: 60, 30, 20, 15, 12 or 10 (default: 30; .gif 20)")
      ->needs(film)
      ->check(from_to(10, 60))
      ->type_name("N");
  verb.add_option("--record-path", record_path, "Write the way as a path file, as the key R does")->type_name("FILE");
  verb.add_option("--trace", trace, "Write every step to this CSV file (-: standard output)")->type_name("FILE");
  verb.add_flag("--verify", verify, "At the end, check every move against all triangles, without the index")
      ->excludes("--pass-hidden");
  verb.add_flag("--json", json, "At the end, print one JSON object");
  verb.option_defaults()->group(other_group);
  verb.add_option("--settings", settings,
                  "Settings file (default: roam/settings.json in $XDG_CONFIG_HOME or ~/.config)")
      ->type_name("FILE");
  verb.add_flag("--keys", keys, "Print the keys, as set in the settings, and end");
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
  if (!options.body.describe_a_body()) plan.profile = profile;
  try {
    check(plan.walker);
  } catch (const Error& error) {
    if (settings.file.empty()) throw UsageError(error);
    throw UsageError(
        Error::at(settings.file.string(), fmt::format("{} (with {})", error.what(), settings.file.string())));
  }
  plan.mode = options.mode.value_or(recorded ? recorded->mode : Mode::walk);
  plan.fov = options.fov.value_or(settings.fov.value_or(plan.fov));
  plan.sensitivity = settings.sensitivity.value_or(plan.sensitivity);
  plan.invert_y = settings.invert_y.value_or(plan.invert_y);
  plan.easing = settings.easing.value_or(plan.easing);
  plan.hud = options.hud ? parse_hud_mode(*options.hud).value_or(plan.hud) : settings.hud.value_or(plan.hud);
  plan.quality = options.quality.value_or(settings.quality.value_or(plan.quality));
  plan.picture_scale = options.picture_scale.value_or(settings.picture_scale.value_or(plan.picture_scale));
  plan.edges = settings.edges.value_or(plan.edges);
  for (const std::string& text : options.section) add_section(text, plan.section);
  plan.pages.allowed_error = options.tile_error.value_or(settings.tile_error.value_or(plan.pages.allowed_error));
  plan.pages.memory = options.page_memory.value_or(plan.pages.memory);
  const auto [width, height] = parse_size(options.size);
  plan.film_rate = app::film_rate(options);
  if (options.turntable && !options.hud) plan.hud = HudMode::off;
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
  const bool ends =
      !options.path.empty() || !options.screenshot.empty() || options.time_limit > 0.0 || options.turntable;
  if (options.headless && !ends) {
    throw UsageError("--headless",
                     "without a screen nobody can roam; give it a --path, a --screenshot, a --turntable or a --time");
  }
  return plan;
}

}  // namespace roam::app
