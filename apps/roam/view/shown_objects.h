#pragma once
/// \file
/// Geometry of several objects, of which some are drawn.

#include <osg/Geometry>
#include <osg/Node>
#include <vector>

#include "import/display_part.h"
#include "view/scene_objects.h"

namespace roam::app {

/// Remembers the objects of a geometry's triangles, and draws only those that are not hidden. `runs`: of all triangles,
/// with numbers of SceneObjects. The geometry must have one primitive set of indices, and is not in use yet.
void keep_objects(osg::Geometry& geometry, std::vector<DisplayRun> runs, const SceneObjects::Flags& flags);

/// Draws only what is not hidden in all such geometries below `node`. Call it between two frames. Returns whether it
/// changed any.
bool show_objects(osg::Node& node, const SceneObjects::Flags& flags);

}  // namespace roam::app
