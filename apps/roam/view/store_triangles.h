#pragma once
/// \file
/// A store's own triangles, for those who look at them.

#include <functional>
#include <string>
#include <vector>

#include "roam/store.h"
#include "view/display_loader.h"

namespace roam::app {

/// Triangles of a store that lie together.
struct StoreTriangles {
  std::vector<Triangle> triangles;
  Box box;                           ///< in which all are there, but for what is missing
  bool all = false;                  ///< these are all of the store's, but for what is missing
  std::vector<std::string> missing;  ///< tiles and pages that cannot be read, and why
};

/// Those within `reach` m of a place along each axis; within less where there are more than `most` of them. `goes_on`
/// is asked now and then, and ends it by false: roam::Cancelled.
[[nodiscard]] StoreTriangles triangles_around(const Store& store, const Vec3& place, double reach, std::size_t most,
                                              const std::function<bool()>& goes_on);

/// For a store whose scene is not there: the triangles around a place, as many as are drawn fluently, each piece handed
/// to `take`, and a sentence for the user of what is shown.
[[nodiscard]] DisplayReport show_store(const Store& store, const Vec3& place,
                                       const std::function<void(DisplayNode&&, std::uint64_t triangles)>& take,
                                       const std::function<bool()>& goes_on);

}  // namespace roam::app
