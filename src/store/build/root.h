#pragma once
/// \file
/// The root of a store, CURRENT and the manifest that it names: kept once more, and mended where it is damaged.

#include <filesystem>
#include <string>

#include "store/manifest.h"

namespace roam::store {

/// Writes the manifest once more, as spare/<SHA-256>.json, where that is not there or damaged. Returns the hash.
std::string keep_spare(const Folder& store, const Manifest& manifest);

/// What mend_root found.
struct RootMending {
  std::string wrong;  ///< "CURRENT: it is not there"; empty when all is well
  bool mended =
      false;  ///< what was wrong is no more; else there is no whole copy of any manifest, and all is as it was
};

/// Where CURRENT or the manifest cannot be used, puts that manifest in force again of which there is a whole copy. The
/// store must be locked. Throws roam::Error for a store of a newer format, for a CURRENT that another program made, and
/// where a file cannot be read or written.
[[nodiscard]] RootMending mend_root(const Folder& store);

}  // namespace roam::store
