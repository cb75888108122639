#pragma once
/// \file
/// Compares a store with its scene.

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "roam/import.h"
#include "roam/store.h"

namespace roam::store {

/// The difference between a store and the scene, for people ("mine.dae has changed since"). Empty if the store was
/// built from this very scene with these options. A lossless store also matches if `lossless` is false. Compares as
/// build_store does, but changes nothing. Reads only files whose size or time of change differs from when the store was
/// built with the key. Calls `tick` now and then, perhaps from several threads; it may throw. Throws roam::Error if the
/// scene or its files cannot be read.
[[nodiscard]] std::string difference(const Store& store, std::span<const std::filesystem::path> scene,
                                     const ImportOptions& import, bool lossless, const std::optional<StoreKey>& key,
                                     const std::function<void()>& tick);

}  // namespace roam::store
