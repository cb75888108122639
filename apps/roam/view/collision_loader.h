#pragma once
/// \file
/// Loader of the collision, in a thread of its own.

#include <atomic>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "roam/import.h"
#include "roam/pager.h"
#include "roam/profile.h"
#include "roam/world.h"
#include "view/display_loader.h"
#include "view/loading.h"
#include "view/start.h"
#include "view/store_choice.h"

namespace roam::app {

/// The loaded collision data.
struct Collision {
  std::shared_ptr<const World> world;  ///< of a scene that is read whole; else null
  std::shared_ptr<Pager> pager;        ///< of a store; else null
  std::uint64_t triangles = 0;
  std::vector<std::string> objects;  ///< names of the world's objects, by their numbers
  std::vector<Mesh> meshes;          ///< the triangles as read, if the wish keeps them
  SceneIdentity identity;            ///< of the scene or the store
  ImportReport report;
  std::optional<UpAxis> likely_up;         ///< see doubted_up
  bool is_upright = false;                 ///< see stands_upright
  std::optional<double> doubted_ceilings;  ///< see there
  std::optional<StartPlace> start;         ///< set if the wish has no position
};

/// The options of a load.
struct CollisionWish {
  bool keep_meshes = false;
  std::optional<Vec3> place;  ///< the body's position; none: search for a start
  WalkerSettings walker;
  Mode mode = Mode::walk;
  std::uint64_t memory = 0;  ///< bytes, for a store's pager
  bool patient = false;      ///< nobody looks on: wait for a store's tiles as long as any are on their way
};

/// Opens the scene's store, or reads and indexes the scene. The collision has full detail, independent of the picture.
/// One core stays free for drawing.
class CollisionLoader {
 public:
  CollisionLoader(const SceneAndStore& what, const CollisionWish& wish);

  /// Ends the work, the reader process too, within a fraction of a second. Does not wait for that; the destructor does.
  void cancel() { loading_.cancel(); }
  /// Progress; from any thread.
  [[nodiscard]] LoadState state() const { return loading_.state(); }
  /// The result, once, after the loading is done; else nothing.
  [[nodiscard]] std::optional<Collision> take();
  /// The chosen store, once, as soon as it is known; else nothing.
  [[nodiscard]] std::optional<StoreChoice> take_choice();
  /// Whether the scene is large (see is_large) and has no store.
  [[nodiscard]] bool wants_store() const { return wants_store_; }
  /// The store and the body's start position in it, or the error that prevents one. Call it once.
  [[nodiscard]] std::future<PlaceInStore> place() { return place_.get_future(); }

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
  std::promise<PlaceInStore> place_;
  bool place_is_known_ = false;
  Loading loading_;
};

/// Waits until ground is loaded at `place`, or its tiles prove unreadable; at most 5 s. Throws roam::Cancelled when
/// `goes_on` returns false.
void wait_at(Pager& pager, const WalkerSettings& walker, const Vec3& place, const std::function<bool()>& goes_on);

/// `asked`, if positive; else all cores but one, so that the window stays smooth.
[[nodiscard]] int work_threads(int asked);

}  // namespace roam::app
