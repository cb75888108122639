#pragma once
/// \file
/// The plan of a roam::generate::Scene: a numbered list of parts that are made on demand.

#include <cstdint>
#include <functional>

#include "generate/surface.h"
#include "roam/generate.h"

namespace roam::generate {

struct Scene::Plan {
  std::uint64_t parts = 0;
  std::function<Part(std::uint64_t)> part = {};  ///< pure: any thread may call it, in any order
  Box bounds = {};
  Count made = {};  ///< set by make_scene
};

/// Counts the triangles, vertices and objects of a plan's parts.
[[nodiscard]] Count count(const Scene::Plan& plan);

[[nodiscard]] Scene make_scene(Scene::Plan plan);

/// Throws roam::Error if an option that all scenes share is out of range.
void check_options(const char* what, std::uint64_t triangles, const Vec3& origin);

}  // namespace roam::generate
