#pragma once
/// \file
/// Worlds that move in a space: doors, lifts, platforms, trains.
///
///     auto door = std::make_shared<roam::World>(roam::World::build(door_mesh));  // its hinge at the origin
///     roam::Instances scene(house);
///     const roam::ObjectId id = scene.add(door, {.position = hinge, .heading = 0.5 * pi}, {.name = "door"});
///     roam::Walker walker(scene, settings, roam::Mode::walk, start);
///     roam::Walker* const walkers[] = {&walker};
///     for (;;) {
///       scene.set_velocity(id, {.turning = 1.0});
///       // The door opens, and pushes who is in its way (roam/move_instances.h).
///       roam::move_instances(scene, walkers, dt);
///       walker.step(input, dt);
///     }
///
/// An instance stays upright: it is moved, and turned about +z. Every instance is one object: Impact::object is the
/// number that add() returned, whatever the objects of its world are. Instances pass through each other and through the
/// rest of the scene: only bodies stop them. All promises of space.h hold for the poses as
/// they are; where that says 2 mm, a hit of an instance is within 2.001 mm, up to 1e8 m from the instance.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "roam/space.h"
#include "roam/world.h"

namespace roam {

/// Where an instance is: a point p of its world is at position + p, turned by `heading` about +z.
struct Pose {
  Vec3 position{0.0};    ///< metres, each component at most coordinate_limit
  double heading = 0.0;  ///< radians, counterclockwise seen from above; finite

  [[nodiscard]] Vec3 to_scene(const Vec3& p) const;
  [[nodiscard]] Vec3 to_instance(const Vec3& p) const;
};

/// How an instance moves.
struct Velocity {
  Vec3 linear{0.0};      ///< of its origin, metres per second
  double turning = 0.0;  ///< radians per second, counterclockwise seen from above

  /// Of a point of the instance at that pose, both as seen in the scene: metres per second.
  [[nodiscard]] Vec3 at(const Pose& pose, const Vec3& point) const;
};

/// What an instance is called, and what the program keeps with it.
struct InstanceLabel {
  std::string name = {};
  std::uint64_t user_data = 0;
};

/// A space and what moves in it. Queries may run at the same time, but not during a change. Changes allocate, queries
/// do not. It is neither copied nor moved.
class Instances final : public LiveSpace {
 public:
  /// Metres. A world is refused if its largest_error() exceeds both this and that of the space; a body keeps its
  /// distance by the largest of all. Small worlds are within it; build large ones with BuildOptions::lossless.
  static constexpr double usual_error = 1e-4;

  /// `space` is what does not move: a World, a Pager, a Patchwork. It must outlive this and stay where it is. Its
  /// objects keep their numbers, and its triangles theirs. A LiveSpace is updated by update() here.
  /// Throws roam::Error for a space of instances.
  explicit Instances(const Space& space);
  explicit Instances(LiveSpace& space);
  explicit Instances(Space&& space) = delete;
  ~Instances() override;
  Instances(const Instances&) = delete;
  Instances& operator=(const Instances&) = delete;

  /// Adds an instance of `world`, at rest. Many instances may share one world. Returns its number, from 2^31 on, which
  /// is never used again. Throws roam::Error for a pose that is not finite or beyond coordinate_limit, and for a world
  /// that is null or stored too coarsely (see usual_error; BuildOptions::lossless).
  ObjectId add(std::shared_ptr<const World> world, const Pose& pose, InstanceLabel label = {});
  /// All of these throw roam::Error for a number of no instance.
  void remove(ObjectId instance);
  /// Puts the instance there at once. If it overlaps a body then, that body's next step frees or holds it (see
  /// Walker::place); move_instances() moves bodies along instead.
  void set_pose(ObjectId instance, const Pose& pose);
  [[nodiscard]] const Pose& pose(ObjectId instance) const;
  /// What move_instances() moves it by. Throws roam::Error for a velocity that is not finite.
  void set_velocity(ObjectId instance, const Velocity& velocity);
  [[nodiscard]] const Velocity& velocity(ObjectId instance) const;
  [[nodiscard]] const World& world(ObjectId instance) const;
  /// In the order in which they were added.
  [[nodiscard]] std::vector<ObjectId> instances() const;
  [[nodiscard]] bool has(ObjectId instance) const;

  /// That of the space which does not move; false where that is no LiveSpace.
  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;

  [[nodiscard]] SpaceFacts facts() const override;
  /// Of a triangle of an instance its number, and its label's name and user data.
  [[nodiscard]] Object object(TriangleId triangle) const override;
  /// The number of a triangle in its own world, or in the space that does not move.
  [[nodiscard]] static TriangleId source_triangle(TriangleId triangle);

 protected:
  [[nodiscard]] FirstImpact ask_first(const Query& query, Vicinity* vicinity) const override;
  void ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
