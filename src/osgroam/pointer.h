#pragma once
/// \file
/// What the mouse does to the eye: dragged with a button down, or grabbed, when it is hidden and kept in the window.

#include <osg/observer_ptr>
#include <osgGA/GUIActionAdapter>
#include <osgGA/GUIEventAdapter>
#include <osgViewer/GraphicsWindow>
#include <osgViewer/ViewerBase>

namespace osgRoam {

class Controls;

class Pointer {
 public:
  /// To the left and upwards, in heights of the window.
  struct Movement {
    double left = 0.0, up = 0.0;
  };

  ~Pointer();

  /// A button went down: the mouse drags from here on. Returns whether that was the second click of a double click,
  /// which OpenSceneGraph's X11 windows do not tell.
  bool push(const osgGA::GUIEventAdapter& event);
  /// The last button went up.
  void let_go() { dragging_ = false; }
  /// How far the mouse moved, as far as that looks.
  [[nodiscard]] Movement move(const osgGA::GUIEventAdapter& event);

  void want_grab(bool on);
  [[nodiscard]] bool grab_wanted() const { return wanted_; }
  /// Once a frame: hides and shows the pointer, brings it back to the centre of the window, and keeps the viewer from
  /// taking the key that leaves the grab, `release_down` telling whether it is down, for the key that closes it.
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
  Place middle_;  ///< of the window, as the last event of the mouse has it: those of frames may know an older size
  Place clicked_;
  double click_time_ = 0.0;  ///< seconds
  bool clicked_once_ = false;
  bool dragging_ = false;
  bool wanted_ = false, grabbed_ = false;
  bool warped_ = false;  ///< what the mouse did before it was warped may still be on its way
  bool known_ = false;   ///< last_ is where the grabbed mouse was
  osg::observer_ptr<osgViewer::GraphicsWindow> hidden_in_;
  osg::observer_ptr<osgViewer::ViewerBase> kept_open_;
  int closing_key_ = 0;  ///< of kept_open_
};

}  // namespace osgRoam
