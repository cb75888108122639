#pragma once
/// \file
/// Which format a path is of.

#include <string>

#include "import/reader/mesh_sink.h"

namespace roam::reader {

/// Reads a file by its extension, or a folder of tiles, as far as the settings ask for it. Throws roam::Error for a
/// path that no reader knows.
void read_path(const std::string& path, MeshSink& sink, const ReadingSettings& settings);

}  // namespace roam::reader
