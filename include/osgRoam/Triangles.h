#pragma once
/// \file
/// The triangles of a scene graph, as collision sees them.
///
///     const roam::World world = osgRoam::buildWorld(*osgDB::readRefNodeFile("cow.osgt"));
///
/// Taken are the triangles, strips, fans, quads, quad strips and polygons of all geometries, indexed or not, with
/// vertices in floats or doubles. Transforms are multiplied in doubles. Of switches and sequences the visible child
/// counts. Left out is what has no surface in the scene's space: billboards, text, particles, lights, cameras with a
/// frame of their own (head-up displays, render to texture), points and lines; and nodes whose node mask is 0.
///
/// Nothing is read from files: of a paged scene what is loaded is taken. The graph must not change meanwhile; where a
/// database pager runs, call this from the thread that runs the viewer's update.

#include <osg/Node>
#include <osg/Vec3d>
#include <vector>

#include "roam/mesh.h"
#include "roam/world.h"

namespace osgRoam {

/// Which children of LOD and PagedLOD nodes count.
enum LevelOfDetail {
  FINEST_LEVEL,   ///< of what is loaded: nearest for ranges of distance, largest for ranges of size on screen
  COARSEST_LEVEL  ///< what is seen from farthest away: few triangles, and loaded in any paged scene
};

/// One mesh for each geometry that has triangles, in the order of the graph, with vertices in the frame of `node`'s
/// parents plus `origin` (metres): where the graph that is drawn is the scene minus an origin, pass that origin. A mesh
/// is called after the innermost node on the way to it that has a name. Triangles with a vertex that is not finite or
/// beyond roam::coordinate_limit, or with an index beyond the vertices, are left out.
std::vector<roam::Mesh> collectMeshes(osg::Node& node, const osg::Vec3d& origin = osg::Vec3d(),
                                      LevelOfDetail level = FINEST_LEVEL);

/// The world of collectMeshes. Throws what roam::World::build throws.
roam::World buildWorld(osg::Node& node, const osg::Vec3d& origin = osg::Vec3d(),
                       const roam::BuildOptions& options = roam::BuildOptions(), LevelOfDetail level = FINEST_LEVEL);

}  // namespace osgRoam
