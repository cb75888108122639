#pragma once
/// \file
/// A window of an X display.

#include <osg/ref_ptr>
#include <osgViewer/GraphicsWindow>
#include <string>

namespace roam::graphics {

/// What window is wished.
struct XWindowWish {
  std::string display{};  ///< ":0"
  std::string title{};
  int width = 0;          ///< pixels
  int height = 0;         ///< pixels
  bool decorated = true;  ///< in the middle of the screen and with a frame; else bare at the upper left
};

/// Opens it, realized. `server`, if any, is kept until the window has been closed. Throws roam::Error when the display
/// cannot be opened or has no OpenGL.
[[nodiscard]] osg::ref_ptr<osgViewer::GraphicsWindow> open_x_window(const XWindowWish& wish,
                                                                    osg::ref_ptr<osg::Referenced> server);

}  // namespace roam::graphics
