#include "scenes/scene_options.h"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>

#include "cli/exit_status.h"
#include "cli/help.h"
#include "cli/interrupt.h"
#include "cli/progress.h"
#include "cli/tell.h"
#include "cli/values.h"
#include "import/likely_up.h"
#include "math/boxes.h"
#include "roam/error.h"
#include "roam/space.h"
#include "roam/wander.h"
#include "text/web_address.h"
#include "words/frame.h"

namespace roam::app {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

World index(const SceneOptions& options, const ImportedScene& scene) {
  Progress progress("indexing", "triangles");
  BuildOptions build;
  build.threads = options.threads;
  build.lossless = options.lossless;
  build.progress = [&](double fraction) {
    const auto done = static_cast<double>(scene.report.triangles) * fraction;
    return progress.goes_on(static_cast<std::uint64_t>(done), scene.report.triangles);
  };
  return World::build(scene.meshes, build);
}

void check_is_there(const std::filesystem::path& scene) {
  std::error_code none;
  if (scene.empty()) throw Error("the name of a scene is empty; name a file or a folder");
  if (!std::filesystem::exists(scene, none)) {
    if (none && none != std::errc::no_such_file_or_directory && none != std::errc::not_a_directory) {
      throw Error(scene.string(), "cannot be looked at: " + none.message());
    }
    const std::filesystem::path target = std::filesystem::read_symlink(scene, none);
    throw Error(scene.string(), target.empty() ? "there is no such file or folder. " + help_for_missing(scene.native())
                                               : "is a link to " + target.string() + ", which is not there.");
  }
  // An incomplete store, or one without CURRENT, is no folder of photogrammetry. Opening it gives the reason.
  int folders_of_stores = 0;
  for (const char* name : {"manifests", "packs", "parts"}) {
    folders_of_stores += std::filesystem::is_directory(scene / name, none) ? 1 : 0;
  }
  if (folders_of_stores > 1) static_cast<void>(Store::open(scene));
}

}  // namespace

void SceneOptions::add_to(CLI::App& verb) {
  verb.add_option("SCENE", scenes,
                  "Files, folders of photogrammetry tiles, or a store or its address; several files make one scene")
      ->required()
      ->type_name("");
  add_reading_to(verb);
  verb.option_defaults()->group(scene_group);
  verb.add_flag("--lossless", lossless,
                "Store triangles more exactly: a hit is right to 0.01 mm instead of 2 mm; takes more memory");
  verb.option_defaults()->group(other_group);
}

void SceneOptions::add_files_to(CLI::App& verb) {
  verb.option_defaults()->group(scene_group);
  verb.add_option("--up", up,
                  "Axis of the file that points up: x, y, z, -x, -y or -z, e.g. --up=-y (default: z; y for glTF)")
      ->check(one_of({"x", "y", "z", "-x", "-y", "-z"}))
      ->type_name("AXIS");
  verb.add_option("--unit", unit, "Unit of length in the file: m, cm, mm, ft or in (default: m)")
      ->check(one_of({"m", "cm", "mm", "ft", "in"}))
      ->type_name("UNIT");
  verb.add_option("--ignore", ignore, "Leave out objects whose name matches, e.g. 'Door*'; may be repeated")
      ->type_name("PATTERN")
      ->expected(1)
      ->take_all();
  verb.add_option("--allow", allow, "Let the scene's files refer to files in this folder too; may be repeated")
      ->type_name("DIR")
      ->expected(1)
      ->take_all();
  verb.add_flag("--no-profile", no_profile,
                "Ignore SCENE.roam.json: the trained body, the axis that is up and the unit");
  // For the child process of roam view.
  verb.add_flag("--no-scene-link{false}", through_link)->group("");
  verb.add_option("--memory", memory,
                  "Memory for a store's collision (default: 64M), or for reading a scene (default: 8G), e.g. 1G")
      ->transform(bytes())
      ->type_name("SIZE");
  verb.option_defaults()->group(other_group);
}

void SceneOptions::add_reading_to(CLI::App& verb) {
  add_files_to(verb);
  verb.option_defaults()->group(scene_group);
  verb.add_option("--threads", threads, "Threads for indexing and queries (default: one per core)")
      ->check(thread_count())
      ->type_name("N");
  verb.option_defaults()->group(other_group);
}

std::vector<std::string> SceneOptions::arguments() const {
  // With "=", a value may begin with "-".
  std::vector<std::string> words;
  if (!unit.empty()) words.push_back("--unit=" + unit);
  if (!up.empty()) words.push_back("--up=" + up);
  for (const std::string& pattern : ignore) words.push_back("--ignore=" + pattern);
  for (const auto& folder : allow) words.push_back("--allow=" + folder.string());
  if (no_profile) words.emplace_back("--no-profile");
  if (lossless) words.emplace_back("--lossless");
  if (!through_link) words.emplace_back("--no-scene-link");
  if (threads > 0) words.push_back(fmt::format("--threads={}", threads));
  if (memory) words.push_back(fmt::format("--memory={}", *memory));
  // Verbs that read no address do not know these.
  if (std::any_of(scenes.begin(), scenes.end(), [](const auto& scene) { return Store::is_address(scene.native()); })) {
    if (!web.cache.empty()) words.push_back(fmt::format("--cache={}", web.cache_bytes));
    if (web.redirects) words.emplace_back("--redirects");
  }
  words.emplace_back("--");
  for (const auto& scene : scenes) {
    words.push_back(scene.string());
    if (Store::is_address(scene.native()) && !web.query.empty()) words.back() += "?" + web.query;
  }
  return words;
}

