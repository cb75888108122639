#pragma once
/// \file
/// What stands behind roam::generate::Scene: a numbered list of parts that are described when they are needed.

#include <cstdint>
#include <functional>

#include "generate/surface.h"
#include "roam/generate.h"

namespace roam::generate {

struct Scene::Plan {
  std::uint64_t parts = 0;
  std::function<Part(std::uint64_t)> part = {};  ///< pure: may be called from any thread, in any order
  Box bounds = {};
  // Filled by make_scene:
  std::uint64_t triangles = 0, vertices = 0, objects = 0;
};

/// Counts what the parts of a plan come to.
[[nodiscard]] Count count(const Scene::Plan& plan);

[[nodiscard]] Scene make_scene(Scene::Plan plan);

/// Throws roam::Error when what all scenes share is out of range.
void check_options(const char* what, std::uint64_t triangles, const Vec3& origin);

}  // namespace roam::generate
