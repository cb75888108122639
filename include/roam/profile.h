#pragma once
/// \file
/// What training found out about a scene, kept beside it, so that everybody who roams there has a body that fits.
///
///     const std::optional<roam::Profile> profile = roam::find_profile("dam.ply");   // reads dam.ply.roam.json
///     if (profile) settings = roam::apply(*profile, settings);
///
/// docs/training.md describes the file member by member. A reader of format version 1 takes every file of version 1.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/size_region.h"
#include "roam/walker.h"

namespace roam {

struct Profile {
  static constexpr int version = 1;

  /// Of the scene it was trained on: the hash that `roam info` prints, and the number of triangles.
  std::string scene_hash;
  std::uint64_t triangles = 0;

  Mode mode = Mode::walk;
  double radius = 0.0;          ///< of the body, m
  double height = 0.0;          ///< m
  double support_radius = 0.0;  ///< of the foot, m; 0: none of its own
  double step = 0.3;            ///< m
  double slope_degrees = 45.0;
  std::optional<double> largest;  ///< upper end of the feasible interval, m; none: no opening limits it
  double smallest = 0.0;          ///< lower end, m; 0: no crack
  std::vector<SizeRegion> regions;
  std::string method;    ///< "paper", "interval" or "roaming" (learned by roam view --adapt)
  bool complete = true;  ///< false: training was interrupted, and this is the best so far
};

/// Where the profile of a scene is: "dam.ply" has "dam.ply.roam.json"; a store "dam.roam" has "dam.roam.json", and a
/// folder of tiles "Data" has "Data.roam.json" beside it.
[[nodiscard]] std::filesystem::path profile_path(const std::filesystem::path& scene);

/// Throws roam::Error naming file, line or member, and what to do, for what is no profile, of a newer version, or holds
/// numbers out of range.
[[nodiscard]] Profile load_profile(const std::filesystem::path& file);
/// Written under a temporary name and renamed: whole or as it was. Throws roam::Error when it cannot be written.
void save_profile(const Profile& profile, const std::filesystem::path& file);
/// The profile beside a scene; none when there is no such file.
[[nodiscard]] std::optional<Profile> find_profile(const std::filesystem::path& scene);

/// A person's settings with the profile's body: its radius, height, step, slope and support; the eye stays where it is,
/// or at the top of a lower body.
[[nodiscard]] WalkerSettings apply(const Profile& profile, const WalkerSettings& settings);

}  // namespace roam
