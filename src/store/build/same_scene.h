#pragma once
/// \file
/// Whether a store is of a scene as it is now.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "roam/import.h"
#include "roam/store.h"

namespace roam::store {

/// In what a store differs from the scene, for people ("mine.dae has changed since"); empty when it is of this very
/// scene, read in this way. A lossless store also does where none was asked for. Compares as build_store does, but
/// changes nothing: it reads only those files whose size or time of change is another than when the store was built
/// with the key. `tick` is called now and then, perhaps from several threads, and may throw. Throws roam::Error when
/// the scene or its files cannot be read.
[[nodiscard]] std::string difference(const Store& store, std::span<const std::filesystem::path> scene,
                                     const ImportOptions& import, bool lossless, const std::optional<StoreKey>& key,
                                     const std::function<void()>& tick);

}  // namespace roam::store
