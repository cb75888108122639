#pragma once
/// \file
/// Which children of a level-of-detail node somebody sees who comes nearer to it.

#include <osg/LOD>
#include <vector>

namespace roam::osg_triangles {

/// Numbers of children that are shown together, ascending.
using Level = std::vector<unsigned>;

/// The levels that a node goes through, finest first: nearest for ranges of distance, largest for ranges of size on
/// screen. A child may be of several levels.
[[nodiscard]] std::vector<Level> levels(const osg::LOD& lod);

/// The finest (or coarsest) level whose children are all loaded: a level that is not whole would leave holes. Empty
/// when there is none.
[[nodiscard]] Level loaded_level(const osg::LOD& lod, bool finest);

/// Whether `lod` is the coarser continuation of another one among its parent's children: some modellers, and
/// OpenFlight, give each level a node of its own.
[[nodiscard]] bool continues_a_finer_sibling(const osg::LOD& lod, const osg::Group& parent);

}  // namespace roam::osg_triangles
