#pragma once
/// \file
/// Where OpenGL draws: a window on the screen, or no screen at all.
///
///     roam::graphics::Context context = roam::graphics::open_window("roam", 1280, 720);
///     osgViewer::Viewer viewer;
///     roam::graphics::Frame frame(viewer, context, {});
///
/// A Context that was opened is realized and has been looked at: OpenGL is there and young enough.

#include <cstdint>
#include <osg/ref_ptr>
#include <osgViewer/GraphicsWindow>
#include <string>

#include "roam/error.h"

namespace roam::graphics {

/// What the OpenGL of a context can do.
struct Abilities {
  std::string renderer{};       ///< as the driver names itself
  std::string version{};        ///< as the driver writes it
  bool reversed_depth = false;  ///< glClipControl and 32-bit float depth buffers, both tried
  bool software = false;        ///< drawn by the processor: several samples a pixel make it two to three times slower
  int samples = 0;              ///< the most samples a pixel of a framebuffer object can have; 0: no multisampling
};

/// A place to draw to. Copies share the window; it closes with the last. Close it in the thread that opened it.
struct Context {
  /// Realized, and current in no thread.
  osg::ref_ptr<osgViewer::GraphicsWindow> window{};
  Abilities abilities{};
  std::string place{};  ///< "window on display :0", "EGL, surfaceless", "EGL, device 0" or "Xvfb :99"
  bool headless = false;

  [[nodiscard]] int width() const;   ///< pixels, now
  [[nodiscard]] int height() const;  ///< pixels, now
  /// One line: where, which renderer, which OpenGL.
  [[nodiscard]] std::string describe() const;
};

/// Opens a window of `width` x `height` pixels, each in [1, 16384], decorated and resizable, on the display that the
/// environment variable DISPLAY names; an empty place is left to the window manager. It answers xdotool and window
/// managers by `title`.
///
/// Throws roam::Error when there is no display (says `--headless`), when the display has no OpenGL (GLX), or when its
/// OpenGL is older than 2.1 with framebuffer objects.
[[nodiscard]] Context open_window(const std::string& title, int width, int height);

/// How to draw without a screen. any: EGL, else Xvfb.
enum class Headless : std::uint8_t { any, egl, xvfb };

/// Opens a place to draw to without a screen, `width` x `height` pixels, each in [1, 16384]. It can be resized by
/// window->setWindowRectangle(0, 0, w, h); Xvfb's up to 3840 x 2160 or what it was opened with.
///
/// EGL is tried on hardware devices, surfaceless, and on software devices, in this order. Xvfb is started as a child
/// process and ends with the window, or with the calling thread, however that ends: call it from a thread that
/// outlives the window. For `any`, the environment variable ROAM_HEADLESS (egl, xvfb) chooses; other values of it are
/// an error.
///
/// Throws roam::Error when nothing works: it says what was tried, why each failed, and which packages to install.
[[nodiscard]] Context open_headless(int width, int height, Headless how = Headless::any);

}  // namespace roam::graphics
