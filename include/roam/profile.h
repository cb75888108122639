#pragma once
/// \file
/// What training found out about a scene, kept beside it, so that everybody who roams there has a body that fits.
///
///     const roam::ImportedScene scene = roam::import_scene("dam.ply");
///     const auto profile = roam::find_profile("dam.ply", roam::identity_of(scene.meshes));  // reads dam.ply.roam.json
///     if (profile) {
///       settings = roam::apply(*profile, settings);   // and, once there is a walker:
///       walker.set_regions(profile->regions);
///     }
///
/// Library target roam::profile. docs/profile.md describes the file member by member. A reader of format version 1
/// takes every file of version 1, and passes over members that it does not know.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/size_region.h"
#include "roam/walker.h"

namespace roam {

struct StoreInfo;

/// By what a scene, or the store that was made of it, is known again.
struct SceneIdentity {
  /// Of a scene: XXH3-128 over the corners of all triangles in their order, each three little-endian doubles, in 32
  /// hexadecimal digits, as `roam info` prints it. The same triangles in another file format have the same hash; names
  /// do not count. Empty where only the store is known.
  std::string hash;
  std::string geometry_hash;    ///< of a store: StoreInfo::geometry_hash; empty where only the scene is known
  std::uint64_t triangles = 0;  ///< in the scene
  Box bounds;                   ///< of the scene's triangles, metres
};

/// Reads every triangle once: about 10 ns each. Throws roam::Error for one that uses a vertex which its mesh has not.
[[nodiscard]] SceneIdentity identity_of(std::span<const Mesh> meshes);
[[nodiscard]] SceneIdentity identity_of(const StoreInfo& store);

struct Profile {
  static constexpr int version = 1;

  SceneIdentity scene;  ///< that was trained on

  Mode mode = Mode::walk;       ///< walk or fly
  double radius = 0.0;          ///< of the body, m
  double height = 0.0;          ///< of the body, m: twice the radius for a sphere
  double support_radius = 0.0;  ///< of the foot, m; 0: none of its own
  double step = 0.3;            ///< m
  double slope_degrees = 45.0;
  std::optional<double> largest;  ///< upper end of the feasible interval, m; none: no opening limits it
  double smallest = 0.0;          ///< lower end, m; 0: no crack
  std::vector<SizeRegion> regions;
  /// "interval" or "paper", by train.h; or "roaming": learned by a SizeLearner.
  std::string method = "interval";
  bool complete = true;  ///< false: training was interrupted, and this is the best so far

  /// Whether it is of this scene. Where the hash, or the geometry hash, is known of both, that decides. A scene and a
  /// store have neither in common: then the number of triangles and the box of them all decide, to the last bit, for
  /// nothing else of the source is left in a store. What has no hash at all, as Profile{}, is of no scene.
  [[nodiscard]] bool belongs_to(const SceneIdentity& other) const;
};

/// Throws roam::Error, naming the member, its value and its range, for numbers that no body has.
void check(const Profile& profile);

/// Where the profile of a scene is; the scene need not be there. "dam.ply" has "dam.ply.roam.json" beside it, a folder
/// of tiles "Data/" has "Data.roam.json", and so have their stores, "dam.ply.roam" and "Data.roam". A store elsewhere,
/// "dam.roam", has "dam.roam.json".
[[nodiscard]] std::filesystem::path profile_path(const std::filesystem::path& scene);
/// Of several files or folders that make one scene: beside the first, named by all: "a.ply+b.ply.roam.json".
/// Both throw roam::Error for an empty path.
[[nodiscard]] std::filesystem::path profile_path(std::span<const std::filesystem::path> scenes);

/// Throws roam::Error naming file, line or member, and what to do, for what is no profile, is of a newer version, or
/// holds numbers out of range, and for a file that is a link, a pipe or a device.
[[nodiscard]] Profile load_profile(const std::filesystem::path& file);
/// Written under a temporary name, synced and renamed: whole or as it was. Throws roam::Error naming the file when it
/// cannot be written, and for what check refuses.
void save_profile(const Profile& profile, const std::filesystem::path& file);
/// The profile beside a scene, see profile_path; none when there is no such file. Throws what load_profile throws.
[[nodiscard]] std::optional<Profile> find_profile(const std::filesystem::path& scene);
[[nodiscard]] std::optional<Profile> find_profile(std::span<const std::filesystem::path> scenes);

/// The same, and throws roam::Error where it is not of the scene that was read: train again.
[[nodiscard]] std::optional<Profile> find_profile(const std::filesystem::path& scene, const SceneIdentity& identity);
[[nodiscard]] std::optional<Profile> find_profile(std::span<const std::filesystem::path> scenes,
                                                  const SceneIdentity& identity);

/// A person's settings with the profile's body: its radius, height, step, slope and support; the eye stays where it is,
/// or at the top of a lower body, and is in the centre of a sphere, as WalkerSettings::sphere has it. The regions are
/// for Walker::set_regions. Nothing here asks of which scene the profile is.
[[nodiscard]] WalkerSettings apply(const Profile& profile, const WalkerSettings& settings);

}  // namespace roam
