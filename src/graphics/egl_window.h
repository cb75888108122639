#pragma once
/// \file
/// A surface for OpenGL by EGL, without an X server.

#include "graphics/context.h"

namespace roam::graphics {

/// Opens a realized surface of `width` x `height` pixels on the first device whose OpenGL can be used. Its place is
/// "EGL, surfaceless" or "EGL, device 0". setWindowRectangle resizes it; it has no events. Throws roam::Error with all
/// that was tried and why each failed.
[[nodiscard]] Context open_egl(int width, int height);

}  // namespace roam::graphics
