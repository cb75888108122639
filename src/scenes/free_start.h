#pragma once
/// \file
/// The default start of a body: wander_start, with errors for users of the program.

#include <functional>
#include <span>

#include "roam/store.h"
#include "roam/wander.h"

namespace roam::app {

/// The number of triangles of a store that can be read and indexed in `memory` bytes.
[[nodiscard]] std::size_t indexed_in(std::uint64_t memory);

/// The start of wander_start, not within anything solid if `meshes`, the triangles of the space, are passed. Throws
/// roam::Error if the body fits nowhere, or if the scene is empty.
[[nodiscard]] WanderStart free_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                     std::span<const Vec3> floors, std::span<const Mesh> meshes = {},
                                     const std::function<bool()>& goes_on = {});

/// The same for a store. Examines a few places near its triangles, each as far as `memory` (bytes) allows, at most 30
/// m.
[[nodiscard]] WanderStart free_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings,
                                     Mode mode, const std::function<bool()>& goes_on = {});

}  // namespace roam::app
