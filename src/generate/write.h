#pragma once
/// \file
/// Writing generated scenes.

#include "files/place.h"
#include "roam/generate.h"

namespace roam::generate {

/// write_scene() that replaces only files of this kind.
void write_scene(const Scene& scene, const std::filesystem::path& path, files::FileKind replaced,
                 const Progress& progress);

}  // namespace roam::generate
