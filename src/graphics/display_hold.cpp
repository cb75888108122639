#include "graphics/display_hold.h"

#include <X11/Xlib.h>

#include <osg/GraphicsContext>

namespace roam::graphics {

struct DisplayHold::Connection {
  Display* display = nullptr;
  ~Connection() {
    if (display != nullptr) XCloseDisplay(display);
  }
};

DisplayHold::DisplayHold() : connection_(std::make_unique<Connection>()) {
  // It initialises Xlib's locks, which must happen before the first connection.
  if (!osg::GraphicsContext::getWindowingSystemInterface()) return;
  connection_->display = XOpenDisplay(nullptr);
}

DisplayHold::~DisplayHold() = default;

}  // namespace roam::graphics
