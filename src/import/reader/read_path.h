#pragma once
/// \file
/// Choice of the reader for a path.

#include <string>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Loads the libraries that reading the path may need, and those of images if `images`. The sandbox prevents loading
/// later.
void load_libraries(const std::string& path, bool images);

/// Reads a file by its extension, or a folder of tiles, as the settings request. Throws roam::Error for a path that no
/// reader knows.
void read_path(const std::string& path, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings);

}  // namespace roam::reader
