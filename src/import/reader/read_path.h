#pragma once
/// \file
/// Which format a path is of.

#include <string>

#include "import/reader/mesh_sink.h"
#include "import/reader/scene_files.h"

namespace roam::reader {

/// Loads the libraries that reading the path may need, those of images where they are wanted. Nothing can be loaded
/// once the sandbox is entered.
void load_libraries(const std::string& path, bool images);

/// Reads a file by its extension, or a folder of tiles, as far as the settings ask for it. Throws roam::Error for a
/// path that no reader knows.
void read_path(const std::string& path, SceneFiles& files, MeshSink& sink, const ReadingSettings& settings);

}  // namespace roam::reader
