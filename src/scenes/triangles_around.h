#pragma once
/// \file
/// The triangles of a store around a place, up to a number.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "roam/mesh.h"
#include "roam/store.h"

namespace roam::app {

/// Triangles of a store that lie together.
struct StoreTriangles {
  std::vector<Triangle> triangles;
  Box box;                           ///< all triangles in it are here, except the missing ones
  bool all = false;                  ///< these are all triangles of the store, except the missing ones
  std::vector<std::string> missing;  ///< tiles and pages that cannot be read, and why
};

/// The triangles whose tiles meet the box. False if there are more than `most`; then `into` has only some of them.
/// Calls `goes_on` now and then; false throws roam::Cancelled.
[[nodiscard]] bool triangles_in(const Store& store, const Box& box, std::size_t most,
                                const std::function<bool()>& goes_on, StoreTriangles& into);

/// The triangles within `reach` m of a place along each axis; if there are more than `most`, within half of that, and
/// so on.
[[nodiscard]] StoreTriangles triangles_around(const Store& store, const Vec3& place, double reach, std::size_t most,
                                              const std::function<bool()>& goes_on);

}  // namespace roam::app
