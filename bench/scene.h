#pragma once
/// \file
/// The triangles of a benchmark.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "roam/mesh.h"

namespace roam::bench {

/// The scene to make or load.
struct SceneChoice {
  std::string scene = "gallery";     ///< "gallery", "terrain", "city", or a file (a build with ROAM_TOOLS reads files)
  std::uint64_t triangles = 500000;  ///< approximate number for a generated scene; ignored for a file
  Vec3 origin{0.0};                  ///< metres: the new centre of the scene's box
};

/// Whether a scene of this name is made, not read.
[[nodiscard]] bool is_made(const std::string& scene);

struct Scene {
  std::string name;  ///< for tables: kind or file name, and the number of triangles
  std::vector<Mesh> meshes;

  [[nodiscard]] std::uint64_t triangles() const;
};

/// Makes or loads the scene and moves it. Throws roam::Error if the file or the kind is unknown. Calls `goes_on` now
/// and then; if it returns false, throws roam::Cancelled.
[[nodiscard]] Scene make_scene(const SceneChoice& choice, const std::function<bool()>& goes_on = {});

}  // namespace roam::bench
