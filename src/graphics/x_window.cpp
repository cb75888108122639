#include "graphics/x_window.h"

#include <X11/Xlib.h>
#include <X11/Xutil.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <memory>
#include <osgViewer/api/X11/GraphicsWindowX11>
#include <thread>

#include "roam/error.h"

namespace roam::graphics {
namespace {

/// OpenSceneGraph's X11 window, extended: it may be realized twice and keeps its server.
class XWindow : public osgViewer::GraphicsWindowX11 {
 public:
  XWindow(osg::GraphicsContext::Traits* traits, osg::ref_ptr<osg::Referenced> server)
      : osgViewer::GraphicsWindowX11(traits), server_(std::move(server)) {}

  /// Viewer::realize realizes every window again; the base class would warn about it.
  bool realizeImplementation() override { return _realized || osgViewer::GraphicsWindowX11::realizeImplementation(); }

  /// Learns of other layouts of the keyboard first: their letters would be missing.
  bool checkEvents() override {
    XEvent event;
    while (_eventDisplay != nullptr && XCheckTypedEvent(_eventDisplay, MappingNotify, &event) != 0) {
      XRefreshKeyboardMapping(&event.xmapping);
    }
    return osgViewer::GraphicsWindowX11::checkEvents();
  }

  /// Sets the class by which desktops group windows and find icons.
  void set_class() {
    XClassHint hint;
    hint.res_name = const_cast<char*>("roam");
    hint.res_class = const_cast<char*>("roam");
    XSetClassHint(_display, _window, &hint);
  }

  /// Makes the window grey until the first frame is drawn; it would be black.
  void paint_grey() {
    constexpr unsigned long grey = 0x737D87;  // as Frame's background; visuals for OpenGL have 8 bits a colour
    XSetWindowBackground(_display, _window, grey);
    XClearWindow(_display, _window);
    XFlush(_display);
  }

  /// Waits until the window manager shows the window, at most 2 s. By then it has given the window its size, which the
  /// next events tell. One on a hidden workspace is not shown.
  void wait_until_shown() {
    constexpr int most = 2000;  // ms
    XWindowAttributes found{};
    for (int i = 0; i < most; ++i) {
      if (XGetWindowAttributes(_eventDisplay, _window, &found) == 0 || found.map_state != IsUnmapped) return;
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    }
  }

 protected:
  /// Closes here: the server would end before the base class closes, and Xlib ends programs whose server has gone.
  ~XWindow() override { close(true); }

 private:
  osg::ref_ptr<osg::Referenced> server_;
};

/// Sets the host, display and screen from the display's name, for example screen 2 of ":1.2".
void name_display(osg::GraphicsContext::Traits& traits, const std::string& display) {
  const std::size_t colon = display.rfind(':');
  traits.hostName = display.substr(0, colon);
  traits.displayNum = 0;
  traits.screenNum = 0;
  if (colon == std::string::npos) return;
  const char* end = display.data() + display.size();
  const auto number = std::from_chars(display.data() + colon + 1, end, traits.displayNum);
  if (number.ptr != end && *number.ptr == '.') std::from_chars(number.ptr + 1, end, traits.screenNum);
}

struct Screen {
  /// Kept open until the window exists: an X server resets when its last client leaves, and accepts no client
  /// meanwhile.
  std::unique_ptr<Display, int (*)(Display*)> connection;
  int width = 0;
  int height = 0;
};

/// Tests the display before OpenSceneGraph does: its messages say less.
Screen look_at(const std::string& name) {
  std::unique_ptr<Display, int (*)(Display*)> connection(XOpenDisplay(name.c_str()), XCloseDisplay);
  Display* display = connection.get();
  if (!display) {
    throw Error("cannot open the display \"" + name + "\": no X server answers there, or it does not let this user in");
  }
  int unused = 0;
  if (XQueryExtension(display, "GLX", &unused, &unused, &unused) == 0) {
    throw Error("the display \"" + name +
                "\" has no OpenGL: its X server lacks the extension GLX. Start the server with GLX");
  }
  const int width = DisplayWidth(display, DefaultScreen(display));
  const int height = DisplayHeight(display, DefaultScreen(display));
  return {std::move(connection), width, height};
}

}  // namespace

osg::ref_ptr<osgViewer::GraphicsWindow> open_x_window(const XWindowWish& wish, osg::ref_ptr<osg::Referenced> server) {
  // Creating the system interface initialises Xlib's locks, which must happen before the first connection.
  if (!osg::GraphicsContext::getWindowingSystemInterface()) throw Error("OpenSceneGraph was built without X11");
  const Screen screen = look_at(wish.display);
  osg::ref_ptr<osg::GraphicsContext::Traits> traits = new osg::GraphicsContext::Traits;
  name_display(*traits, wish.display);
  traits->windowName = wish.title;
  traits->width = wish.width;
  traits->height = wish.height;
  traits->x = wish.decorated ? std::max(0, (screen.width - wish.width) / 2) : 0;
  traits->y = wish.decorated ? std::max(0, (screen.height - wish.height) / 2) : 0;
  traits->windowDecoration = wish.decorated;
  traits->doubleBuffer = true;
  traits->depth = 0;  // Frame draws to buffers of its own
  osg::ref_ptr<XWindow> window = new XWindow(traits, std::move(server));
  if (!window->valid() || !window->realize()) {
    throw Error("the display \"" + wish.display +
                "\" gives no window with OpenGL. Install the driver of the graphics " +
                "card, or Mesa's (Debian: libgl1-mesa-dri)");
  }
  window->set_class();
  window->paint_grey();
  window->wait_until_shown();
  return window;
}

}  // namespace roam::graphics
