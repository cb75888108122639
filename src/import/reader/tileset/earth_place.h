#pragma once
/// \file
/// The frame in which a tileset is read: its own, or a local one on the Earth.

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>
#include <vector>

#include "import/reader/json.h"
#include "import/reader/mesh_sink.h"
#include "roam/import.h"

namespace roam::reader {

struct EarthPlace {
  glm::dmat4 to_scene{1.0};                  ///< from the frame of the tileset
  std::optional<Georeference> georeference;  ///< of a tileset that is the first to have one
  std::vector<std::string> notes;            ///< sentences for the user
};

/// A tileset has Earth-centred coordinates (EPSG:4978) if the bounding volume of its `root` is a region, or lies near
/// the surface of the Earth. It is then moved to the local frame of the scene before, or to one of its own, unless the
/// user chose an up axis. Its own stands in the middle of the root, or of the first tile below if the root is far too
/// wide. `transform`: of the root. Throws roam::Error if the scene before is in another reference
/// system.
[[nodiscard]] EarthPlace place_on_earth(const Json& root, const glm::dmat4& transform, const std::string& tileset,
                                        const ReadingSettings& settings);

}  // namespace roam::reader
