#pragma once
/// \file
/// A manipulator in a real window, with xdotool as the person.

#include <chrono>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgGA/TrackballManipulator>
#include <osgViewer/Viewer>
#include <string>
#include <thread>

#include "graphics/xvfb.h"
#include "osgRoam/Manipulator.h"
#include "walker_judged.h"

namespace osg_window {

using namespace scenes;
using Adapter = osgGA::GUIEventAdapter;
using Seconds = std::chrono::duration<double>;

constexpr double quarter = 1.5707963267948966;
constexpr double patience = 20.0;  // seconds until something has to have happened

/// A display of our own, for all tests of this program.
inline void need_display() {
  static const osg::ref_ptr<roam::graphics::Xvfb> xvfb = new roam::graphics::Xvfb(1000, 700);
  setenv("DISPLAY", std::string(":").append(std::to_string(xvfb->display())).c_str(), 1);
  xvfb->authorize();
  setenv("XAUTHORITY", xvfb->authority().c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
}

inline void xdo(const std::string& what) {
  const std::string command = std::string("xdotool ").append(what).append(" > /dev/null 2>&1");
  ASSERT_EQ(std::system(command.c_str()), 0) << command;
}

/// When keys went down and up, and when frames were, by the clock of the events.
struct Watch : osgGA::GUIEventHandler {
  struct Moment {
    double time;
    int type, unmodified, key;
  };
  std::vector<Moment> moments;
  int width = 0;

  bool handle(const Adapter& event, osgGA::GUIActionAdapter&) override {
    moments.push_back({event.getTime(), event.getEventType(), event.getUnmodifiedKey(), event.getKey()});
    if (event.getEventType() == Adapter::RESIZE) width = event.getWindowWidth();
    return false;
  }
  [[nodiscard]] int count(int type, int unmodified) const {
    int n = 0;
    for (const Moment& m : moments) n += m.type == type && m.unmodified == unmodified;
    return n;
  }
  /// For how long a key was down, as the frames count it: each of them for a quarter of a second at most.
  [[nodiscard]] double seconds_down(int unmodified) const {
    double last_frame = 0.0, pressed = -1.0, counted = 0.0, since = 0.0;
    std::vector<std::pair<double, double>> stretches;
    for (const Moment& m : moments) {
      if (m.type == Adapter::KEYDOWN && m.unmodified == unmodified && pressed < 0.0) pressed = m.time;
      if (m.type == Adapter::KEYUP && m.unmodified == unmodified && pressed >= 0.0) {
        stretches.emplace_back(pressed, m.time);
        pressed = -1.0;
      }
      if (m.type != Adapter::FRAME) continue;
      since = std::max(last_frame, m.time - osgRoam::Manipulator::longest_frame);
      if (pressed >= 0.0) stretches.emplace_back(pressed, m.time);
      for (const auto& [from, to] : stretches) counted += std::max(0.0, to - std::max(from, since));
      stretches.clear();
      if (pressed >= 0.0) pressed = m.time;
      last_frame = m.time;
    }
    return counted;
  }
};

/// A viewer of 800 by 600 with a plain and our manipulator in it.
struct Window {
  osg::ref_ptr<osgRoam::Manipulator> manipulator = new osgRoam::Manipulator;
  osg::ref_ptr<Watch> watch = new Watch;
  osgViewer::Viewer viewer;
  std::string name;

  explicit Window(osgViewer::ViewerBase::ThreadingModel threads = osgViewer::ViewerBase::SingleThreaded,
                  osgGA::KeySwitchMatrixManipulator* set = nullptr) {
    need_display();
    static int number = 0;
    name = std::string("roam-test-").append(std::to_string(++number)).append("-");
    osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
    traits->readDISPLAY();
    traits->x = traits->y = 20;
    traits->width = 800;
    traits->height = 600;
    traits->doubleBuffer = true;
    traits->windowDecoration = false;
    traits->windowName = name;
    const osg::ref_ptr<osg::GraphicsContext> context = osg::GraphicsContext::createGraphicsContext(traits);
    if (!context) throw roam::Error("no window");
    viewer.getCamera()->setGraphicsContext(context);
    viewer.getCamera()->setViewport(0, 0, 800, 600);
    viewer.getCamera()->setProjectionMatrixAsPerspective(60.0, 800.0 / 600.0, 0.1, 1000.0);
    viewer.setThreadingModel(threads);

    Mesh plain;
    add_floor(plain, -500.0, -500.0, 500.0, 500.0, 0.0);
    manipulator->setMode(roam::Mode::walk);
    manipulator->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
    manipulator->setSpace(std::make_shared<const roam::World>(build(plain)));
    manipulator->setHomePose(manipulator->eye(), 0.0, 0.0);
    osg::ref_ptr<osg::Node> drawn =
        new osg::ShapeDrawable(new osg::Box(osg::Vec3(0.0f, 0.0f, -1.0f), 40.0f, 40.0f, 2.0f));
    viewer.setSceneData(drawn);
    viewer.addEventHandler(watch);
    if (set) {
      set->addMatrixManipulator('1', "Roam", manipulator);
      set->addMatrixManipulator('2', "Trackball", new osgGA::TrackballManipulator);
      set->selectMatrixManipulator(0);
      set->setHomePosition({0.0, 0.0, 1.6}, {1.0, 0.0, 1.6}, {0.0, 0.0, 1.0});
    }
    viewer.setCameraManipulator(set ? static_cast<osgGA::CameraManipulator*>(set) : manipulator.get());
    viewer.realize();
    run(0.2);
    xdo("mousemove 420 320");
    focus();
    run(0.2);
  }
  ~Window() { viewer.setDone(true); }

  void focus() { xdo("search --sync --name " + name + " windowfocus --sync"); }
  void run(double seconds) {
    const auto end = std::chrono::steady_clock::now() + Seconds(seconds);
    while (std::chrono::steady_clock::now() < end && !viewer.done()) {
      viewer.frame();
      std::this_thread::sleep_for(Seconds(0.005));
    }
  }
  /// Runs until something is so.
  template <class Condition>
  [[nodiscard]] bool until(const Condition& condition) {
    const auto end = std::chrono::steady_clock::now() + Seconds(patience);
    while (std::chrono::steady_clock::now() < end && !viewer.done()) {
      if (condition()) return true;
      run(0.02);
    }
    return condition();
  }
  [[nodiscard]] Vec3 at() const { return manipulator->walker()->position(); }
};

}  // namespace osg_window
