#pragma once
/// \file
/// Triangles of a scene graph for collision, and a world of them.
///
///     const roam::World world = osgRoam::buildWorld(*osgDB::readRefNodeFile("cow.osgt"));
///
/// These are the triangles, strips, fans, quads, quad strips and polygons of all geometries, in floats or doubles,
/// through transforms in doubles. In switches and sequences the visible child counts. Billboards, text, particles,
/// lights, points, lines, projections, cameras and transforms with a frame of their own (head-up displays, render to
/// texture) and nodes with node mask 0 are left out. A paged scene counts as far as it is loaded, in the finest loaded
/// level; no file is read.
///
/// The graph must not change meanwhile: with a database pager, call these from the viewer's update thread.

#include <osg/Node>
#include <osg/Vec3d>
#include <vector>

#include "roam/mesh.h"
#include "roam/world.h"

namespace osgRoam {

/// One mesh for each geometry with triangles, in the order of the graph. Vertices are in the frame of `node`'s parents
/// plus `origin` (metres). A mesh has the name of the innermost named node above it. Triangles with an index out of
/// range or a vertex that is not finite or beyond roam::coordinate_limit are left out.
std::vector<roam::Mesh> collectMeshes(osg::Node& node, const osg::Vec3d& origin = osg::Vec3d());

/// The world of collectMeshes. Throws as roam::World::build does.
roam::World buildWorld(osg::Node& node, const osg::Vec3d& origin = osg::Vec3d(),
                       const roam::BuildOptions& options = roam::BuildOptions());

}  // namespace osgRoam
