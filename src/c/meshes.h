#pragma once
/// \file
/// The triangles of the caller, in memory or in a file.

#include <vector>

#include "c/progress.h"
#include "roam/import.h"
#include "roam/mesh.h"
#include "roam/roam.h"

namespace roam::c {

/// Copies meshes. Throws Invalid, and std::bad_alloc before the machine runs out of memory: `bytes_a_triangle` is
/// what the caller's index takes.
[[nodiscard]] std::vector<Mesh> copied(const roam_mesh* meshes, std::size_t count, std::size_t bytes_a_triangle);

/// Reads a scene file.
[[nodiscard]] std::vector<Mesh> imported(const char* path, const roam_world_options& options, Progress& progress);

}  // namespace roam::c
