// Bullet as Debian builds it: floats. btCollisionWorld::objectQuerySingle is what its convexSweepTest calls for each
// object; asked directly it saves the broad phase, which has one object here. The mesh is a btBvhTriangleMeshShape with
// quantized nodes, its margin 0 (the default of 4 cm would make it hit that much earlier), as is the allowed
// penetration.

#include <btBulletCollisionCommon.h>

#include <memory>

#include "engine.h"
#include "float_mesh.h"
#include "memory.h"

namespace roam::bench {
namespace {

struct BulletWorld {
  explicit BulletWorld(const Scene& scene) : mesh(scene) {
    const auto triangles = static_cast<int>(mesh.indices.size() / 3);
    const auto corners = static_cast<int>(mesh.vertices.size() / 3);
    constexpr int index_stride = 3 * sizeof(std::uint32_t);
    constexpr int vertex_stride = 3 * sizeof(float);
    arrays = std::make_unique<btTriangleIndexVertexArray>(triangles, reinterpret_cast<int*>(mesh.indices.data()),
                                                          index_stride, corners, mesh.vertices.data(), vertex_stride);
    shape = std::make_unique<btBvhTriangleMeshShape>(arrays.get(), true);
    shape->setMargin(0);
    object.setCollisionShape(shape.get());
    object.setWorldTransform(btTransform::getIdentity());
  }

  FloatMesh mesh;
  std::unique_ptr<btTriangleIndexVertexArray> arrays;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btCollisionObject object;
};

btTransform at(const Vec3& p) {
  btTransform transform = btTransform::getIdentity();
  transform.setOrigin({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  return transform;
}

Answer cast(BulletWorld& world, const btConvexShape& shape, const Query& query) {
  const btTransform from = at(query.from);
  const btTransform to = at(query.from + query.motion);
  btCollisionWorld::ClosestConvexResultCallback result(from.getOrigin(), to.getOrigin());
  btCollisionWorld::objectQuerySingle(&shape, from, to, &world.object, world.shape.get(),
                                      world.object.getWorldTransform(), result, 0);
  return {result.hasHit(), result.m_closestHitFraction};
}

}  // namespace

Engine make_bullet(const Scene& scene) {
  static_assert(sizeof(btScalar) == sizeof(float));
  Engine engine{
      .name = "Bullet " + std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100),
      .used = "objectQuerySingle, btBvhTriangleMeshShape, floats"};
  const std::size_t before = allocated_bytes();
  std::shared_ptr<BulletWorld> world;
  engine.build_one = seconds([&] { world = std::make_shared<BulletWorld>(scene); });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([world](const Query& query) {
    const auto radius = static_cast<float>(query.body.radius);
    if (query.body.half_height == 0) return cast(*world, btSphereShape(radius), query);
    return cast(*world, btCapsuleShapeZ(radius, static_cast<float>(2 * query.body.half_height)), query);
  });
  return engine;
}

}  // namespace roam::bench
