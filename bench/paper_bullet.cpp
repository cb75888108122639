// OSG + Bullet, OGRE + Bullet: the sweep of a sphere in a btCollisionWorld whose static objects are the tiles. The
// slide is ours. One mesh per tile, as drawing programs have it, keeps Bullet's 16-bit node coordinates fine in scenes
// of any size.

#include <memory>
#include <utility>
#include <vector>

#include "bullet_mesh.h"
#include "paper_movers.h"

namespace roam::bench {
namespace {

// Metres. Bullet's sweep reports contact at once within 1 mm. A body that stops no farther off a wall is held by
// triangles that lean towards it.
constexpr double skin = 2e-3;

struct Tiles {
  std::vector<std::unique_ptr<BulletMesh>> meshes;  // used by the world, which therefore ends first
  btDefaultCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher{&configuration};
  btDbvtBroadphase broadphase;
  btCollisionWorld world{&dispatcher, &broadphase, &configuration};
};

/// The first touch that is not along the surface. Within 1 mm Bullet reports a touch at once, even if the body moves
/// along the wall that it has just slid off. Its floats, 0.06 mm apart at 600 m from the origin, only need to turn the
/// motion a little towards the wall. A body that slides by these results is then held for good.
///
/// Bullet's own btKinematicCharacterController also ignores hits by their normals, and pushes the body out in every
/// step. Nothing does that here. So only a motion that ends outside the wall may continue; otherwise many small steps
/// could add up to one into the wall.
struct Ahead : btCollisionWorld::ClosestConvexResultCallback {
  Ahead(const btTransform& from, const btTransform& to, btScalar body_radius)
      : ClosestConvexResultCallback(from.getOrigin(), to.getOrigin()), radius(body_radius) {}

  btScalar addSingleResult(btCollisionWorld::LocalConvexResult& result, bool in_world) override {
    constexpr btScalar along = 1e-4F;  // m: a whole motion must come no nearer than this
    constexpr btScalar least = 1e-4F;  // m: room for rounding
    const btTransform& object = result.m_hitCollisionObject->getWorldTransform();
    const btVector3 motion = m_convexToWorld - m_convexFromWorld;
    const btVector3 normal = in_world ? result.m_hitNormalLocal : object.getBasis() * result.m_hitNormalLocal;
    const btScalar left = normal.dot(m_convexToWorld - result.m_hitPointLocal) - radius;
    if (normal.dot(motion) > -along && left > least) return m_closestHitFraction;
    return ClosestConvexResultCallback::addSingleResult(result, in_world);
  }

  btScalar radius;
};

}  // namespace

Mover bullet_sweep(const PaperScene& scene, const TileReader& read) {
  const auto tiles = std::make_shared<Tiles>();
  read(scene, [&](FloatMesh tile) {
    tiles->meshes.push_back(std::make_unique<BulletMesh>(std::move(tile)));
    tiles->world.addCollisionObject(&tiles->meshes.back()->object);
  });
  return collide_and_slide(
      [tiles](double radius, const Vec3& from, const Vec3& motion) -> std::optional<Touch> {
        const btSphereShape sphere(static_cast<float>(radius));
        const btTransform start = at(from), end = at(from + motion);
        Ahead result(start, end, sphere.getRadius());
        tiles->world.convexSweepTest(&sphere, start, end, result, 0.0F);
        if (!result.hasHit()) return std::nullopt;
        const btVector3& n = result.m_hitNormalWorld;
        return Touch{result.m_closestHitFraction, {n.x(), n.y(), n.z()}};
      },
      paper_shift, skin);
}

}  // namespace roam::bench
