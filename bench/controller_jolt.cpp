// Jolt's CharacterVirtual with its defaults, in a world that contains the mesh only. On foot it also climbs steps and
// keeps to the floor.

#include <Jolt/Core/TempAllocator.h>
#include <Jolt/Physics/Body/BodyCreationSettings.h>
#include <Jolt/Physics/Character/CharacterVirtual.h>
#include <Jolt/Physics/Collision/BroadPhase/BroadPhaseLayerInterfaceTable.h>
#include <Jolt/Physics/Collision/BroadPhase/ObjectVsBroadPhaseLayerFilterTable.h>
#include <Jolt/Physics/Collision/ObjectLayerPairFilterTable.h>
#include <Jolt/Physics/Collision/Shape/CapsuleShape.h>
#include <Jolt/Physics/Collision/Shape/RotatedTranslatedShape.h>
#include <Jolt/Physics/Collision/Shape/SphereShape.h>
#include <Jolt/Physics/PhysicsSystem.h>

#include <memory>

#include "controllers.h"
#include "jolt_mesh.h"

namespace roam::bench {
namespace {

constexpr double gravity = 9.81;                  // m/s2
constexpr unsigned temporary_bytes = 32U << 20U;  // for a step
constexpr JPH::ObjectLayer only_layer = 0;

/// One layer, in which everything collides.
struct Layer {
  Layer() {
    pairs.EnableCollision(only_layer, only_layer);
    broad.MapObjectToBroadPhaseLayer(only_layer, JPH::BroadPhaseLayer(0));
  }
  JPH::ObjectLayerPairFilterTable pairs{1};
  JPH::BroadPhaseLayerInterfaceTable broad{1, 1};
};

struct World {
  Layer layer;
  JPH::ObjectVsBroadPhaseLayerFilterTable filter{layer.broad, 1, layer.pairs, 1};
  JPH::PhysicsSystem system;
  std::unique_ptr<JPH::TempAllocatorImpl> temporary;
  JPH::Ref<JPH::CharacterVirtual> body;
  JPH::CharacterVirtual::ExtendedUpdateSettings how;
  bool walking = false;
  double falling = 0.0;  // m/s
};

void place(World& world, const Way& way) {
  const auto radius = static_cast<float>(way.radius);
  const auto half_axis = static_cast<float>(way.body().half_height);
  JPH::RefConst<JPH::Shape> shape;
  if (half_axis > 0) {
    shape = new JPH::CapsuleShape(half_axis, radius);
  } else {
    shape = new JPH::SphereShape(radius);
  }
  JPH::CharacterVirtualSettings settings;
  settings.SetEmbedded();
  settings.mUp = JPH::Vec3::sAxisZ();
  settings.mSupportingVolume = JPH::Plane(settings.mUp, half_axis);  // contacts of the lower half ball
  settings.mMaxSlopeAngle = 0.25F * JPH::JPH_PI;
  settings.mShape = new JPH::RotatedTranslatedShape(JPH::Vec3::sZero(), upright(), shape);
  world.body =
      new JPH::CharacterVirtual(&settings, JPH::RVec3(to_jolt(way.from)), JPH::Quat::sIdentity(), 0, &world.system);
  world.how.mStickToFloorStepDown = JPH::Vec3(0.0F, 0.0F, -static_cast<float>(step_height));
  world.how.mWalkStairsStepUp = JPH::Vec3(0.0F, 0.0F, static_cast<float>(step_height));
  world.walking = way.walking;
  world.falling = 0.0;
}

Vec3 step(World& world, const Vec3& velocity) {
  constexpr double dt = 1.0 / paper_rate;
  constexpr auto seconds = static_cast<float>(dt);
  JPH::CharacterVirtual& body = *world.body;
  const JPH::DefaultBroadPhaseLayerFilter broad(world.filter, only_layer);
  const JPH::DefaultObjectLayerFilter narrow(world.layer.pairs, only_layer);
  if (world.walking) {
    const bool stands = body.GetGroundState() == JPH::CharacterBase::EGroundState::OnGround;
    world.falling = stands ? 0.0 : world.falling + gravity * dt;
    body.SetLinearVelocity(to_jolt(velocity - Vec3(0.0, 0.0, world.falling)));
    body.ExtendedUpdate(seconds, to_jolt({0.0, 0.0, -gravity}), world.how, broad, narrow, {}, {}, *world.temporary);
  } else {
    body.SetLinearVelocity(to_jolt(velocity));
    body.Update(seconds, JPH::Vec3::sZero(), broad, narrow, {}, {}, *world.temporary);
  }
  const JPH::RVec3 at = body.GetPosition();
  return {at.GetX(), at.GetY(), at.GetZ()};
}

}  // namespace

Mover jolt_controller(const Scene& scene) {
  start_jolt();
  const auto world = std::make_shared<World>();
  world->temporary = std::make_unique<JPH::TempAllocatorImpl>(temporary_bytes);
  world->system.Init(1, 0, 1, 1, world->layer.broad, world->filter, world->layer.pairs);
  const JPH::BodyCreationSettings walls(jolt_mesh(FloatMesh(scene)), JPH::RVec3::sZero(), JPH::Quat::sIdentity(),
                                        JPH::EMotionType::Static, only_layer);
  world->system.GetBodyInterfaceNoLock().CreateAndAddBody(walls, JPH::EActivation::DontActivate);
  Mover mover;
  mover.place = [world](const Way& way) { place(*world, way); };
  mover.step = [world](const Vec3& velocity) { return step(*world, velocity); };
  return mover;
}

}  // namespace roam::bench
