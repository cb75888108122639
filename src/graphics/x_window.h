#pragma once
/// \file
/// A window on an X display.

#include <osg/ref_ptr>
#include <osgViewer/GraphicsWindow>
#include <string>

namespace roam::graphics {

/// The properties of a new window.
struct XWindowWish {
  std::string display{};  ///< ":0"
  std::string title{};
  int width = 0;          ///< pixels
  int height = 0;         ///< pixels
  bool decorated = true;  ///< in the middle of the screen and with a frame; else bare at the upper left
};

/// Opens a realized window. Keeps `server`, if any, until the window is closed. Throws roam::Error if the display
/// cannot be opened or has no OpenGL.
[[nodiscard]] osg::ref_ptr<osgViewer::GraphicsWindow> open_x_window(const XWindowWish& wish,
                                                                    osg::ref_ptr<osg::Referenced> server);

}  // namespace roam::graphics
