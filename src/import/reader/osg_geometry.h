#pragma once
/// \file
/// The triangles of one OpenSceneGraph drawable, in the order and with the precision of its arrays.

#include <osg/Drawable>
#include <osg/Matrixd>

#include "import/reader/mesh_sink.h"

namespace roam::reader {

/// Adds the triangles of `drawable`, its vertices multiplied by `to_world`, to the sink's current object. Vertices that
/// only lines or points use are not added.
void add_drawable(const osg::Drawable& drawable, const osg::Matrixd& to_world, MeshSink& sink);

}  // namespace roam::reader
