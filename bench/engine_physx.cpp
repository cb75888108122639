// PhysX as its user built it: its sweep of one geometry against the mesh alone, without a scene around it.

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <memory>

#include "engine.h"
#include "memory.h"
#include "physx_mesh.h"

namespace roam::bench {
namespace {

using physx::PxTransform;

Answer sweep(const PhysxMesh& mesh, const physx::PxGeometry& body, const PxTransform& at, const Query& query) {
  const auto length = static_cast<float>(glm::length(query.motion));
  const physx::PxVec3 direction = to_physx(query.motion) / length;
  physx::PxGeomSweepHit hit;
  const bool touches =
      physx::PxGeometryQuery::sweep(direction, length, body, at, mesh.geometry, PxTransform(physx::PxIdentity), hit,
                                    physx::PxHitFlag::eMESH_BOTH_SIDES | physx::PxHitFlag::eNORMAL);
  return touches ? Answer{true, static_cast<double>(hit.distance) / length} : Answer{};
}

Answer ray(const PhysxMesh& mesh, const Query& query) {
  const auto length = static_cast<float>(glm::length(query.motion));
  physx::PxGeomRaycastHit hit;
  const physx::PxU32 hits = physx::PxGeometryQuery::raycast(to_physx(query.from), to_physx(query.motion) / length,
                                                            mesh.geometry, PxTransform(physx::PxIdentity), length,
                                                            physx::PxHitFlag::eMESH_BOTH_SIDES, 1, &hit);
  return hits > 0 ? Answer{true, static_cast<double>(hit.distance) / length} : Answer{};
}

}  // namespace

Engine make_physx(const Scene& scene) {
  Engine engine{.name = "PhysX " + physx_version(), .used = {}, .rays = true};
  const std::size_t before = allocated_bytes();
  std::shared_ptr<PhysxMesh> mesh;
  engine.build_one = seconds([&] { mesh = std::make_shared<PhysxMesh>(FloatMesh(scene)); });
  engine.bytes = allocated_bytes() - before;
  engine.used = "PxGeometryQuery::sweep, " + std::to_string(mesh->leaf_triangles) +
                " triangles a leaf, floats; rays: raycast; nearest: pointDistance";
  engine.ask = timed([mesh](const Query& query) {
    if (query.body.radius == 0) return ray(*mesh, query);
    const auto radius = static_cast<float>(query.body.radius);
    if (query.body.half_height == 0) {
      return sweep(*mesh, physx::PxSphereGeometry(radius), PxTransform(to_physx(query.from)), query);
    }
    // A capsule of PhysX lies along x; those of the queries stand along z.
    const physx::PxQuat upright(-0.5F * physx::PxPi, {0.0F, 1.0F, 0.0F});
    return sweep(*mesh, physx::PxCapsuleGeometry(radius, static_cast<float>(query.body.half_height)),
                 PxTransform(to_physx(query.from), upright), query);
  });
  engine.nearest = timed([mesh](const Query& query) {
    const float square =
        physx::PxGeometryQuery::pointDistance(to_physx(query.from), mesh->geometry, PxTransform(physx::PxIdentity));
    return Answer{.distance = std::min<double>(std::sqrt(square), nearest_reach)};
  });
  return engine;
}

}  // namespace roam::bench
