#pragma once
/// \file
/// The triangles of one OpenSceneGraph drawable, in the order and with the precision of its arrays.

#include <osg/Geometry>
#include <osg/Matrixd>

#include "import/reader/display/osg_looks.h"
#include "import/reader/mesh_sink.h"

namespace roam::reader {

/// Adds the triangles of `geometry` to the sink's current object, its vertices multiplied by `to_world`, with looks
/// unless `looks` is null. Vertices that only lines or points use are not added.
void add_geometry(const osg::Geometry& geometry, const osg::Matrixd& to_world, const OsgLooks* looks, MeshSink& sink);

}  // namespace roam::reader
