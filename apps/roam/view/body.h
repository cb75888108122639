#pragma once
/// \file
/// The body that a manipulator leads: where it is, and where it is to go.

#include "osgRoam/Manipulator.h"
#include "view/options.h"
#include "view/pose.h"

namespace roam::app {

/// A manipulator without a space, with the viewer's commands. Throws roam::Error for keys that cannot be.
[[nodiscard]] osgRoam::Manipulator* make_roamer(const ViewPlan& plan, const ViewSettings& settings);

/// Where the body is, and where the person looks. Needs a walker.
[[nodiscard]] Pose pose_of(const osgRoam::Manipulator& roamer);
/// The same with the centre of the standing body, also if it crouches: as the options of places mean it.
[[nodiscard]] Pose standing_pose_of(const osgRoam::Manipulator& roamer);
/// Puts the standing body there, or to the nearest free place.
void go_to(osgRoam::Manipulator& roamer, const Pose& pose);
/// The velocity that the keys ask for, m/s; its length is only roughly right.
[[nodiscard]] Vec3 wish_of(const osgRoam::Manipulator& roamer);

}  // namespace roam::app
