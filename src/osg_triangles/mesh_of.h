#pragma once
/// \file
/// A geometry as a mesh that World::build takes.

#include <cstdint>
#include <osg/Geometry>
#include <osg/Matrixd>
#include <string>
#include <vector>

#include "roam/mesh.h"

namespace roam::osg_triangles {

/// The triangles of `geometry`, vertices multiplied by `to_world`, without a name. Triangles with a vertex that
/// World::build would refuse, or with an index beyond the vertices, are left out and added to `left_out`.
[[nodiscard]] Mesh mesh_of(const osg::Geometry& geometry, const osg::Matrixd& to_world, std::uint64_t& left_out);

/// Whether World::build takes this vertex.
[[nodiscard]] bool is_usable(const Vec3& vertex);

/// The innermost of `names`, outermost first, that is not empty.
[[nodiscard]] std::string innermost(const std::vector<std::string>& names);

}  // namespace roam::osg_triangles
