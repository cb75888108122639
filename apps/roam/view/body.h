#pragma once
/// \file
/// The body of a manipulator: creation, pose, placement.

#include "osgRoam/Manipulator.h"
#include "view/options.h"
#include "view/pose.h"

namespace roam::app {

/// A manipulator without a space, with the viewer's commands. Throws roam::Error for invalid keys.
[[nodiscard]] osgRoam::Manipulator* make_roamer(const ViewPlan& plan, const ViewSettings& settings);

/// Position of the body and direction of its eye. Needs a walker.
[[nodiscard]] Pose pose_of(const osgRoam::Manipulator& roamer);
/// The same, with the centre of the standing body even if the body crouches. Options with positions use this centre.
[[nodiscard]] Pose standing_pose_of(const osgRoam::Manipulator& roamer);
/// Puts the standing body at `pose`, or at the nearest free position.
void go_to(osgRoam::Manipulator& roamer, const Pose& pose);
/// The velocity that the pressed keys stand for, in m/s. Its length is approximate.
[[nodiscard]] Vec3 wish_of(const osgRoam::Manipulator& roamer);

}  // namespace roam::app
