#pragma once
/// \file
/// Properties of affine matrices for bounding volumes.

#include <osg/Matrixd>

namespace osgRoam {

/// The greatest factor by which the matrix lengthens a vector: the greatest singular value of its linear part, rounded
/// up.
double greatestStretch(const osg::Matrixd& matrix);

/// Whether `inverse` is the inverse of `matrix` to within 1e-11 of each coordinate.
bool isInverse(const osg::Matrixd& matrix, const osg::Matrixd& inverse);

/// The half sides of the box around a box with half sides `half`, transformed by the linear part of `matrix`.
osg::Vec3d turnedHalf(const osg::Vec3d& half, const osg::Matrixd& matrix);

}  // namespace osgRoam