ImportOptions SceneOptions::import_options() const {
  ImportOptions how;
  if (!up.empty()) how.up = parse_up_axis(up);
  if (!unit.empty()) how.unit = parse_length_unit(unit);
  how.ignore = ignore;
  how.allow = allow;
  how.through_link = through_link;
  if (memory) how.memory_limit = *memory;
  return how;
}

void SceneOptions::demand_store_alone() const {
  if (!name_a_store()) return;
  if (scenes.size() > 1) {
    throw UsageError("a store is a scene of its own: build one store of all that is to be one scene (roam build)");
  }
  if (up.empty() && unit.empty() && ignore.empty() && allow.empty() && !lossless) return;
  const std::string store = scenes.front().string();
  throw UsageError(
      Error::at(store, store + " is a store: --up, --unit, --ignore, --allow and --lossless belong to `roam build`"));
}

bool SceneOptions::name_a_store() const {
  return std::any_of(scenes.begin(), scenes.end(), [](const auto& scene) { return Store::is_store(scene); });
}

void SceneOptions::check_there() const {
  for (const auto& scene : scenes) {
    if (!Store::is_address(scene.native())) check_is_there(scene);
  }
}

void SceneOptions::check_files_there(const std::string& advice) const {
  for (const auto& scene : scenes) {
    if (!Store::is_address(scene.native()) && Store::is_store(scene)) {
      throw UsageError(scene.string(), "this is a store; " + advice);
    }
    check_is_there(scene);
  }
}

std::string SceneOptions::names() const {
  std::string text;
  for (const auto& scene : scenes) text += (text.empty() ? "" : ", ") + scene.string();
  return text;
}

std::string SceneOptions::file_names() const {
  std::string text;
  for (const auto& path : scenes) {
    const auto name = path.has_filename() ? path.filename() : path.parent_path().filename();
    text += (text.empty() ? "" : ", ") + name.string();
  }
  return text;
}

std::optional<UpAxis> doubted_up(const SceneOptions& options, std::span<const Mesh> meshes) {
  if (!options.up.empty() || std::any_of(options.scenes.begin(), options.scenes.end(), states_up)) return std::nullopt;
  return likely_up(meshes);
}

std::optional<double> doubted_ceilings(const SceneOptions& options, const ImportReport& report,
                                       const std::optional<UpAxis>& up, const Space& space,
                                       std::span<const Vec3> floors) {
  constexpr double highest = 20.0;         // m: few halls are higher, and storeys in feet or inches are not
  constexpr double covered = 0.25;         // of the floors: a city has roofs over less
  constexpr double typical = 0.9;          // of the covered floors: things lie under tables
  constexpr double over_the_floor = 0.05;  // m
  if (!options.unit.empty() || report.stated_unit || up) return std::nullopt;
  std::vector<double> heights;
  for (const Vec3& floor : floors) {
    const FirstImpact above =
        space.first_impact({0.0, 0.0}, floor + Vec3(0.0, 0.0, over_the_floor), {0.0, 0.0, Space::motion_limit});
    if (above.hit) heights.push_back(over_the_floor + above.time * Space::motion_limit);
  }
  const auto count = static_cast<double>(heights.size());
  if (heights.empty() || count < covered * static_cast<double>(floors.size())) return std::nullopt;
  const auto at = heights.begin() + static_cast<std::ptrdiff_t>(typical * count);
  std::nth_element(heights.begin(), at, heights.end());
  return *at > highest ? std::optional(*at) : std::nullopt;
}

ImportedScene read_scene(const SceneOptions& options) {
  options.check_there();
  ImportOptions how = options.import_options();
  if (how.memory_limit < ImportOptions::least_memory) {
    throw UsageError(fmt::format("--memory {:.5g} MiB", std::ldexp(static_cast<double>(how.memory_limit), -20)),
                     fmt::format("reading a scene needs at least {} MiB", ImportOptions::least_memory >> 20));
  }
  ImportedScene scene;
  {
    Progress progress("reading " + options.names(), "B");
    how.progress = [&](const ImportProgress& p) { return progress.goes_on(p.bytes_read, p.bytes_total); };
    scene = import_scene(options.scenes, how);
  }
  for (const std::string& note : scene.report.notes) tell("note: " + note);
  return scene;
}

std::optional<UpAxis> tell_doubted_up(const SceneOptions& options, std::span<const Mesh> meshes) {
  const std::optional<UpAxis> up = doubted_up(options, meshes);
  if (up) tell("note: " + words::likely_up(printable_part(options.file_names()), *up));
  return up;
}

LoadedScene load(const SceneOptions& options, Source source) {
  const auto start = std::chrono::steady_clock::now();
  ImportedScene scene = read_scene(options);
  LoadedScene loaded;
  loaded.likely_up = tell_doubted_up(options, scene.meshes);
  loaded.read_seconds = seconds_since(start);
  stop_if_interrupted();

  const auto indexing = std::chrono::steady_clock::now();
  loaded.world = index(options, scene);
  loaded.build_seconds = seconds_since(indexing);
  for (const Mesh& mesh : scene.meshes) loaded.bounds.include(box_around(mesh.vertices));
  loaded.floors = floor_samples(scene.meshes);
  if (const auto metres = doubted_ceilings(options, scene.report, loaded.likely_up, loaded.world, loaded.floors)) {
    tell("note: " + words::high_ceilings(printable_part(options.file_names()), *metres));
  }
  if (options.identify) loaded.identity = identity_of(scene.meshes);
  if (source == Source::keep) loaded.meshes = std::move(scene.meshes);
  loaded.report = std::move(scene.report);
  return loaded;
}

}  // namespace roam::app
