#pragma once
/// \file
/// Where a body starts when nobody says it: wander_start, with sentences for those who started the program.

#include <functional>
#include <span>

#include "roam/store.h"
#include "roam/wander.h"

namespace roam::app {

/// How many triangles of a store can be read and indexed in so many bytes.
[[nodiscard]] std::size_t indexed_in(std::uint64_t memory);

/// The place of wander_start. Throws roam::Error where the body fits nowhere and in an empty scene.
[[nodiscard]] Vec3 free_start(const Space& space, const WalkerSettings& settings, Mode mode,
                              std::span<const Vec3> floors, const std::function<bool()>& goes_on = {});

/// The same of a store, looking around a few places of it that lie where its triangles are: at each as far as `memory`
/// (bytes) lets, 30 m at most.
[[nodiscard]] Vec3 free_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                              const std::function<bool()>& goes_on = {});

}  // namespace roam::app
