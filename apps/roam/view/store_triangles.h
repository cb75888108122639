#pragma once
/// \file
/// A store's own triangles, for those who look at them.

#include <functional>

#include "roam/store.h"
#include "scenes/triangles_around.h"
#include "view/display_loader.h"

namespace roam::app {

/// For a store whose scene is not there: the triangles around a place, as many as are drawn fluently, each piece handed
/// to `take`, and a sentence for the user of what is shown.
[[nodiscard]] DisplayReport show_store(const Store& store, const Vec3& place,
                                       const std::function<void(DisplayNode&&, std::uint64_t triangles)>& take,
                                       const std::function<bool()>& goes_on);

}  // namespace roam::app
