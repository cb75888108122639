#pragma once
/// \file
/// Conversion of a geometry to a mesh for World::build.

#include <cstdint>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <string>
#include <vector>

#include "roam/mesh.h"

namespace roam::osg_triangles {

/// The triangles of `geometry`, its vertices multiplied by `to_world`, without a name. A triangle is left out, and
/// counted in `left_out`, if World::build would refuse one of its vertices or if an index is out of range.
[[nodiscard]] Mesh mesh_of(const osg::Geometry& geometry, const osg::Matrixd& to_world, std::uint64_t& left_out);

/// The innermost name that is not empty; `names` are outermost first.
[[nodiscard]] std::string innermost(const std::vector<std::string>& names);

}  // namespace roam::osg_triangles
