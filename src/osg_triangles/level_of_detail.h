#pragma once
/// \file
/// The children of a level-of-detail node that are shown from near by.

#include <osg/LOD>
#include <vector>

namespace roam::osg_triangles {

/// Indices of children that are shown together, ascending.
using Level = std::vector<unsigned>;

/// The levels of a node, finest first: nearest for ranges of distance, largest for ranges of size on screen. A child
/// may belong to several levels.
[[nodiscard]] std::vector<Level> levels(const osg::LOD& lod);

/// The finest level whose children are all loaded. An incomplete level would leave holes. Empty if there is none.
[[nodiscard]] Level loaded_level(const osg::LOD& lod);

/// Whether `coarser` is a coarser level of its sibling `finer`. Some modellers, and OpenFlight, give each level a node
/// of its own.
[[nodiscard]] bool continues(const osg::LOD& coarser, const osg::LOD& finer);

}  // namespace roam::osg_triangles
