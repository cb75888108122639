#pragma once
/// \file
/// What bounding volumes need to know of an affine matrix.

#include <osg/Matrixd>

namespace osgRoam {

/// No length becomes longer than so many times: the greatest singular value of the linear part, rounded up.
double greatestStretch(const osg::Matrixd& matrix);

/// Whether `inverse` is the inverse of `matrix` to 1e-11 of each coordinate.
bool isInverse(const osg::Matrixd& matrix, const osg::Matrixd& inverse);

/// The half sides of the box around a box with half sides `half`, turned by the linear part of `matrix`.
osg::Vec3d turnedHalf(const osg::Vec3d& half, const osg::Matrixd& matrix);

}  // namespace osgRoam
