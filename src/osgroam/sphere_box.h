#pragma once
/// \file
/// Bounding spheres, which are floats, as boxes that hold what the sphere was made of.

#include <osg/BoundingSphere>
#include <osg/Matrixd>

#include "roam/math.h"

namespace osgRoam {

/// Of each coordinate, and of the radius: roundings of a bounding sphere, in floats, that eight nested transforms make
/// with four each.
inline constexpr double sphereRounding = 32.0 * 0x1p-24;

/// Whether a matrix leads anywhere.
[[nodiscard]] bool isFinite(const osg::Matrixd& matrix);

/// The box of a sphere brought into the frame that `matrix` leads to, as far as it lies within
/// roam::coordinate_limit. Empty for a sphere without a size, where it is nowhere within the limit, and where
/// sphere or matrix are not finite.
[[nodiscard]] roam::Box boxOf(const osg::BoundingSphere& sphere, const osg::Matrixd& matrix);

/// Throws roam::Error for a margin of bounding volumes that is negative or not finite.
void checkBoundsMargin(double margin);

}  // namespace osgRoam
