#pragma once
/// \file
/// Profile: a file beside a scene with the body that fits it, written by training and by SizeLearner.
///
///     const roam::ImportedScene scene = roam::import_scene("dam.ply");
///     const auto profile = roam::find_profile("dam.ply", roam::identity_of(scene.meshes));  // reads dam.ply.roam.json
///     if (profile) {
///       settings = roam::apply(*profile, settings);   // and, once there is a walker:
///       walker.set_regions(profile->regions);
///     }
///
/// Target roam::profile. docs/profile.md describes the file.

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/scene_frame.h"
#include "roam/walker.h"

namespace roam {

struct StoreInfo;

/// Identity of a scene, or of its store.
struct SceneIdentity {
  /// XXH3-128 of the corners of all triangles in order, as little-endian doubles: 32 hexadecimal digits, as `roam info`
  /// prints them. Independent of file format and names. Empty for a store.
  std::string hash;
  std::string geometry_hash;    ///< StoreInfo::geometry_hash; empty for a scene
  std::uint64_t triangles = 0;  ///< in the scene
  Box bounds;                   ///< of the scene's triangles, metres
};

/// Reads every triangle, 10 ns each. Throws roam::Error if a vertex index is out of range.
[[nodiscard]] SceneIdentity identity_of(std::span<const Mesh> meshes);
[[nodiscard]] SceneIdentity identity_of(const StoreInfo& store);

/// A body that fits a scene.
struct FittingBody {
  Mode mode = Mode::walk;       ///< walk or fly
  double radius = 0.0;          ///< m
  double height = 0.0;          ///< m; 2 * radius for a sphere
  double support_radius = 0.0;  ///< m; 0: none
  double step = 0.3;            ///< m
  double slope_degrees = 45.0;
  std::optional<double> largest;    ///< upper end of the interval of radii that pass all paths, m; none: unlimited
  double smallest = 0.0;            ///< lower end, m; 0: no crack
  std::vector<SizeRegion> regions;  ///< where another size is needed, and why
  bool complete = true;             ///< false: training ended early
};

struct Profile : FittingBody {
  static constexpr int version = 1;

  SceneIdentity scene;
  std::string method = "interval";  ///< "interval" or "paper" (train.h), or "roaming" (SizeLearner)
  std::optional<SceneFrame> frame;  ///< in which the scene is to be read; none: that of its format

  /// Whether this profile is of the scene: by a hash that both have; between a scene and a store, by the number of
  /// triangles and their exact bounds. False if either has no hash.
  [[nodiscard]] bool belongs_to(const SceneIdentity& other) const;
};

/// Throws roam::Error if a member is out of range, with its value and range.
void check(const Profile& profile);

/// Path of a scene's profile. "dam.ply" and its store "dam.ply.roam" have "dam.ply.roam.json"; the folder "Data/" and
/// its store "Data.roam" have "Data.roam.json"; another store "dam.roam" has "dam.roam.json". The scene need not exist.
[[nodiscard]] std::filesystem::path profile_path(const std::filesystem::path& scene);
/// For a scene of several files: beside the first, named after all: "a.ply+b.ply.roam.json"; with a hash of their paths
/// if folders differ or the name would exceed 200 characters. Both throw roam::Error for an empty path.
[[nodiscard]] std::filesystem::path profile_path(std::span<const std::filesystem::path> scenes);

/// Throws roam::Error if the file is no profile, of a newer version, has members out of range, or is a link, pipe or
/// device; also if it has a frame, but no body. The message names file, line or member, and what to do. Unknown members
/// are ignored.
[[nodiscard]] Profile load_profile(const std::filesystem::path& file);
/// Writes atomically: a temporary file, synced and renamed. It replaces only a profile; a link that has the name is
/// replaced, not followed. Throws roam::Error if it cannot be written, or as check() does.
void save_profile(const Profile& profile, const std::filesystem::path& file);
/// The first bytes of each file that save_profile() or save_frame() writes.
inline constexpr std::string_view profile_start = "{\n  \"roam_profile\":";
/// Loads the file profile_path(scene), if it exists and has a body. Throws as load_profile does, and roam::Error if the
/// profile is of another scene than `identity`, if that is given.
[[nodiscard]] std::optional<Profile> find_profile(const std::filesystem::path& scene,
                                                  const std::optional<SceneIdentity>& identity = {});
[[nodiscard]] std::optional<Profile> find_profile(std::span<const std::filesystem::path> scenes,
                                                  const std::optional<SceneIdentity>& identity = {});

/// The frame in the file profile_path(scenes), to be found before the scene is read. None if there is no file, or no
/// frame in it. Throws as load_profile does.
[[nodiscard]] std::optional<SceneFrame> find_frame(std::span<const std::filesystem::path> scenes);
/// Keeps a frame in a profile, unless that has a body of another frame: then the file stays as it is. Returns whether
/// the file has the frame. Throws as load_profile and save_profile do.
bool save_frame(const SceneFrame& frame, const std::filesystem::path& file);

/// `settings` with the profile's radius, height, step, slope and support radius. The eye stays, but at most at the top
/// of the body, and in the centre of a sphere. Pass the regions to Walker::set_regions. Does not check the scene.
[[nodiscard]] WalkerSettings apply(const Profile& profile, const WalkerSettings& settings);

}  // namespace roam
