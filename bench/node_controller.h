#pragma once
/// \file
/// The character controllers of npm's packages.

#include <string>

#include "float_mesh.h"
#include "paper_ways.h"

namespace roam::bench {

/// "physx" or "jolt" in a node process. Steps are timed there, around the controller's call. `modules`: the folder
/// whose node_modules hold the package. `shift` is added to all places. Throws roam::Error if the process ends.
[[nodiscard]] Mover node_controller(const FloatMesh& mesh, const std::string& engine, const std::string& modules,
                                    const Vec3& shift = Vec3(0.0));

}  // namespace roam::bench
