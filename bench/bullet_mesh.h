#pragma once
/// \file
/// A mesh for Bullet's sweeps: a btBvhTriangleMeshShape with quantized nodes and a margin of 0. The default margin of 4
/// cm would give hits that much earlier.

#include <btBulletCollisionCommon.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "float_mesh.h"
#include "roam/math.h"

namespace roam::bench {

/// Bullet keeps pointers into it, so it cannot move.
struct BulletMesh {
  explicit BulletMesh(FloatMesh triangles) : mesh(std::move(triangles)) {
    // A quantized node has 21 bits for a triangle and 10 for its part.
    constexpr std::size_t part_triangles = 1u << 21;
    arrays = std::make_unique<btTriangleIndexVertexArray>();
    const std::size_t count = mesh.indices.size() / 3;
    for (std::size_t first = 0; first < count; first += part_triangles) {
      btIndexedMesh part;
      part.m_numTriangles = static_cast<int>(std::min(part_triangles, count - first));
      part.m_triangleIndexBase = reinterpret_cast<const unsigned char*>(mesh.indices.data() + 3 * first);
      part.m_triangleIndexStride = 3 * sizeof(std::uint32_t);
      part.m_numVertices = static_cast<int>(mesh.vertices.size() / 3);
      part.m_vertexBase = reinterpret_cast<const unsigned char*>(mesh.vertices.data());
      part.m_vertexStride = 3 * sizeof(float);
      arrays->addIndexedMesh(part);
    }
    shape = std::make_unique<btBvhTriangleMeshShape>(arrays.get(), true);
    shape->setMargin(0);
    object.setCollisionShape(shape.get());
    object.setWorldTransform(btTransform::getIdentity());
  }
  BulletMesh(const BulletMesh&) = delete;
  BulletMesh& operator=(const BulletMesh&) = delete;

  FloatMesh mesh;
  std::unique_ptr<btTriangleIndexVertexArray> arrays;
  std::unique_ptr<btBvhTriangleMeshShape> shape;
  btCollisionObject object;
};

/// An upright transform at a place (metres, rounded to floats).
inline btTransform at(const Vec3& p) {
  btTransform transform = btTransform::getIdentity();
  transform.setOrigin({static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)});
  return transform;
}

/// The first contact of a body that moves straight from one place to another. convexSweepTest makes the same call for
/// each object; this skips the broad phase, which has only one object here.
inline btCollisionWorld::ClosestConvexResultCallback sweep(BulletMesh& world, const btConvexShape& body,
                                                           const Vec3& from, const Vec3& to) {
  const btTransform start = at(from), end = at(to);
  btCollisionWorld::ClosestConvexResultCallback result(start.getOrigin(), end.getOrigin());
  btCollisionWorld::objectQuerySingle(&body, start, end, &world.object, world.shape.get(),
                                      world.object.getWorldTransform(), result, 0);
  return result;
}

}  // namespace roam::bench
