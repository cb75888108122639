#pragma once
/// \file
/// Loads what a body collides with, beside the thread that draws.

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <vector>

#include "roam/import.h"
#include "roam/pager.h"
#include "roam/profile.h"
#include "roam/world.h"
#include "view/loading.h"
#include "view/start.h"
#include "view/store_choice.h"

namespace roam::app {

/// What was loaded.
struct Collision {
  std::shared_ptr<const World> world;  ///< of a scene that was read whole; else null
  std::shared_ptr<Pager> pager;        ///< of a store; else null
  std::uint64_t triangles = 0;
  std::vector<Mesh> meshes;  ///< the triangles as read, where they were asked for
  SceneIdentity identity;    ///< of the scene or the store
  ImportReport report;
  std::optional<StartPlace> start;  ///< where one was asked for
};

/// What is asked for beside the world.
struct CollisionWish {
  bool keep_meshes = false;
  std::optional<Vec3> place;  ///< where the body will be put; none: a start is to be found
  WalkerSettings walker;
  Mode mode = Mode::walk;
  std::uint64_t memory = 0;  ///< bytes, of a store's pager
};

/// Opens the scene's store, or reads and indexes the scene, in a thread of its own, at full detail, whatever is on the
/// screen. One core is left to who draws.
class CollisionLoader {
 public:
  CollisionLoader(const SceneAndStore& what, const CollisionWish& wish);

  /// Lets what runs come to its end, the reader's process too; does not wait for that, as the destructor does: a
  /// fraction of a second.
  void cancel() { loading_.cancel(); }
  /// How far it is; from any thread.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// What was loaded, once, when it is done; else nothing.
  [[nodiscard]] std::optional<Collision> take();
  /// Which store was chosen, once, as soon as that is known; else nothing.
  [[nodiscard]] std::optional<StoreChoice> take_choice();
  /// There is no store, and the scene is large: see is_large.
  [[nodiscard]] bool wants_store() const { return wants_store_; }
  /// Where a body begins in a store, when that is known, or why it never will be. To be asked for once.
  [[nodiscard]] std::future<Vec3> place() { return place_.get_future(); }

 private:
  void load();
  void choose_and_load();
  void load_store(std::shared_ptr<const Store> store);
  void load_scene();
  void finish(Collision&& loaded);

  SceneAndStore what_;
  CollisionWish wish_;
  std::optional<Collision> loaded_;
  std::optional<StoreChoice> choice_;
  std::atomic<bool> wants_store_ = false;
  std::promise<Vec3> place_;
  bool place_is_known_ = false;
  Loading loading_;
};

/// Waits until a body has ground to stand on at a place, or what is there cannot be read; some seconds at most, then it
/// is held there. `goes_on` is asked now and then, and ends it by false: roam::Cancelled.
void wait_at(Pager& pager, const WalkerSettings& walker, const Vec3& place, const std::function<bool()>& goes_on);

/// All cores but one, so that the window stays smooth; or as many as were asked for.
[[nodiscard]] int work_threads(int asked);

}  // namespace roam::app
