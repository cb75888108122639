#pragma once
/// \file
/// A mesh for PhysX's queries: cooked with the default tree, as few triangles a leaf as it can cook, both sides of a
/// triangle solid.

#include <PxPhysicsAPI.h>

#include <string>

#include "float_mesh.h"
#include "roam/error.h"
#include "roam/math.h"

namespace roam::bench {

inline physx::PxVec3 to_physx(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

inline std::string physx_version() {
  std::string version = std::to_string(PX_PHYSICS_VERSION_MAJOR);
  version.append(1, '.').append(std::to_string(PX_PHYSICS_VERSION_MINOR));
  return version.append(1, '.').append(std::to_string(PX_PHYSICS_VERSION_BUGFIX));
}

/// PhysX's foundation, started once in the process for the rest of its life. What it says is not told: cooking a mesh
/// with too small leaves is tried, and may fail.
inline physx::PxFoundation& physx_foundation() {
  struct Silent : physx::PxErrorCallback {
    void reportError(physx::PxErrorCode::Enum, const char*, const char*, int) override {}
  };
  static physx::PxDefaultAllocator allocator;
  static Silent errors;
  static physx::PxFoundation* foundation = PxCreateFoundation(PX_PHYSICS_VERSION, allocator, errors);
  if (foundation == nullptr) throw Error("PhysX does not start");
  return *foundation;
}

/// Owns the cooked mesh; PhysX does not need the triangles afterwards.
struct PhysxMesh {
  explicit PhysxMesh(const FloatMesh& triangles) {
    (void)physx_foundation();
    physx::PxTriangleMeshDesc desc;
    desc.points.stride = 3 * sizeof(float);
    desc.points.data = triangles.vertices.data();
    desc.points.count = static_cast<physx::PxU32>(triangles.vertices.size() / 3);
    desc.triangles.stride = 3 * sizeof(std::uint32_t);
    desc.triangles.data = triangles.indices.data();
    desc.triangles.count = static_cast<physx::PxU32>(triangles.indices.size() / 3);
    physx::PxCookingParams cooking{physx::PxTolerancesScale()};
    cooking.midphaseDesc.setToDefault(physx::PxMeshMidPhase::eBVH34);
    for (const unsigned leaf : {4U, 8U}) {  // large meshes have too many nodes with 4
      cooking.midphaseDesc.mBVH34Desc.numPrimsPerLeaf = leaf_triangles = leaf;
      mesh = PxCreateTriangleMesh(cooking, desc);
      if (mesh != nullptr) break;
    }
    if (mesh == nullptr) throw Error("PhysX cannot cook this mesh");
    geometry.triangleMesh = mesh;
    geometry.meshFlags = physx::PxMeshGeometryFlag::eDOUBLE_SIDED;
  }
  ~PhysxMesh() {
    if (mesh != nullptr) mesh->release();
  }
  PhysxMesh(const PhysxMesh&) = delete;
  PhysxMesh& operator=(const PhysxMesh&) = delete;

  unsigned leaf_triangles = 0;
  physx::PxTriangleMesh* mesh = nullptr;
  physx::PxTriangleMeshGeometry geometry;
};

}  // namespace roam::bench
