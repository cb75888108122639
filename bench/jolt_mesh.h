#pragma once
/// \file
/// A mesh for Jolt's queries: one MeshShape, whose leaves have four triangles.

#include <Jolt/Core/Factory.h>
#include <Jolt/Physics/Collision/Shape/MeshShape.h>
#include <Jolt/RegisterTypes.h>

#include <string>
#include <utility>

#include "float_mesh.h"
#include "roam/error.h"
#include "roam/math.h"

namespace roam::bench {

inline JPH::Vec3 to_jolt(const Vec3& v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// A capsule of Jolt stands along y; the benchmark's stand along z.
inline JPH::Quat upright() { return JPH::Quat::sRotation(JPH::Vec3::sAxisX(), 0.5F * JPH::JPH_PI); }

inline std::string jolt_version() {
  std::string version = std::to_string(JPH_VERSION_MAJOR);
  version.append(1, '.').append(std::to_string(JPH_VERSION_MINOR));
  return version.append(1, '.').append(std::to_string(JPH_VERSION_PATCH));
}

/// Starts Jolt once in the process, for the rest of its life.
inline void start_jolt() {
  [[maybe_unused]] static const bool started = [] {
    JPH::RegisterDefaultAllocator();
    JPH::Factory::sInstance = new JPH::Factory();
    JPH::RegisterTypes();
    return true;
  }();
}

/// Throws roam::Error if Jolt cannot make the shape.
inline JPH::RefConst<JPH::Shape> jolt_mesh(const FloatMesh& mesh) {
  start_jolt();
  JPH::VertexList vertices;
  vertices.reserve(mesh.vertices.size() / 3);
  for (std::size_t i = 0; i < mesh.vertices.size(); i += 3) {
    vertices.emplace_back(mesh.vertices[i], mesh.vertices[i + 1], mesh.vertices[i + 2]);
  }
  JPH::IndexedTriangleList triangles;
  triangles.reserve(mesh.indices.size() / 3);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    triangles.emplace_back(mesh.indices[i], mesh.indices[i + 1], mesh.indices[i + 2], 0);
  }
  JPH::MeshShapeSettings settings(std::move(vertices), std::move(triangles));
  settings.SetEmbedded();
  settings.mMaxTrianglesPerLeaf = 4;
  const JPH::ShapeSettings::ShapeResult made = settings.Create();
  if (made.HasError()) throw Error("Jolt cannot make this mesh: " + std::string(made.GetError().c_str()));
  return made.Get();
}

}  // namespace roam::bench
