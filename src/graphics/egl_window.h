#pragma once
/// \file
/// A window that is none: OpenGL by EGL, without an X server.

#include <osg/ref_ptr>
#include <osgViewer/GraphicsWindow>
#include <string>

namespace roam::graphics {

/// What EGL opened, and how: "EGL, surfaceless" or "EGL, device 0".
struct EglOpening {
  osg::ref_ptr<osgViewer::GraphicsWindow> window{};
  std::string place{};
};

/// Opens a realized place of `width` x `height` pixels, resizable by setWindowRectangle; it has no events. Throws
/// roam::Error with what was tried and how each failed.
[[nodiscard]] EglOpening open_egl(int width, int height);

}  // namespace roam::graphics
