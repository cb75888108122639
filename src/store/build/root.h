#pragma once
/// \file
/// The root of a store: CURRENT and the manifest that it names. Keeps a copy, and repairs the root if it is damaged.

#include <filesystem>
#include <optional>
#include <string>

#include "roam/store.h"
#include "store/build/work.h"
#include "store/manifest.h"

namespace roam::store {

/// Writes a copy of the manifest, as spare/<SHA-256>.json, if it is missing or damaged. Returns the hash.
std::string keep_spare(const Folder& store, const Manifest& manifest);

/// Result of mend_root.
struct RootMending {
  std::string wrong;    ///< "CURRENT: it is not there"; empty when all is well
  bool mended = false;  ///< if `wrong`: the root is repaired; else nothing changed, because no copy can be used
};

/// If CURRENT or the manifest cannot be used, puts the newest undamaged copy of a manifest in force again. With a key,
/// uses only copies that have a code of it. Reads within the memory of the build. The store must be locked. Throws
/// TooLarge for a copy that takes more, and roam::Error for a store of a newer format, for a CURRENT of another
/// program, and if a file cannot be read or written.
[[nodiscard]] RootMending mend_root(Work& work, const std::optional<StoreKey>& key);

}  // namespace roam::store
