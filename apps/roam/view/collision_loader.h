#pragma once
/// \file
/// Loads what a body collides with, beside the thread that draws.

#include <chrono>
#include <memory>
#include <optional>
#include <vector>

#include "roam/import.h"
#include "roam/world.h"
#include "scene_options.h"
#include "view/loading.h"
#include "view/start.h"

namespace roam::app {

/// What was loaded.
struct Collision {
  std::shared_ptr<const World> world;
  std::vector<Mesh> meshes;  ///< the triangles as read, where they were asked for
  ImportReport report;
  std::optional<StartPlace> start;  ///< where one was asked for
};

/// What is asked for beside the world.
struct CollisionWish {
  bool keep_meshes = false;
  bool find_start = false;
  WalkerSettings walker;
  Mode mode = Mode::walk;
};

/// Reads and indexes in a thread of its own, at full detail, whatever is on the screen. One core is left to who draws.
class CollisionLoader {
 public:
  CollisionLoader(const SceneOptions& scene, const CollisionWish& wish);

  /// Lets what runs come to its end, the reader's process too; does not wait for that, as the destructor does: a
  /// fraction of a second.
  void cancel() { loading_.cancel(); }
  /// How far it is; from any thread.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// What was loaded, once, when it is done; else nothing.
  [[nodiscard]] std::optional<Collision> take();

 private:
  void load();
  void set(LoadState::Phase phase, double share, std::uint64_t triangles);

  SceneOptions scene_;
  CollisionWish wish_;
  std::optional<Collision> loaded_;
  std::chrono::steady_clock::time_point phase_start_;
  Loading loading_;
};

/// The options of import_scene and read_display that follow from those of the command line.
[[nodiscard]] ImportOptions import_options(const SceneOptions& scene);

}  // namespace roam::app
