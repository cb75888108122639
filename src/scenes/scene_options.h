#pragma once
/// \file
/// The options by which every verb names its scene, and the way from them to a world.

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/import.h"
#include "roam/profile.h"
#include "roam/store.h"
#include "roam/world.h"

namespace CLI {
class App;
}

namespace roam::app {

/// Limit for a store's manifest where not all must keep within the memory of its collision.
[[nodiscard]] inline std::uint64_t manifest_memory(std::uint64_t store_memory) {
  return std::max(Store::usual_memory, store_memory);
}

struct SceneOptions {
  std::vector<std::filesystem::path> scenes;
  std::string up, unit;  ///< as in --up and --unit; empty: not given
  std::vector<std::string> ignore;
  std::vector<std::filesystem::path> allow;
  bool lossless = false;
  int threads = 0;
  std::optional<std::uint64_t> memory;  ///< `--memory`, bytes
  bool no_profile = false;              ///< whether the profile beside the scene is not read
  std::filesystem::path frame_file{};   ///< the profile whose frame was taken; empty: none. No option
  bool identify = false;                ///< whether to set LoadedScene::identity; no option of the command line
  bool through_link = true;             ///< ImportOptions::through_link; false for a scene that the user did not name
  WebAccess web{};                      ///< for a store on a web server; see add_web_options

  /// Default of `memory` for a store's collision, in bytes.
  static constexpr std::uint64_t usual_store_memory = 64ull << 20;
  [[nodiscard]] std::uint64_t store_memory() const { return memory.value_or(usual_store_memory); }
  [[nodiscard]] std::uint64_t manifest_memory() const { return app::manifest_memory(store_memory()); }

  /// Adds SCENE..., --up, --unit, --ignore, --allow, --no-profile, --lossless, --threads and --memory.
  void add_to(CLI::App& verb);
  /// Adds --up, --unit, --ignore, --allow, --no-profile and --memory.
  void add_files_to(CLI::App& verb);
  /// Adds the same and --threads.
  void add_reading_to(CLI::App& verb);
  /// The command line that add_to() reads as these options, SCENE last.
  [[nodiscard]] std::vector<std::string> arguments() const;
  /// The same as options of import_scene.
  [[nodiscard]] ImportOptions import_options() const;
  /// Throws UsageError if a store is named beside other scenes, or with options for reading and indexing files.
  void demand_store_alone() const;
  /// Whether one of the scenes is a store.
  [[nodiscard]] bool name_a_store() const;
  /// Throws roam::Error for a missing scene, and for a store that is still being built.
  void check_there() const;
  /// The same for scenes that must be files, or folders of them: UsageError for a store, with `advice` ("name its
  /// scene"), Error for an address.
  void check_files_there(const std::string& advice) const;
  /// The file names for display, separated by ", ".
  [[nodiscard]] std::string names() const;
  /// The same without folders, for the title of a picture.
  [[nodiscard]] std::string file_names() const;
};

/// A scene that was read and indexed.
struct LoadedScene {
  World world;
  std::vector<Mesh> meshes;  ///< the triangles as read; empty after Source::release
  ImportReport report;
  SceneIdentity identity;           ///< set if SceneOptions::identify
  Box bounds;                       ///< of the triangles as read
  std::vector<Vec3> floors;         ///< see floor_samples
  std::optional<UpAxis> likely_up;  ///< see doubted_up
  double read_seconds = 0.0;
  double build_seconds = 0.0;
};

/// Whether the triangles as read stay in memory after the world is built.
enum class Source : std::uint8_t { keep, release };

/// The axis that the surface makes likely to be up instead of z; see roam::likely_up. None if an option or the format
/// states one.
[[nodiscard]] std::optional<UpAxis> doubted_up(const SceneOptions& options, std::span<const Mesh> meshes);

/// The height of the ceilings in metres, if the scene is so large that its unit is in doubt: nine tenths of the covered
/// `floors` (see floor_samples) are no farther from their ceilings, and that is over 20 m. None if less than a
/// quarter of the floors are covered, if an option or the file states a unit, or if `up`, see doubted_up, is in doubt,
/// as walls then count as ceilings. Takes microseconds a floor.
[[nodiscard]] std::optional<double> doubted_ceilings(const SceneOptions& options, const ImportReport& report,
                                                     const std::optional<UpAxis>& up, const Space& space,
                                                     std::span<const Vec3> floors);

/// The same as doubted_up, with a note on standard error.
std::optional<UpAxis> tell_doubted_up(const SceneOptions& options, std::span<const Mesh> meshes);

/// Reads, with progress and the import's notes on standard error. Throws what import_scene throws.
[[nodiscard]] ImportedScene read_scene(const SceneOptions& options);

/// Reads and indexes, with progress and the import's notes on standard error. Throws what import_scene and
/// World::build throw.
[[nodiscard]] LoadedScene load(const SceneOptions& options, Source source);

}  // namespace roam::app
