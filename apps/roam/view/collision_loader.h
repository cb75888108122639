#pragma once
/// \file
/// Loads what a body collides with, beside the thread that draws.

#include <atomic>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>

#include "roam/import.h"
#include "roam/world.h"
#include "scene_options.h"
#include "view/start.h"
#include "view/status.h"

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
  /// Ends what runs, the reader's process too, and waits for that: a fraction of a second.
  ~CollisionLoader();
  CollisionLoader(const CollisionLoader&) = delete;
  CollisionLoader& operator=(const CollisionLoader&) = delete;

  /// Lets what runs come to its end; does not wait for that.
  void cancel() { cancelled_ = true; }
  /// How far it is; from any thread.
  [[nodiscard]] LoadState state() const;
  /// What was loaded, once, when it is done; else nothing.
  [[nodiscard]] std::optional<Collision> take();

 private:
  void run();
  void load();
  void set(LoadState::Phase phase, double share, std::uint64_t triangles);

  SceneOptions scene_;
  CollisionWish wish_;
  std::atomic<bool> cancelled_ = false;
  mutable std::mutex mutex_;
  LoadState state_;
  std::optional<Collision> loaded_;
  std::chrono::steady_clock::time_point phase_start_;
  std::thread thread_;
};

/// The options of import_scene and read_display that follow from those of the command line.
[[nodiscard]] ImportOptions import_options(const SceneOptions& scene);

}  // namespace roam::app
