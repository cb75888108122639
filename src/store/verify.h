#pragma once
/// \file
/// What verification found, for repair.

#include <cstdint>
#include <functional>
#include <set>
#include <string>

#include "roam/store.h"
#include "store/manifest.h"

namespace roam::store {

struct Findings {
  StoreVerification report;
  std::set<std::string> shards;  ///< keys of those that must be built again
  std::set<std::string> parts;   ///< names of those whose files must be made again
};

[[nodiscard]] Findings find_damage(const std::filesystem::path& folder,
                                   const std::function<bool(std::uint64_t, std::uint64_t)>& progress);

}  // namespace roam::store
