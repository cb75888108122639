#pragma once
/// \file
/// Path after path: what reading meshes and reading parts have in common.

#include <filesystem>
#include <functional>
#include <span>
#include <vector>

#include "import/reading.h"
#include "roam/import.h"

namespace roam::reader {

/// Checks paths and options, calls `read` once for each path, and finishes the report. `read` answers whether the path
/// gave anything; where it did not, roam::Error says so. Throws what import_scene throws.
void read_all(std::span<const std::filesystem::path> paths, const ImportOptions& options, ImportReport& report,
              const std::function<bool(Reading& reading, std::vector<bool>& matched)>& read);

}  // namespace roam::reader
