#include "view/store_choice.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/exit_status.h"
#include "roam/error.h"
#include "scenes/beside_scene.h"
#include "scenes/open_scene.h"
#include "scenes/user_key.h"
#include "store/build/same_scene.h"
#include "store/opened.h"

namespace roam::app {
namespace {

/// About ten seconds of loading, and some gigabytes of memory.
constexpr std::uint64_t many_bytes = 1'000'000'000;
constexpr std::uint64_t many_triangles = 20'000'000;

/// "Data.roam/" -> "Data"; empty for another extension, and for names such as "...roam", which would give the parent
/// folder.
std::filesystem::path place_beside(const std::filesystem::path& store) {
  if (Store::is_address(store.native())) return {};
  std::filesystem::path path = store.lexically_normal();
  if (!path.has_filename()) path = path.parent_path();
  if (path.extension() != ".roam") return {};
  const std::string name = path.stem().string();
  return name == "." || name == ".." ? std::filesystem::path() : path.replace_extension();
}

/// The type of a file. A link is not followed, because the store may come from a stranger.
std::filesystem::file_status status_of(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::symlink_status(path, none);
}

/// The file or folder beside a store; empty if there is none.
std::filesystem::path scene_beside(const std::filesystem::path& store) {
  const std::filesystem::path path = place_beside(store);
  const std::filesystem::file_status status = status_of(path);
  const bool usable = std::filesystem::is_regular_file(status) || std::filesystem::is_directory(status);
  return usable ? path : std::filesystem::path();
}

/// The difference between store and scene; empty if they match.
std::string compare(const Store& store, const SceneOptions& scene, const std::optional<StoreKey>& key,
                    const std::function<bool()>& goes_on) {
  ImportOptions reading = scene.import_options();
  reading.progress = [&](const ImportProgress&) { return goes_on(); };
  try {
    return store::difference(store, scene.scenes, reading, scene.lossless, key, [&] {
      if (!goes_on()) throw Cancelled();
    });
  } catch (const Error& error) {
    return error.what();
  }
}

/// Why the user may not have built the store, as a clause for a message; empty if the user did.
std::string not_yours(const Store& store, const UserKey& user) {
  if (!user.key)
    return "it is not known whether you built it, for no key of yours can be used: " + std::string(user.problem.what());
  if (store.is_authentic(*user.key)) return "";
  return "it was not built with your key, and one that comes with a scene may lack a wall";
}

}  // namespace

SceneAndStore scene_and_store(const SceneOptions& scene, const std::filesystem::path& store) {
  SceneAndStore what{scene, store, false, scene.store_memory()};
  if (!store.empty() && !Store::is_store(store)) {
    throw UsageError(
        fmt::format("--store {}", store.string()),
        fmt::format("there is no store there; `roam build {} -o {}` makes it", scene.names(), store.string()));
  }
  const auto& scenes = scene.scenes;
  if (!scene.name_a_store()) {
    scene.check_there();
    what.scene.memory.reset();  // it is that of the store
    return what;
  }
  if (!store.empty()) throw UsageError("a store is a scene of its own: name the scene, and the store by --store");
  scene.demand_store_alone();
  what.store = scenes.front();
  const std::filesystem::path shown = scene_beside(what.store);
  what.store_only = shown.empty();
  if (what.store_only) return what;
  what.scene.scenes = {shown};
  what.scene.memory.reset();
  what.scene.through_link = false;
  read_as(what.scene, *Store::open(what.store, what.manifest_memory(), what.scene.web));
  return what;
}

std::string link_beside(const SceneAndStore& what) {
  const std::filesystem::path path = what.store_only ? place_beside(what.store) : std::filesystem::path();
  if (!std::filesystem::is_symlink(status_of(path))) return "";
  return fmt::format(
      "{0} is a link, and a link beside a store is not followed; to see what it leads to, name it: "
      "roam view {0} --store {1}",
      path.string(), path.string() + ".roam");
}

std::filesystem::path store_place(const SceneAndStore& what) {
  return what.store.empty() ? store_beside(what.scene.scenes.front()) : what.store;
}

StoreChoice choose_store(const SceneAndStore& what, const std::function<bool()>& goes_on) {
  StoreChoice choice;
  const UserKey user = user_key();
  const std::filesystem::path place = store_place(what);
  if (!what.store.empty()) {
    choice.store = Store::open(what.store, what.manifest_memory(), what.scene.web);
    const std::string difference =
        what.store_only ? std::string() : compare(*choice.store, what.scene, user.key, goes_on);
    choice.stale = !difference.empty();
    if (choice.stale) {
      choice.note = fmt::format("what is collided with, {}, is not of what is seen: {}", place.string(), difference);
    }
    return choice;
  }
  try {
    demand_no_link(place);
  } catch (const Error& error) {
    choice.note = error.what();
    return choice;
  }
  if (!Store::is_store(place)) return choice;
  std::string problem, remedy = "`roam build` brings it up to date";
  try {
    std::shared_ptr<const Store> store = open_store_beside(place, what.manifest_memory());
    problem = not_yours(*store, user);
    if (!problem.empty()) {
      remedy =
          "where you trust whoever did, name it with --store, or make it yours with `roam build --adopt`; else "
          "remove it";
    } else {
      problem = compare(*store, what.scene, user.key, goes_on);
    }
    if (problem.empty()) choice.store = std::move(store);
  } catch (const Error& error) {
    problem = error.what();
  }
  choice.stale = !problem.empty();
  if (choice.stale) {
    choice.note = fmt::format("the store {} is not used: {}; {}", place.string(), problem, remedy);
  }
  return choice;
}

bool is_large(std::uint64_t bytes, std::uint64_t triangles) { return bytes > many_bytes || triangles > many_triangles; }

}  // namespace roam::app
