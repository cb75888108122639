#pragma once
/// \file
/// Clicks and double clicks among the presses of a mouse button.

#include <cmath>
#include <osgGA/GUIEventAdapter>

#include "osgroam/pointer.h"

namespace roam::app {

/// Points are of the picture, from -1 to 1.
class Presses {
 public:
  /// Takes a press. Whether it is the second of a double click, which OpenSceneGraph's X11 windows do not report.
  bool take(const osgGA::GUIEventAdapter& event, double x, double y) {
    const bool again = event.getEventType() == osgGA::GUIEventAdapter::DOUBLECLICK ||
                       (event.getButton() == button_ && is_near(event, x, y));
    button_ = event.getButton();
    x_ = x;
    y_ = y;
    time_ = event.getTime();
    return again;
  }
  /// Whether an event is so soon after the last press, and so near to it, that it belongs to one click or double click.
  [[nodiscard]] bool is_near(const osgGA::GUIEventAdapter& event, double x, double y) const {
    return event.getTime() - time_ <= osgRoam::double_click_time && std::hypot(x - x_, y - y_) <= distance;
  }

 private:
  static constexpr double distance = 2.0 * osgRoam::double_click_distance;  // of half the picture

  int button_ = 0;
  double x_ = 0.0, y_ = 0.0;
  double time_ = -1e9;  ///< s
};

}  // namespace roam::app
