#pragma once
/// \file
/// The places of an i3dm tile's instances.

#include <glm/mat4x4.hpp>
#include <string>
#include <vector>

#include "import/reader/tileset/feature_table.h"

namespace roam::reader {

/// The transform of each instance to the tile's frame. Throws roam::Error at `place` if the table is damaged.
[[nodiscard]] std::vector<glm::dmat4> instances_of(const FeatureTable& table, const std::string& place);

}  // namespace roam::reader
