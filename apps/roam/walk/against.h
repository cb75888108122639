#pragma once
/// \file
/// `roam walk --against`: a walk through a store, checked against the scene that the store was made of.

#include <cstdint>
#include <functional>

#include "scenes/open_scene.h"
#include "verify/piece_log.h"

namespace roam::app {

/// Checks the input of verify_against() before a walk that may take hours. Throws UsageError for a store, and
/// roam::Error for a scene that is not there.
void check_against(const SceneOptions& scene);

/// Every piece against every triangle of a scene that is read piece by piece, however large it is. It is read once for
/// as many pieces as fit in half of the memory. Where it has not as many triangles as the store that was `walked`, a
/// note on standard error says so. `progress` as of verify, but with bytes done and in all.
[[nodiscard]] verification::Verification verify_against(
    const SceneOptions& scene, const OpenScene& walked, const verification::PieceLog& pieces,
    const std::function<bool(std::uint64_t, std::uint64_t)>& progress);

}  // namespace roam::app
