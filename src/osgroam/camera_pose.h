#pragma once
/// \file
/// Camera matrices and the angles they stand for. Right-handed, z up; see Manipulator.h for yaw and pitch.

#include <optional>
#include <osg/Matrixd>
#include <osg/Vec3d>

#include "osgroam/vectors.h"
#include "roam/math.h"

namespace osgRoam {

struct CameraPose {
  roam::Vec3 eye{0.0};
  double yaw = 0.0, pitch = 0.0;  ///< radians
};

/// Brings a yaw into [-pi, pi] and a pitch into [-pi/2, pi/2].
[[nodiscard]] double wrapped_yaw(double yaw);
[[nodiscard]] double limited_pitch(double pitch);

/// The unit vector that is looked along.
[[nodiscard]] roam::Vec3 forward(double yaw, double pitch);
/// The unit vector to the right, level.
[[nodiscard]] roam::Vec3 right(double yaw);

/// Camera to graph, where the graph is the scene minus `origin`.
[[nodiscard]] osg::Matrixd camera_matrix(const CameraPose& pose, const osg::Vec3d& origin);
/// The pose of a camera; roll and scale are dropped. None when the matrix is not that of a camera.
[[nodiscard]] std::optional<CameraPose> camera_pose(const osg::Matrixd& matrix, const osg::Vec3d& origin);
/// Where somebody looks who stands at `eye` and sees `center` in the middle.
[[nodiscard]] CameraPose looking_at(const roam::Vec3& eye, const roam::Vec3& center, const roam::Vec3& up);

/// The unit vector from the eye through a point of the picture, x and y in [-1, 1], right and up; none when the
/// projection is not a perspective. Depth, reversed or not, does not matter.
[[nodiscard]] std::optional<roam::Vec3> through_picture(const CameraPose& pose, const osg::Matrixd& projection,
                                                        double x, double y);

}  // namespace osgRoam
