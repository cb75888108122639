#pragma once
/// \file
/// Limit of an automatic near plane, so that it does not cut the wall before the eye.

#include <osg/Camera>

namespace osgRoam {

/// The farthest near plane, metres, that cuts nothing at a distance of at least `distance` metres from the eye.
/// Infinite if the projection is not a perspective.
[[nodiscard]] double farthest_near_plane(const osg::Matrixd& projection, double distance);

/// Limits the near plane that the camera computes to farthest_near_plane() of `distance`, as long as the camera keeps
/// its present view. Call it after each change of the view; other changes of the view end the limit. Does nothing if
/// the camera computes no near plane, or if the caller's program has set its own clamp callback.
void limit_near_plane(osg::Camera& camera, double distance);

/// Removes the limit from the camera.
void leave_near_plane(osg::Camera& camera);

}  // namespace osgRoam
