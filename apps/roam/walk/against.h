#pragma once
/// \file
/// `roam walk --against`: verification of a walk through a store against the store's scene.

#include <cstdint>
#include <functional>

#include "check/check.h"
#include "scenes/open_scene.h"
#include "verify/piece_log.h"

namespace roam::app {

/// Prepares verify_against() before a walk that may take hours: `against` takes the options of reading that the user
/// gave for `walked`, which keeps them unless it is a store. Throws UsageError if `against` is a store, and roam::Error
/// if it is missing.
void prepare_against(SceneOptions& walked, SceneOptions& against);

/// Checks every piece against every triangle of `against`, a scene of any size, which is read part by part: once for as
/// many pieces as fit in half of the memory. If its triangle count and that of the `walked` store differ, a note on
/// standard error says so. `progress` is that of verify, with bytes: done, and in all. The scene is added to `sum`.
[[nodiscard]] verification::Verification verify_against(
    const SceneOptions& against, const OpenScene& walked, const verification::PieceLog& pieces,
    const std::function<bool(std::uint64_t, std::uint64_t)>& progress, checking::SceneSum& sum);

}  // namespace roam::app
