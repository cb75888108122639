#pragma once
/// \file
/// Checking a walk against the triangles of a store, of which only few fit in memory.

#include <cstdint>
#include <functional>

#include "roam/store.h"
#include "verify/piece_log.h"

namespace roam::verification {

/// Every piece against every triangle, as stored, as far as that can be read. Takes some 10 MB, however long the way
/// and however large the store is. `progress` as of verify().
[[nodiscard]] Verification verify(const Store& store, const PieceLog& pieces,
                                  const std::function<bool(std::uint64_t)>& progress = {});

}  // namespace roam::verification
