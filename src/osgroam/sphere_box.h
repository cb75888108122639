#pragma once
/// \file
/// Boxes that contain the contents of bounding spheres, which are rounded to floats.

#include <osg/BoundingSphere>
#include <osg/Matrixd>

#include "roam/math.h"

namespace osgRoam {

/// Rounding of a bounding sphere in floats, relative to each coordinate and to the radius: eight nested transforms with
/// four roundings each.
inline constexpr double sphereRounding = 32.0 * 0x1p-24;

/// Whether all elements of a matrix are finite.
[[nodiscard]] bool isFinite(const osg::Matrixd& matrix);

/// The box of a sphere in the frame that `matrix` leads to, clipped to roam::coordinate_limit. Empty if the sphere is
/// empty, lies beyond the limit, or if sphere or matrix are not finite.
[[nodiscard]] roam::Box boxOf(const osg::BoundingSphere& sphere, const osg::Matrixd& matrix);

/// Throws roam::Error for a margin of bounding volumes that is negative or not finite.
void checkBoundsMargin(double margin);

}  // namespace osgRoam
