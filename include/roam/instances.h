#pragma once
/// \file
/// Instances: worlds that move in a space, such as doors, lifts, platforms and trains.
///
///     auto door = std::make_shared<roam::World>(roam::World::build({&mesh, 1}));  // its hinge at the origin
///     roam::Instances scene(house);
///     const roam::ObjectId id = scene.add(door, {.position = hinge, .heading = 0.5 * pi}, "door");
///     scene.set_velocity(id, {.turning = 1.0});
///     roam::Walker walker(scene, settings, roam::Mode::walk, start);
///     roam::Walker* const walkers[] = {&walker};
///     for (;;) {
///       roam::move_instances(scene, walkers, dt);  // turns the door, and pushes bodies in its way
///       walker.step(input, dt);
///     }
///
/// Lengths are metres, angles radians, counterclockwise seen from above. An instance stays upright and turns about +z.
/// Each is one object, with the number that add() returns. Instances pass through each other and through the scene;
/// only bodies stop them. The promises of space.h hold for the current poses, except that a hit of an instance is
/// within 2.001 mm instead of 2 mm, up to 1e8 m from it.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "roam/space.h"
#include "roam/world.h"

namespace roam {

/// The pose of an instance: its world turned by `heading` about +z, then moved by `position`.
struct Pose {
  Vec3 position{0.0};    ///< each component at most coordinate_limit
  double heading = 0.0;  ///< finite

  [[nodiscard]] Vec3 to_scene(const Vec3& p) const;
  [[nodiscard]] Vec3 to_instance(const Vec3& p) const;
};

struct Velocity {
  Vec3 linear{0.0};      ///< of the instance's origin, m/s
  double turning = 0.0;  ///< rad/s

  /// The velocity, m/s, of a point at that pose, in the scene's frame.
  [[nodiscard]] Vec3 at(const Pose& pose, const Vec3& point) const;
};

/// A space and the instances in it. Queries may run at the same time, but not during a change. Changes allocate;
/// add(), remove() and set_pose() change nothing if they throw.
class Instances final : public LiveSpace {
 public:
  /// Metres. largest_error() is the larger of this and that of the space. add() refuses worlds with a larger error,
  /// such as those wider than some 7 m: build them lossless.
  static constexpr double usual_error = 1e-4;

  /// `space`, such as a World or a Pager, stands still. It must outlive this and keep its address. Its objects and
  /// triangles keep their numbers: those of triangles must be below 2^62, those of objects below 2^31. Throws
  /// roam::Error for a space of instances.
  explicit Instances(const Space& space);
  explicit Instances(LiveSpace& space);
  explicit Instances(Space&& space) = delete;
  ~Instances() override;
  Instances(const Instances&) = delete;
  Instances& operator=(const Instances&) = delete;

  /// Adds an instance of `world` at rest and returns its number, at least 2^31 and never reused. Instances may share a
  /// world. object() returns `name` and `user_data`. Throws roam::Error for a pose that is not finite or beyond
  /// coordinate_limit, a world that is null, too coarse (see usual_error) or larger than 4 billion triangles, and more
  /// than 2^30 instances.
  ObjectId add(std::shared_ptr<const World> world, const Pose& pose, std::string name = {},
               std::uint64_t user_data = 0);
  // Functions that take a number throw roam::Error if no instance has it, except has().
  void remove(ObjectId instance);
  /// Puts it there at once; a body that it then overlaps is freed or held by its next step. Throws as add() for a pose.
  void set_pose(ObjectId instance, const Pose& pose);
  [[nodiscard]] const Pose& pose(ObjectId instance) const;
  /// The velocity for move_instances(). Throws roam::Error if it is not finite.
  void set_velocity(ObjectId instance, const Velocity& velocity);
  [[nodiscard]] const Velocity& velocity(ObjectId instance) const;
  [[nodiscard]] const World& world(ObjectId instance) const;
  [[nodiscard]] std::vector<ObjectId> instances() const;  ///< in the order added
  [[nodiscard]] bool has(ObjectId instance) const;
  /// Updates the LiveSpace that this was made from; false if it was made from a plain Space.
  bool update(const Body& body, const Vec3& place, const Vec3& velocity) override;
  [[nodiscard]] SpaceFacts facts() const override;
  [[nodiscard]] Object object(TriangleId triangle) const override;
  [[nodiscard]] static TriangleId source_triangle(TriangleId triangle);  ///< its number in its own world or space

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override;
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace roam
