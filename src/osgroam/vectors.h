#pragma once
/// \file
/// Conversion between the points of OpenSceneGraph and roam. Both are doubles, so nothing is rounded.

#include <osg/Vec3d>

#include "roam/math.h"

namespace osgRoam {

[[nodiscard]] inline roam::Vec3 to_roam(const osg::Vec3d& v) { return {v.x(), v.y(), v.z()}; }
[[nodiscard]] inline osg::Vec3d to_osg(const roam::Vec3& v) { return {v.x, v.y, v.z}; }

}  // namespace osgRoam
