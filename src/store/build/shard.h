#pragma once
/// \file
/// Builds the pack of one shard.

#include <functional>

#include "store/build/plan.h"
#include "store/build/work.h"

namespace roam::store {

/// Builds the shard and writes its pack. The returned function publishes it: it syncs the pack and writes the shard's
/// file. Another thread may call it while the next shard is built.
[[nodiscard]] std::function<void()> make_shard(Work& work, const Plan& plan, const PlannedShard& shard);

}  // namespace roam::store
