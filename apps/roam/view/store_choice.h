#pragma once
/// \file
/// Which store a session collides with, and which scene it shows.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>

#include "roam/store.h"
#include "scenes/scene_options.h"

namespace roam::app {

/// What a session shows, and what it was told to collide with.
struct SceneAndStore {
  SceneOptions scene;           ///< of a store whose scene is not there: the store itself
  std::filesystem::path store;  ///< that was named; empty: look beside the scene
  bool store_only = false;      ///< there is no scene to be seen
  std::uint64_t store_memory = SceneOptions::usual_store_memory;  ///< bytes; the scene that is shown does without
};

/// What the command line means: `store` is that of --store. Where the scene that is named is a store, it is the one to
/// collide with, and what is shown is the scene that lies beside it: "Data.roam" -> "Data". Throws UsageError for what
/// cannot be meant.
[[nodiscard]] SceneAndStore scene_and_store(const SceneOptions& scene, const std::filesystem::path& store);

/// A sentence for the user if a link lies where the scene of the store would be; else empty. It is not followed.
[[nodiscard]] std::string link_beside(const SceneAndStore& what);

/// Where the store of a scene is, or would be built.
[[nodiscard]] std::filesystem::path store_place(const SceneAndStore& what);

struct StoreChoice {
  std::shared_ptr<const Store> store;  ///< null: there is none, or none that can be used
  bool stale = false;                  ///< there is one, but it is not of this very scene, or not the user's
  std::string note;                    ///< a sentence for the user when something is not as it should be
};

/// A store that was named is opened, whatever scene it is of; one that lies beside the scene only where the
/// user built it, with the user's key, and it is of this very scene. That reads the scene's files where their times
/// tell nothing: `goes_on` is asked now and then, and ends it by false (roam::Cancelled). Throws roam::Error when a
/// store that was named cannot be opened.
[[nodiscard]] StoreChoice choose_store(const SceneAndStore& what, const std::function<bool()>& goes_on);

/// Whether loading a scene whole takes so long, or so much memory, that a store is worth building.
[[nodiscard]] bool is_large(std::uint64_t bytes, std::uint64_t triangles);

}  // namespace roam::app
