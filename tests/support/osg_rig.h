#pragma once
/// \file
/// A manipulator without a window. osgGA's own queue makes the events, which are passed on as a viewer would do.

#include <osg/Camera>
#include <osgGA/EventQueue>

#include "osgRoam/Manipulator.h"
#include "walker_judged.h"

namespace rig {

using Adapter = osgGA::GUIEventAdapter;

/// Records the requests to a viewer.
struct Viewer : osgGA::GUIActionAdapter {
  void requestRedraw() override { ++redraws; }
  void requestContinuousUpdate(bool needed) override { continuous = needed; }
  void requestWarpPointer(float x, float y) override {
    ++warps;
    warp_x = x;
    warp_y = y;
  }
  int redraws = 0, warps = 0;
  float warp_x = 0.0f, warp_y = 0.0f;
  bool continuous = false;
};

struct Rig {
  osg::ref_ptr<osgRoam::Manipulator> manipulator = new osgRoam::Manipulator;
  osg::ref_ptr<osgGA::EventQueue> queue = new osgGA::EventQueue(Adapter::Y_INCREASING_DOWNWARDS);
  Viewer viewer;
  double time = 100.0;
  bool taken = false;  ///< result of handle() for the last event

  Rig() {
    queue->getCurrentEventState()->setWindowRectangle(0, 0, 800, 600);
    osg::ref_ptr<osg::Camera> camera = new osg::Camera;
    camera->setProjectionMatrixAsPerspective(60.0, 800.0 / 600.0, 0.1, 1000.0);
    manipulator->updateCamera(*camera);
    frame(0.0);
  }
  /// In a world of one mesh.
  Rig(const roam::Mesh& mesh, const roam::WalkerSettings& settings, roam::Mode mode) : Rig() {
    manipulator->setSettings(settings);
    manipulator->setMode(mode);
    manipulator->setSpace(std::make_shared<const roam::World>(scenes::build(mesh)));
  }

  osgRoam::Manipulator& operator*() const { return *manipulator; }
  osgRoam::Manipulator* operator->() const { return manipulator.get(); }

  /// Passes the queued events on.
  void deliver(osgGA::GUIActionAdapter& to, osgGA::CameraManipulator& receiver) {
    osgGA::EventQueue::Events events;
    queue->takeEvents(events);
    for (const auto& event : events) {
      if (const Adapter* adapter = event->asGUIEventAdapter()) taken = receiver.handle(*adapter, to);
    }
  }
  void deliver() { deliver(viewer, *manipulator); }

  void frame(double seconds) {
    time += seconds;
    queue->frame(time);
    deliver();
  }
  void frames(double seconds, double each = scenes::frame) {
    for (const double end = time + seconds - 1e-9; time < end;) frame(std::min(each, end + 1e-9 - time));
  }
  void down(int key) { down(key, key); }
  void down(int key, int unmodified) {
    queue->keyPress(key, time, unmodified);
    deliver();
  }
  void up(int key) { up(key, key); }
  void up(int key, int unmodified) {
    queue->keyRelease(key, time, unmodified);
    deliver();
  }
  void press(int key) {
    down(key);
    up(key);
  }
  void push(float x, float y) {
    queue->mouseButtonPress(x, y, 1, time);
    deliver();
  }
  void let_go(float x, float y) {
    queue->mouseButtonRelease(x, y, 1, time);
    deliver();
  }
  void mouse(float x, float y) {
    queue->mouseMotion(x, y, time);
    deliver();
  }
  void double_click(float x, float y) {
    queue->mouseDoubleButtonPress(x, y, 1, time);
    deliver();
    let_go(x, y);
  }
  void wheel(Adapter::ScrollingMotion motion) {
    queue->mouseScroll(motion, time);
    deliver();
  }
};

/// The eye of a camera and its viewing direction, in the graph's frame.
inline osg::Vec3d eye_of(const osg::Matrixd& camera) { return camera.getTrans(); }
inline osg::Vec3d look_of(const osg::Matrixd& camera) {
  return osg::Matrixd::transform3x3(osg::Vec3d(0.0, 0.0, -1.0), camera);
}
inline osg::Vec3d up_of(const osg::Matrixd& camera) {
  return osg::Matrixd::transform3x3(osg::Vec3d(0.0, 1.0, 0.0), camera);
}

}  // namespace rig
