#pragma once
/// \file
/// The last step of a build.

#include "store/build/plan.h"
#include "store/build/work.h"

namespace roam::store {

/// Makes one store of the shards of the plan and puts it in force; then removes what no manifest in force names, and
/// the scratch folder. The store must be locked. Returns what tidy does.
[[nodiscard]] std::string merge(Work& work, const Plan& plan);

/// Removes what no manifest in force names, and the scratch folder. The store must be locked. Returns what
/// remove_scratch does.
[[nodiscard]] std::string tidy(const Folder& store);

/// Removes what builds keep to go on from. Returns a sentence for the user where that cannot be; else nothing.
std::string remove_scratch(const Folder& store);

}  // namespace roam::store
