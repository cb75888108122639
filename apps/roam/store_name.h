#pragma once
/// \file
/// Where the store of a scene is looked for, and made, when nobody says.

#include <filesystem>

namespace roam::app {

/// Beside the scene, its whole name and ".roam": "Data/" -> "Data.roam", "mine.dae" -> "mine.dae.roam".
[[nodiscard]] std::filesystem::path store_beside(const std::filesystem::path& scene);

}  // namespace roam::app
