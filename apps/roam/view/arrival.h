#pragma once
/// \file
/// The body's arrival in the scene, and the collision that it uses there.

#include <memory>
#include <optional>
#include <string>

#include "osgRoam/Manipulator.h"
#include "scenes/arrivals.h"
#include "view/collision_loader.h"
#include "view/freeing.h"
#include "view/news.h"
#include "view/options.h"
#include "view/pose.h"
#include "view/view_report.h"

namespace roam::app {

/// Loads the collision, connects the body to it, and puts the body at its start. Without collision the body becomes a
/// ghost. Without ground below it, the body flies.
///
/// Reads no files and needs no window. Call all members from one thread, between two frames.
class Arrival {
 public:
  /// Begins to load. If the plan has no position, the loader searches for a start.
  Arrival(const ViewOptions& options, const ViewPlan& plan, const SceneAndStore& what, osgRoam::Manipulator& roamer,
          News& news);

  /// The loader of the collision, with its state, its choice of a store, and a store's start position.
  [[nodiscard]] CollisionLoader& loader() { return loader_; }

  /// The scene's picture, as far as it is loaded.
  struct Seen {
    LoadState state{};
    bool has_pieces = false;
    Vec3 origin{0.0};  ///< the graph is scene - origin
    Pose overview{};   ///< pose from which the whole scene is visible
  };
  /// Call it in each frame until it returns true. The manipulator then has its space, and enter() may be called. The
  /// space is empty if the collision failed. Throws roam::Error if the picture failed too, or if a path or --verify
  /// needs the collision.
  [[nodiscard]] bool receive(const Seen& seen);
  /// Puts the body at its start, which becomes its home.
  void enter();

  /// Whether the body is in the scene.
  [[nodiscard]] bool is_placed() const { return placed_; }
  /// Whether the body is a ghost in an empty space.
  [[nodiscard]] bool is_ghost_only() const { return !collision_keys_.empty(); }
  /// The identity of the scene or store; null for a ghost.
  [[nodiscard]] const SceneIdentity* identity() const { return loaded_ ? &loaded_->identity : nullptr; }
  /// The axis that is likely to be up instead of z; none without reason to doubt, or before the scene is loaded.
  [[nodiscard]] std::optional<UpAxis> likely_up() const { return loaded_ ? loaded_->likely_up : std::nullopt; }
  /// The unit that the scene's file states, unless it is applied, or the person has chosen one.
  [[nodiscard]] std::optional<LengthUnit> stated_unit() const {
    return loaded_ && !unit_is_chosen_ ? loaded_->report.stated_unit : std::nullopt;
  }
  /// The scene that the body collides with; null before it is loaded, for a ghost, and with a store.
  [[nodiscard]] std::shared_ptr<const World> world() const { return loaded_ ? loaded_->world : nullptr; }
  /// The names of its objects, by their numbers. Only with a world().
  [[nodiscard]] const std::vector<std::string>& object_names() const { return loaded_->objects; }
  /// The pager of the store that the body collides with; null if it collides with a scene.
  [[nodiscard]] const std::shared_ptr<Pager>& pager() const { return pager_; }

  /// The number of the collision's triangles; 0: not known.
  [[nodiscard]] std::uint64_t triangles() const;

  /// Makes the body collide with a store. The body stays where it is. Another thread frees the previous collision,
  /// whoever keeps it longest.
  void change_to(std::shared_ptr<Pager> pager);

  /// Waits for the tiles around the body that it may reach in `seconds`, as long as any are on their way; see
  /// scenes/arrivals.h. For a body that does not move in real time.
  void wait_for_tiles(double seconds);
  /// Checks for ground below the body. Call it after each step of `seconds`, or after a placement (0).
  void watch_footing(const StepReport& report, double seconds);
  /// Makes a body fly that has no ground below.
  void fly_without_ground();
  /// Notes some of the store's unreadable tiles. `now`: seconds since the session began.
  void note_failures(double now);

  void fill(Status& status) const;
  /// Adds the body, and moves out the meshes kept for --verify. `result` must be set already.
  void fill(ViewReport& report);

 private:
  void note_frame();
  void place_ghost(const Seen& seen, const Error& why);
  void tell_where_put();
  [[nodiscard]] bool is_ground_below() const;
  void name_blockage(ViewReport& report) const;

  ViewPlan plan_;
  std::string scene_names_;
  std::string kept_;  ///< the frame that the profile keeps, in words; empty: none
  bool unit_is_chosen_;
  bool needs_collision_;  ///< a path or --verify: a ghost does not suffice
  osgRoam::Manipulator& roamer_;
  News& news_;
  std::shared_ptr<Freeing> freeing_ = std::make_shared<Freeing>();
  std::optional<Collision> loaded_;
  std::shared_ptr<Pager> pager_;
  std::optional<TilesAround> around_;  ///< of a body that does not move in real time
  std::optional<Pose> start_;
  bool placed_ = false;
  bool without_ground_ = false;  ///< the body walks, and would fall out of the scene
  std::string collision_keys_;   ///< keys of all commands, while a ghost in an empty space lacks some
  std::string failure_told_;     ///< the store's failure noted last
  double failure_told_at_ = -1e9;
  CollisionLoader loader_;
};

}  // namespace roam::app
