#pragma once
/// \file
/// The mouse's effect on the view: dragged with a button, or grabbed, which hides it and keeps it in the window.

#include <osg/observer_ptr>
#include <osgGA/GUIActionAdapter>
#include <osgGA/GUIEventAdapter>
#include <osgViewer/GraphicsWindow>
#include <osgViewer/ViewerBase>

namespace osgRoam {

class Controls;

/// The most seconds and heights of the window between the two clicks of a double click.
inline constexpr double double_click_time = 0.4, double_click_distance = 0.01;

/// The notches by which a SCROLL event turns the wheel, > 0 upwards; touchpads may give parts of one. 0: not at all.
[[nodiscard]] double notches_of(const osgGA::GUIEventAdapter& event);

class Pointer {
 public:
  /// Left and up, in heights of the window.
  struct Movement {
    double left = 0.0, up = 0.0;
  };

  ~Pointer();

  /// A button went down; the mouse drags from here on. Returns whether this was the second click of a double click,
  /// which OpenSceneGraph's X11 windows do not report.
  bool push(const osgGA::GUIEventAdapter& event);
  /// The last button went up.
  void let_go() { dragging_ = false; }
  /// The movement of the mouse that turns the view.
  [[nodiscard]] Movement move(const osgGA::GUIEventAdapter& event);

  void want_grab(bool on);
  [[nodiscard]] bool grab_wanted() const { return wanted_; }
  /// Call it once a frame. It hides and shows the pointer and returns it to the centre of the window. It also prevents
  /// the viewer from closing on the key that ends the grab; `release_down` is whether that key is down.
  void keep_grab(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer, const Controls& controls,
                 bool release_down);

 private:
  struct Place {
    double x = 0.0, y = 0.0;  ///< heights of the window, from its lower left corner
  };
  [[nodiscard]] static Place place(const osgGA::GUIEventAdapter& event);
  void start(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer, const Controls& controls);
  void show();
  void give_back_key();
  void warp(const osgGA::GUIEventAdapter& event, osgGA::GUIActionAdapter& viewer);

  Place last_;
  Place middle_;  ///< of the window in the last mouse event; frame events may have an older size
  Place clicked_;
  double click_time_ = 0.0;  ///< seconds
  bool clicked_once_ = false;
  bool dragging_ = false;
  bool wanted_ = false, grabbed_ = false;
  bool warped_ = false;  ///< events from before the warp may still arrive
  bool known_ = false;   ///< last_ is the position of the grabbed mouse
  osg::observer_ptr<osgViewer::GraphicsWindow> hidden_in_;
  osg::observer_ptr<osgViewer::ViewerBase> kept_open_;
  int closing_key_ = 0;  ///< of kept_open_
};

}  // namespace osgRoam
