#pragma once
/// \file
/// The store that lies beside its scene, and its build.

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "roam/store.h"
#include "roam/store_build.h"

namespace roam::app {

/// Beside the scene, its whole name and ".roam": "Data/" -> "Data.roam", "mine.dae" -> "mine.dae.roam".
[[nodiscard]] std::filesystem::path store_beside(const std::filesystem::path& scene);

/// Throws roam::Error if the store beside a scene, whose name the user did not give, is a link. The folder of a scene
/// may come from a stranger, and the link would lead a build to another store.
void demand_no_link(const std::filesystem::path& store);

/// Opens the store beside a scene. Throws the errors of Store::open, and roam::Error for a link, also for one that
/// takes the store's place meanwhile.
[[nodiscard]] std::shared_ptr<const Store> open_store_beside(const std::filesystem::path& store,
                                                             std::uint64_t memory = Store::usual_memory);

/// Throws UsageError for a --memory that is too small for a build.
void demand_memory_of_build(const std::optional<std::uint64_t>& memory);

/// The notes of a build, as sentences of the program. Notes of parts read now are the program's own. Notes of parts
/// read before are stored in the store, which may come from a stranger: they are quoted.
[[nodiscard]] std::vector<std::string> notes_as_sentences(const StoreBuildReport& report,
                                                          const std::filesystem::path& store);

}  // namespace roam::app
