#pragma once
/// \file
/// The triangles that a benchmark runs on.

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "roam/mesh.h"

namespace roam::bench {

/// Which scene to make or load.
struct SceneChoice {
  std::string scene = "gallery";     ///< "gallery", "terrain", "city", or a file (a build with ROAM_TOOLS reads files)
  std::uint64_t triangles = 500000;  ///< about how many a made scene gets; a file keeps its own
  Vec3 origin{0.0};                  ///< metres: where the centre of the scene's box is moved
};

struct Scene {
  std::string name;  ///< for tables: kind or file name, and the number of triangles
  std::vector<Mesh> meshes;

  [[nodiscard]] std::uint64_t triangles() const;
};

/// Makes or loads the scene and moves it. Throws roam::Error where the file or the kind is unknown.
/// Asks `goes_on` now and then; when it says no, roam::Cancelled is thrown.
[[nodiscard]] Scene make_scene(const SceneChoice& choice, const std::function<bool()>& goes_on = {});

}  // namespace roam::bench
