#pragma once
/// \file
/// A place to start from in a store, of which only little fits in memory.

#include "roam/store.h"
#include "wander.h"

namespace roam::app {

/// As wander_start, looking around a few places of the store that lie where its triangles are.
[[nodiscard]] Vec3 store_start(const Store& store, const WalkerSettings& settings, Mode mode,
                               const std::function<bool()>& goes_on = {});

}  // namespace roam::app
