#pragma once
/// \file
/// Where the store of a scene is looked for, and made, when nobody says.

#include <filesystem>

namespace roam::app {

/// Beside the scene, its whole name and ".roam": "Data/" -> "Data.roam", "mine.dae" -> "mine.dae.roam".
[[nodiscard]] std::filesystem::path store_beside(const std::filesystem::path& scene);

/// Throws roam::Error where that, which nobody named, is a link: the folder of a scene may come from a stranger, and
/// the link would lead a build to another store.
void demand_no_link(const std::filesystem::path& store);

}  // namespace roam::app
