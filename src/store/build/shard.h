#pragma once
/// \file
/// Makes the pack of one shard.

#include <functional>

#include "store/build/plan.h"
#include "store/build/work.h"

namespace roam::store {

/// Builds the shard and writes its pack but for what `publish` does: syncing the pack and the file that says that the
/// shard is there. `publish` may be called by another thread, while the next shard is built.
[[nodiscard]] std::function<void()> make_shard(Work& work, const Plan& plan, const PlannedShard& shard);

}  // namespace roam::store
