#pragma once
/// \file
/// How the body comes into the scene, and what it collides with there.

#include <future>
#include <memory>
#include <optional>
#include <string>

#include "osgRoam/Manipulator.h"
#include "view/collision_loader.h"
#include "view/news.h"
#include "view/options.h"
#include "view/pose.h"
#include "view/view_report.h"

namespace roam::app {

/// Loads the collision, gives it to the body, and puts the body to its start. A body without collision is a ghost. A
/// body that has nothing below to stand on flies.
///
/// Reads no files itself and needs no window. All members belong to one thread, between two frames.
class Arrival {
 public:
  /// Begins to load. Without a place in the plan, a start is looked for.
  Arrival(const ViewOptions& options, const ViewPlan& plan, const SceneAndStore& what, osgRoam::Manipulator& roamer,
          News& news);

  /// The loader of the collision: its state, the store that it chose, and where a body begins in a store.
  [[nodiscard]] CollisionLoader& loader() { return loader_; }

  /// The picture as far as it has been loaded.
  struct Seen {
    LoadState state{};
    bool has_pieces = false;
    Vec3 origin{0.0};  ///< the graph is scene - origin
    Pose overview{};   ///< from where all of it is seen
  };
  /// Call it in each frame until it returns true: then the manipulator has its space, and enter() may be called. The
  /// space is that of the collision; an empty one if the collision failed. Throws roam::Error if the picture failed,
  /// too, or if a path or --verify needs the collision.
  [[nodiscard]] bool receive(const Seen& seen);
  /// Puts the body to its start, and makes that its home.
  void enter();

  /// Whether the body is in the scene.
  [[nodiscard]] bool is_placed() const { return placed_; }
  /// Whether it is a ghost in an empty space.
  [[nodiscard]] bool is_ghost_only() const { return !collision_keys_.empty(); }
  /// The identity of the scene or store; null for a ghost.
  [[nodiscard]] const SceneIdentity* identity() const { return loaded_ ? &loaded_->identity : nullptr; }
  /// The pager of the store that the body collides with; null if it collides with a scene.
  [[nodiscard]] const Pager* pager() const { return pager_.get(); }

  /// From now on the body collides with a store. It stays where it is. The memory of the collision before is freed by
  /// another thread.
  void change_to(std::shared_ptr<Pager> pager);

  /// Waits for tiles of the store around the body, as long as a person would have had for them, in s. For a body that
  /// moves faster than the clock.
  void wait_for_tiles(double seconds);
  /// After each step of `seconds`, or a placement (0): whether there is something to stand on.
  void watch_footing(const StepReport& report, double seconds);
  /// Lets a body fly that has nothing to stand on.
  void fly_without_ground();
  /// Notes tiles of the store that cannot be read; not every one. `now`: s since the session began.
  void note_failures(double now);

  void fill(Status& status) const;
  /// Adds the body, and gives away the meshes that were kept for --verify. `result` must be there already.
  void fill(ViewReport& report);

 private:
  void place_ghost(const Seen& seen, const Error& why);
  void tell_where_put();
  [[nodiscard]] bool is_ground_below() const;
  void name_blockage(ViewReport& report) const;

  ViewPlan plan_;
  std::string scene_names_;
  bool needs_collision_;  ///< a ghost will not do
  osgRoam::Manipulator& roamer_;
  News& news_;
  std::optional<Collision> loaded_;
  std::shared_ptr<Pager> pager_;
  std::optional<Pose> start_;
  bool placed_ = false;
  bool without_ground_ = false;  ///< it walks, and would fall out of the scene
  std::string collision_keys_;   ///< all keys, while a ghost in an empty space lacks some
  std::string failure_told_;     ///< of the store
  double failure_told_at_ = -1e9;
  CollisionLoader loader_;
  std::future<void> freeing_;  ///< of what a store has replaced
};

}  // namespace roam::app
