// Bullet's kinematic character controller with its defaults, in a world that contains the mesh only. It stands some
// centimetres deep in floors. With a greatest depth of 0 (setMaxPenetrationDepth) it is three times as slow, and half
// as deep.

#include <BulletCollision/CollisionDispatch/btGhostObject.h>
#include <BulletDynamics/Character/btKinematicCharacterController.h>

#include <memory>
#include <optional>

#include "bullet_mesh.h"
#include "controllers.h"

namespace roam::bench {
namespace {

constexpr float gravity = 9.81F;  // m/s2

struct World {
  explicit World(const Scene& scene) : walls(FloatMesh(scene)) {
    broadphase.getOverlappingPairCache()->setInternalGhostPairCallback(&ghosts);
    world.addCollisionObject(&walls.object, btBroadphaseProxy::StaticFilter, btBroadphaseProxy::CharacterFilter);
  }
  ~World() { remove(); }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void remove() {
    controller.reset();
    if (body) world.removeCollisionObject(&*body);
  }

  BulletMesh walls;  // used by the world, which therefore ends first
  btGhostPairCallback ghosts;
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
  std::unique_ptr<btConvexShape> shape;
  std::optional<btPairCachingGhostObject> body;
  std::optional<btKinematicCharacterController> controller;
};

void place(World& world, const Way& way) {
  world.remove();
  const auto radius = static_cast<float>(way.radius);
  const auto axis = static_cast<float>(2.0 * way.body().half_height);
  if (axis > 0) {
    world.shape = std::make_unique<btCapsuleShapeZ>(radius, axis);
  } else {
    world.shape = std::make_unique<btSphereShape>(radius);
  }
  btPairCachingGhostObject& body = world.body.emplace();
  body.setCollisionShape(world.shape.get());
  body.setCollisionFlags(btCollisionObject::CF_CHARACTER_OBJECT);
  body.setWorldTransform(at(way.from));
  world.world.addCollisionObject(&body, btBroadphaseProxy::CharacterFilter, btBroadphaseProxy::StaticFilter);
  const float step = way.walking ? static_cast<float>(step_height) : 0.0F;
  btKinematicCharacterController& controller =
      world.controller.emplace(&body, world.shape.get(), step, btVector3(0.0F, 0.0F, 1.0F));
  controller.setGravity({0.0F, 0.0F, way.walking ? -gravity : 0.0F});
  controller.setMaxSlope(SIMD_PI / 4.0F);
}

Vec3 step(World& world, const Vec3& velocity) {
  constexpr double dt = 1.0 / paper_rate;
  const Vec3 way = velocity * dt;
  world.controller->setWalkDirection({static_cast<float>(way.x), static_cast<float>(way.y), static_cast<float>(way.z)});
  world.controller->updateAction(&world.world, static_cast<float>(dt));
  const btVector3& p = world.body->getWorldTransform().getOrigin();
  return {p.x(), p.y(), p.z()};
}

}  // namespace

Mover bullet_controller(const Scene& scene) {
  const auto world = std::make_shared<World>(scene);
  Mover mover;
  mover.place = [world](const Way& way) { place(*world, way); };
  mover.step = [world](const Vec3& velocity) { return step(*world, velocity); };
  return mover;
}

}  // namespace roam::bench
