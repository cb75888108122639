// OSG + Bullet: the sweep of a sphere against one btBvhTriangleMeshShape; the slide is ours.

#include <btBulletCollisionCommon.h>

#include <memory>

#include "paper_movers.h"

namespace roam::bench {
namespace {

struct BulletScene {
  explicit BulletScene(const PaperScene& scene) {
    read_tiles(scene, vertices, indices);
    constexpr int index_stride = 3 * sizeof(std::uint32_t);
    constexpr int vertex_stride = 3 * sizeof(float);
    arrays = std::make_unique<btTriangleIndexVertexArray>(
        static_cast<int>(indices.size() / 3), reinterpret_cast<int*>(indices.data()), index_stride,
        static_cast<int>(vertices.size() / 3), vertices.data(), vertex_stride);
    shape = std::make_unique<btBvhTriangleMeshShape>(arrays.get(), true);
    shape->setMargin(0);
    object.setCollisionShape(shape.get());
    object.setWorldTransform(btTransform::getIdentity());
  }

  std::vector<float> vertices;
  std::vector<std::uint32_t> indices;
  std::unique_ptr<btTriangleIndexVertexArray> arrays;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btCollisionObject object;
};

btTransform at(const Vec3& p) {
  btTransform transform = btTransform::getIdentity();
  transform.setOrigin({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  return transform;
}

}  // namespace

Mover osg_bullet(const PaperScene& scene) {
  const auto world = std::make_shared<BulletScene>(scene);
  return collide_and_slide(
      [world](double radius, const Vec3& from, const Vec3& motion) -> std::optional<Touch> {
        const btSphereShape sphere(static_cast<float>(radius));
        const btTransform start = at(from), end = at(from + motion);
        btCollisionWorld::ClosestConvexResultCallback result(start.getOrigin(), end.getOrigin());
        btCollisionWorld::objectQuerySingle(&sphere, start, end, &world->object, world->shape.get(),
                                            world->object.getWorldTransform(), result, 0);
        if (!result.hasHit()) return std::nullopt;
        const btVector3& n = result.m_hitNormalWorld;
        return Touch{result.m_closestHitFraction, {n.x(), n.y(), n.z()}};
      },
      paper_shift);
}

}  // namespace roam::bench
