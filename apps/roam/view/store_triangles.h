#pragma once
/// \file
/// A store's own triangles, for display.

#include <functional>

#include "roam/store.h"
#include "scenes/triangles_around.h"
#include "view/display_loader.h"

namespace roam::app {

/// For a store without its scene: passes the triangles around `place` to `take`, piece by piece, as many as can be
/// drawn smoothly. The report has a sentence for the user about the part shown.
[[nodiscard]] DisplayReport show_store(const Store& store, const Vec3& place,
                                       const std::function<void(DisplayNode&&, std::uint64_t triangles)>& take,
                                       const std::function<bool()>& goes_on);

}  // namespace roam::app
