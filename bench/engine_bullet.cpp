// Bullet as Debian builds it: floats. Its allowed penetration and the margin of the mesh are 0.

#include <memory>

#include "bullet_mesh.h"
#include "engine.h"
#include "memory.h"

namespace roam::bench {
namespace {

Answer cast(BulletMesh& world, const btConvexShape& shape, const Query& query) {
  const auto result = sweep(world, shape, query.from, query.from + query.motion);
  return {result.hasHit(), result.m_closestHitFraction};
}

}  // namespace

Engine make_bullet(const Scene& scene) {
  static_assert(sizeof(btScalar) == sizeof(float));
  Engine engine{
      .name = "Bullet " + std::to_string(BT_BULLET_VERSION / 100) + "." + std::to_string(BT_BULLET_VERSION % 100),
      .used = "objectQuerySingle, btBvhTriangleMeshShape, floats"};
  const std::size_t before = allocated_bytes();
  std::shared_ptr<BulletMesh> world;
  engine.build_one = seconds([&] { world = std::make_shared<BulletMesh>(FloatMesh(scene)); });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([world](const Query& query) {
    const auto radius = static_cast<float>(query.body.radius);
    if (query.body.half_height == 0) return cast(*world, btSphereShape(radius), query);
    return cast(*world, btCapsuleShapeZ(radius, static_cast<float>(2 * query.body.half_height)), query);
  });
  return engine;
}

}  // namespace roam::bench
