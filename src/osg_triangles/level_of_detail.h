#pragma once
/// \file
/// Which children of a level-of-detail node somebody sees who stands in front of it.

#include <osg/LOD>
#include <vector>

namespace roam::osg_triangles {

/// The children that are shown together at the finest level that has any child not in `absent` (ascending): nearest
/// for ranges of distance, largest for ranges of size on screen. Numbers of ranges, ascending; empty when none is left.
[[nodiscard]] std::vector<unsigned> finest_children(const osg::LOD& lod, const std::vector<unsigned>& absent);

/// The same, seen from farthest away.
[[nodiscard]] std::vector<unsigned> coarsest_children(const osg::LOD& lod, const std::vector<unsigned>& absent);

/// The children shown at the finest (or coarsest) level that is loaded: a level that is not whole would leave holes,
/// the next one stands in for all of it. Empty when no level is loaded.
[[nodiscard]] std::vector<unsigned> loaded_children(const osg::LOD& lod, bool finest);

/// Whether `lod` is the coarser continuation of another one among its parent's children: some modellers, and
/// OpenFlight, give each level a node of its own.
[[nodiscard]] bool continues_a_finer_sibling(const osg::LOD& lod, const osg::Group& parent);

}  // namespace roam::osg_triangles
