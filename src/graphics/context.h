#pragma once
/// \file
/// A context of OpenGL: a window on the screen, or a surface without a screen.
///
///     roam::graphics::Context context = roam::graphics::open_window("roam", 1280, 720);
///     osgViewer::Viewer viewer;
///     roam::graphics::Frame frame(viewer, context, {});
///
/// An open Context is realized and checked: its OpenGL works and is recent enough.

#include <cstdint>
#include <osg/ref_ptr>
#include <osgViewer/GraphicsWindow>
#include <string>

#include "roam/error.h"

namespace roam::graphics {

/// The abilities of a context's OpenGL.
struct Abilities {
  std::string renderer{};       ///< the driver's name of itself
  std::string version{};        ///< the driver's text
  bool reversed_depth = false;  ///< glClipControl and 32-bit float depth buffers both work
  bool software = false;        ///< drawn by the processor; several samples a pixel make it two to three times slower
  int samples = 0;              ///< most samples a pixel of a framebuffer object; 0: no multisampling
};

/// A window or surface to draw to. Copies share it; it closes with the last one. Close it in the thread that opened it.
struct Context {
  /// Realized, and current in no thread.
  osg::ref_ptr<osgViewer::GraphicsWindow> window{};
  Abilities abilities{};
  std::string place{};  ///< "window on display :0", "EGL, surfaceless", "EGL, device 0" or "Xvfb :99"
  bool headless = false;

  [[nodiscard]] int width() const;   ///< present size, pixels
  [[nodiscard]] int height() const;  ///< present size, pixels
  /// One line: place, renderer and OpenGL version.
  [[nodiscard]] std::string describe() const;
};

/// Opens a window of `width` x `height` pixels, each in [1, 16384], decorated and resizable, on the display that the
/// environment variable DISPLAY names. The window manager places it. xdotool and window managers find it by `title`.
///
/// Throws roam::Error if there is no display (the message names `--headless`), if the display has no OpenGL (GLX), or
/// if its OpenGL is older than 2.1 with framebuffer objects.
[[nodiscard]] Context open_window(const std::string& title, int width, int height);

/// Method of drawing without a screen. any: EGL, else Xvfb.
enum class Headless : std::uint8_t { any, egl, xvfb };

/// Opens a surface without a screen, of `width` x `height` pixels, each in [1, 16384]. window->setWindowRectangle(0, 0,
/// w, h) resizes it; on Xvfb up to 3840 x 2160 or its first size, whichever is larger.
///
/// EGL is tried on hardware devices, surfaceless, and on software devices, in this order. Xvfb runs as a child process
/// and ends with the window, or with this process, even if that crashes. For `any`, the environment variable
/// ROAM_HEADLESS (egl, xvfb) chooses; other values are an error.
///
/// Throws roam::Error if nothing works. The message says what was tried, why each failed, and which packages to
/// install.
[[nodiscard]] Context open_headless(int width, int height, Headless how = Headless::any);

}  // namespace roam::graphics
