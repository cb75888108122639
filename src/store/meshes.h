#pragma once
/// \file
/// The triangles of a store as meshes of triangles that share no vertex.

#include <functional>
#include <span>
#include <string>

#include "roam/mesh.h"
#include "roam/store.h"

namespace roam::store {

/// Adds triangles to a mesh.
void append(Mesh& mesh, std::span<const Triangle> triangles);

/// Hands out the triangles whose tiles meet the box as meshes of some 30,000 triangles, 2.8 MB. `missing` as of
/// Store::for_each_triangle.
void each_mesh(const Store& store, const Box& box, const std::function<void(const Mesh&)>& take,
               const std::function<void(const std::string&)>& missing);

}  // namespace roam::store
