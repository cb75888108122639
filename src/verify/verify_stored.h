#pragma once
/// \file
/// Checks a walk against the triangles of a store, of which only few fit in memory.

#include <cstdint>
#include <functional>

#include "roam/store.h"
#include "verify/piece_log.h"

namespace roam::verification {

/// Checks every piece against every triangle, as stored, that can be read. Takes some 10 MB for any way and store.
/// `progress` as in verify().
[[nodiscard]] Verification verify(const Store& store, const PieceLog& pieces,
                                  const std::function<bool(std::uint64_t)>& progress = {});

}  // namespace roam::verification
