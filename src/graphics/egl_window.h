#pragma once
/// \file
/// A surface for OpenGL by EGL, without an X server.

#include <osg/ref_ptr>
#include <osgViewer/GraphicsWindow>
#include <string>

namespace roam::graphics {

/// A window of EGL, and its kind: "EGL, surfaceless" or "EGL, device 0".
struct EglOpening {
  osg::ref_ptr<osgViewer::GraphicsWindow> window{};
  std::string place{};
};

/// Opens a realized surface of `width` x `height` pixels. setWindowRectangle resizes it; it has no events. Throws
/// roam::Error with all that was tried and why each failed.
[[nodiscard]] EglOpening open_egl(int width, int height);

}  // namespace roam::graphics
