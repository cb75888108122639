// PhysX's capsule controller in a scene that contains the mesh only. A sphere is a capsule with a cylinder of 2 mm, the
// least allowed height.

#include <algorithm>
#include <memory>

#include "controllers.h"
#include "physx_mesh.h"

namespace roam::bench {
namespace {

using namespace physx;

constexpr double gravity = 9.81;         // m/s2
constexpr float contact_offset = 0.01F;  // m: the body stays so far off
constexpr float least_cylinder = 0.002F;

/// Nothing is simulated, so nothing is dispatched and nothing filtered.
struct Idle : PxCpuDispatcher {
  void submitTask(PxBaseTask&) override {}
  [[nodiscard]] uint32_t getWorkerCount() const override { return 0; }
};

PxFilterFlags all(PxFilterObjectAttributes, PxFilterData, PxFilterObjectAttributes, PxFilterData, PxPairFlags&,
                  const void*, PxU32) {
  return {};
}

struct World {
  explicit World(const Scene& from) : mesh(FloatMesh(from)) {
    static PxPhysics* physics = PxCreatePhysics(PX_PHYSICS_VERSION, physx_foundation(), PxTolerancesScale());
    if (physics == nullptr) throw Error("PhysX does not start");
    PxSceneDesc desc(physics->getTolerancesScale());
    desc.cpuDispatcher = &idle;
    desc.filterShader = all;
    scene = physics->createScene(desc);
    material = physics->createMaterial(0.0F, 0.0F, 0.0F);
    PxRigidStatic* walls = physics->createRigidStatic(PxTransform(PxIdentity));
    walls->attachShape(*physics->createShape(mesh.geometry, *material, true));
    scene->addActor(*walls);
    manager = PxCreateControllerManager(*scene);
  }
  ~World() {
    manager->release();
    scene->release();
  }
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  PhysxMesh mesh;
  Idle idle;
  PxScene* scene = nullptr;
  PxMaterial* material = nullptr;
  PxControllerManager* manager = nullptr;
  PxController* body = nullptr;
  bool walking = false;
  double falling = 0.0;  // m/s
};

void place(World& world, const Way& way) {
  if (world.body != nullptr) world.body->release();
  PxCapsuleControllerDesc desc;
  desc.radius = static_cast<float>(way.radius);
  desc.height = std::max(least_cylinder, static_cast<float>(2.0 * way.body().half_height));
  desc.upDirection = {0.0F, 0.0F, 1.0F};
  desc.position = {way.from.x, way.from.y, way.from.z};
  desc.contactOffset = contact_offset;
  desc.stepOffset = way.walking ? static_cast<float>(step_height) : 0.0F;
  desc.slopeLimit = way.walking ? PxSqrt(0.5F) : 0.0F;  // the cosine; 0: no slope is too steep
  desc.material = world.material;
  world.body = world.manager->createController(desc);
  if (world.body == nullptr) throw Error("PhysX does not take this body");
  world.walking = way.walking;
  world.falling = 0.0;
}

Vec3 step(World& world, const Vec3& velocity) {
  constexpr double dt = 1.0 / paper_rate;
  if (world.walking) world.falling += gravity * dt;
  const PxVec3 motion = to_physx((velocity - Vec3(0.0, 0.0, world.falling)) * dt);
  const PxControllerCollisionFlags touched = world.body->move(motion, 0.0F, static_cast<float>(dt), {});
  if (touched.isSet(PxControllerCollisionFlag::eCOLLISION_DOWN)) world.falling = 0.0;
  const PxExtendedVec3 at = world.body->getPosition();
  return {at.x, at.y, at.z};
}

}  // namespace

Mover physx_controller(const Scene& scene) {
  const auto world = std::make_shared<World>(scene);
  Mover mover;
  mover.place = [world](const Way& way) { place(*world, way); };
  mover.step = [world](const Vec3& velocity) { return step(*world, velocity); };
  return mover;
}

}  // namespace roam::bench
