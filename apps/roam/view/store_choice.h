#pragma once
/// \file
/// Choice of the store that a session collides with, and of the scene that it shows.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "roam/store.h"
#include "scenes/scene_options.h"

namespace roam::app {

/// The scene that a session shows, and the store that it collides with.
struct SceneAndStore {
  SceneOptions scene;                                             ///< the store itself if its scene is missing
  std::filesystem::path store;                                    ///< named store; empty: search beside the scene
  bool store_only = false;                                        ///< there is no scene to show
  std::uint64_t store_memory = SceneOptions::usual_store_memory;  ///< bytes, for the store only

  /// Limit for the store's manifest.
  [[nodiscard]] std::uint64_t manifest_memory() const { return app::manifest_memory(store_memory); }
};

/// The meaning of the command line; `store` is the value of --store. If `scene` names a store, the body collides with
/// it, and the scene beside it is shown: "Data.roam" -> "Data". Throws UsageError for a contradiction.
[[nodiscard]] SceneAndStore scene_and_store(const SceneOptions& scene, const std::filesystem::path& store);

/// A sentence for the user if a link lies where the store's scene would be; else empty. The link is not followed.
[[nodiscard]] std::string link_beside(const SceneAndStore& what);

/// The path of a scene's store, existing or not.
[[nodiscard]] std::filesystem::path store_place(const SceneAndStore& what);

struct StoreChoice {
  std::shared_ptr<const Store> store;  ///< null: there is no usable store
  bool stale = false;                  ///< there is a store, but of another scene, or not built by the user
  std::string note;                    ///< a sentence for the user if something is wrong; else empty
};

/// Opens a named store, even if it is of another scene. Opens a store beside the scene only if it has the user's key
/// and matches the scene. If the times of the scene's files do not settle that, reads the files. Throws roam::Cancelled
/// when `goes_on` returns false, and roam::Error if a named store cannot be opened.
[[nodiscard]] StoreChoice choose_store(const SceneAndStore& what, const std::function<bool()>& goes_on);

/// Whether loading the whole scene takes so much time or memory that a store is worth building.
[[nodiscard]] bool is_large(std::uint64_t bytes, std::uint64_t triangles);

}  // namespace roam::app
