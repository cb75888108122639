#pragma once
/// \file
/// One path, one reader: from starting it to its last frame or its failure.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <vector>

#include "roam/import.h"

namespace roam::reader {

/// What is to be read and how.
struct Reading {
  std::filesystem::path program;  ///< roam-reader
  std::filesystem::path path;     ///< existing file or folder
  std::uint64_t path_bytes = 0;   ///< its size
  const ImportOptions* options = nullptr;
  std::uint64_t mesh_bytes = 0;  ///< most that its meshes may take
  /// Called about every tenth of a second with the bytes read and triangles received of this path.
  std::function<void(std::uint64_t, std::uint64_t)> report_progress;
};

/// Appends what the path holds to `scene`, and sets matched[i] where ignore pattern i matched. Throws roam::Error, and
/// whatever report_progress throws; the reader is gone either way.
void read_one(const Reading& reading, Scene& scene, std::vector<bool>& matched);

}  // namespace roam::reader
