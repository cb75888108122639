#include "view/body.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "view/commands.h"
#include "view/surroundings.h"

namespace roam::app {

osgRoam::Manipulator* make_roamer(const ViewPlan& plan, const ViewSettings& settings) {
  osg::ref_ptr<osgRoam::Manipulator> roamer = new osgRoam::Manipulator;
  set_up(roamer->controls(), settings);
  roamer->setSettings(plan.walker);
  roamer->setSpeed(plan.walker.speed);
  roamer->setLookSpeed(roamer->lookSpeed() * plan.sensitivity);
  roamer->setLookInverted(plan.invert_y);
  roamer->setEasing(plan.easing);
  return roamer.release();
}

Pose pose_of(const osgRoam::Manipulator& roamer) {
  return {roamer.walker()->position(), glm::degrees(roamer.yaw()), glm::degrees(roamer.pitch())};
}

Pose standing_pose_of(const osgRoam::Manipulator& roamer) {
  Pose pose = pose_of(roamer);
  pose.position = roamer.walker()->feet() + Vec3(0.0, 0.0, 0.5 * roamer.settings().height);
  return pose;
}

void go_to(osgRoam::Manipulator& roamer, const Pose& pose) {
  roamer.setFeet(pose.position - Vec3(0.0, 0.0, 0.5 * roamer.settings().height), glm::radians(pose.yaw),
                 glm::radians(pose.pitch));
}

Vec3 wish_of(const osgRoam::Manipulator& roamer) {
  const double yaw = roamer.yaw();
  const double pitch = roamer.mode() == Mode::walk ? 0.0 : roamer.pitch();
  const Vec3 ahead = gaze(yaw, pitch);
  const Vec3 right(std::sin(yaw), -std::cos(yaw), 0.0);
  const auto sign = [&](const char* plus, const char* minus, double axis) {
    return (roamer.down(plus) ? 1.0 : 0.0) - (roamer.down(minus) ? 1.0 : 0.0) + axis;
  };
  const osgRoam::Manipulator::Axes& axes = roamer.axes();
  Vec3 direction = sign("forward", "back", axes.forward) * ahead + sign("right", "left", axes.right) * right;
  if (roamer.mode() != Mode::walk) direction.z += sign("up", "down", axes.up);
  if (roamer.going()) direction = ahead;
  const double length = glm::length(direction);
  return length > 0.0 ? roamer.speed() / length * direction : Vec3(0.0);
}

}  // namespace roam::app
