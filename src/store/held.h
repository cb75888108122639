#pragma once
/// \file
/// A store that is held: all that is read of it is of one folder, whatever takes its place.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>

#include "roam/store.h"
#include "store/folder.h"

namespace roam::store {

/// The folder of a store, held. Throws as Store::open does.
[[nodiscard]] Folder hold_store(const std::filesystem::path& folder);
/// Store::open of a folder.
[[nodiscard]] std::shared_ptr<const Store> open_store(const Folder& folder, std::uint64_t memory = Store::usual_memory);
/// roam::verify_store of a folder.
[[nodiscard]] StoreVerification verify_store(const Folder& folder,
                                             const std::function<bool(std::uint64_t, std::uint64_t)>& progress,
                                             std::uint64_t memory = Store::usual_memory);

}  // namespace roam::store
