#pragma once
/// \file
/// A place to start from in a store, of which only little fits in memory.

#include "roam/store.h"
#include "wander.h"

namespace roam::app {

/// How many triangles of a store can be read and indexed in so many bytes.
[[nodiscard]] std::size_t indexed_in(std::uint64_t memory);

/// As wander_start, looking around a few places of the store that lie where its triangles are: at each as far as
/// `memory` (bytes) lets, 30 m at most.
[[nodiscard]] Vec3 store_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                               const std::function<bool()>& goes_on = {});

}  // namespace roam::app
