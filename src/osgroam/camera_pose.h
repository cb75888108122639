#pragma once
/// \file
/// Conversion between camera matrices and angles. Right-handed, z up; see Manipulator.h for yaw and pitch.

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

/// Maps a yaw into [-pi, pi], and limits a pitch to [-pi/2, pi/2].
[[nodiscard]] double wrapped_yaw(double yaw);
[[nodiscard]] double limited_pitch(double pitch);

/// The unit vector of the view direction.
[[nodiscard]] roam::Vec3 forward(double yaw, double pitch);
/// The level unit vector to the right.
[[nodiscard]] roam::Vec3 right(double yaw);

/// The transform from the camera to the graph, which is the scene minus `origin`.
[[nodiscard]] osg::Matrixd camera_matrix(const CameraPose& pose, const osg::Vec3d& origin);
/// The pose of a camera without its roll and scale. Empty if the matrix is not that of a camera.
[[nodiscard]] std::optional<CameraPose> camera_pose(const osg::Matrixd& matrix, const osg::Vec3d& origin);
/// The pose of an eye at `eye` with `center` in the middle of its view.
[[nodiscard]] CameraPose looking_at(const roam::Vec3& eye, const roam::Vec3& center, const roam::Vec3& up);

/// The unit vector from the eye through a point of the picture; x and y in [-1, 1], right and up. Empty if the
/// projection is not a perspective. Works for ordinary and reversed depth.
[[nodiscard]] std::optional<roam::Vec3> through_picture(const CameraPose& pose, const osg::Matrixd& projection,
                                                        double x, double y);

}  // namespace osgRoam
