#pragma once
/// \file
/// The triangles of a store that lie around a place, as many as are wanted.

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
  Box box;                           ///< in which all are there, but for what is missing
  bool all = false;                  ///< these are all of the store's, but for what is missing
  std::vector<std::string> missing;  ///< tiles and pages that cannot be read, and why
};

/// Those whose tiles meet the box; false where they are more than `most`, and then only some of them. `goes_on` is
/// asked now and then, and ends it by false: roam::Cancelled.
[[nodiscard]] bool triangles_in(const Store& store, const Box& box, std::size_t most,
                                const std::function<bool()>& goes_on, StoreTriangles& into);

/// Those within `reach` m of a place along each axis; within half of that, and so on, where they are more than `most`.
[[nodiscard]] StoreTriangles triangles_around(const Store& store, const Vec3& place, double reach, std::size_t most,
                                              const std::function<bool()>& goes_on);

}  // namespace roam::app
