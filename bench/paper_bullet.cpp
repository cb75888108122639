// OSG + Bullet: the sweep of a sphere against one btBvhTriangleMeshShape; the slide is ours.

#include <memory>
#include <utility>

#include "bullet_mesh.h"
#include "paper_movers.h"

namespace roam::bench {

Mover osg_bullet(const PaperScene& scene) {
  FloatMesh mesh;
  read_tiles(scene, mesh.vertices, mesh.indices);
  const auto world = std::make_shared<BulletMesh>(std::move(mesh));
  return collide_and_slide(
      [world](double radius, const Vec3& from, const Vec3& motion) -> std::optional<Touch> {
        const btSphereShape sphere(static_cast<float>(radius));
        const auto result = sweep(*world, sphere, from, from + motion);
        if (!result.hasHit()) return std::nullopt;
        const btVector3& n = result.m_hitNormalWorld;
        return Touch{result.m_closestHitFraction, {n.x(), n.y(), n.z()}};
      },
      paper_shift);
}

}  // namespace roam::bench
