#pragma once
/// \file
/// The triangles of a store, a few at a time.

#include <functional>
#include <string>

#include "roam/mesh.h"
#include "roam/store.h"

namespace roam::app {

/// Hands out the triangles whose tiles meet the box as meshes of some 30,000 triangles, 2.8 MB. `missing` as of
/// Store::for_each_triangle. Throws roam::Cancelled after Ctrl-C.
void each_mesh(const Store& store, const Box& box, const std::function<void(const Mesh&)>& take,
               const std::function<void(const std::string&)>& missing);

}  // namespace roam::app
