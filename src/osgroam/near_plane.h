#pragma once
/// \file
/// The near plane of a camera that chooses it by itself: not so far out that it cuts the wall before the eye.

#include <osg/Camera>

namespace osgRoam {

/// The farthest near plane, metres, that cuts nothing which is at least `distance` metres from the eye; infinite where
/// the projection is no perspective.
[[nodiscard]] double farthest_near_plane(const osg::Matrixd& projection, double distance);

/// As long as the camera stays where it is now, the near plane that it computes is never farther out than
/// farthest_near_plane() of `distance`. Call it after each change of the view. Whoever moves the camera otherwise ends
/// it. A camera that computes no near plane, and one in which somebody else clamps the projection, is left alone.
void limit_near_plane(osg::Camera& camera, double distance);

/// Ends that, and leaves nothing of it in the camera.
void leave_near_plane(osg::Camera& camera);

}  // namespace osgRoam
