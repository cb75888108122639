#include "graphics/context.h"

#include <algorithm>
#include <cstdlib>

#include "graphics/abilities.h"
#include "graphics/egl_window.h"
#include "graphics/x_window.h"
#include "graphics/xvfb.h"

namespace roam::graphics {
namespace {

/// Pixels. Every driver of the last fifteen years supports this size.
constexpr int largest_side = 16384;
/// Largest size to which a window on Xvfb can grow, unless opened larger.
constexpr int xvfb_width = 3840, xvfb_height = 2160;

void check_size(int width, int height) {
  if (width >= 1 && height >= 1 && width <= largest_side && height <= largest_side) return;
  throw Error("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
              " pixels cannot be drawn: each side must be in [1, " + std::to_string(largest_side) + "]");
}

Headless wished(Headless how) {
  const char* value = std::getenv("ROAM_HEADLESS");
  if (how != Headless::any || !value || !*value) return how;
  const std::string word = value;
  if (word == "egl") return Headless::egl;
  if (word == "xvfb") return Headless::xvfb;
  throw Error("the environment variable ROAM_HEADLESS is \"" + word + "\": it may be egl or xvfb, or not be set");
}

Context on_xvfb(int width, int height) {
  Context context;
  context.headless = true;
  osg::ref_ptr<Xvfb> server = new Xvfb(std::max(width, xvfb_width), std::max(height, xvfb_height));
  server->authorize();
  const std::string display = std::string(":").append(std::to_string(server->display()));
  context.window = open_x_window({display, "roam", width, height, false}, server);
  context.place = "Xvfb " + display;
  context.abilities = ask_abilities(*context.window);
  return context;
}

constexpr const char* egl_remedy = "Install Mesa's EGL (Debian: apt-get install libegl1 libgl1-mesa-dri)";
constexpr const char* xvfb_remedy = "Install Xvfb (Debian: apt-get install xvfb libgl1-mesa-dri)";

}  // namespace

int Context::width() const { return window->getTraits()->width; }
int Context::height() const { return window->getTraits()->height; }
std::string Context::describe() const { return place + ", " + abilities.renderer + ", OpenGL " + abilities.version; }

Context open_window(const std::string& title, int width, int height) {
  check_size(width, height);
  const char* display = std::getenv("DISPLAY");
  if (!display || !*display) {
    throw Error(
        "there is no display to open a window on: the environment variable DISPLAY is not set. Start roam in a desktop "
        "session, or draw without a screen by --headless");
  }
  try {
    Context context;
    context.window = open_x_window({display, title, width, height, true}, nullptr);
    context.place = std::string("window on display ") + display;
    context.abilities = ask_abilities(*context.window);
    return context;
  } catch (const Error& e) {
    throw Error::at(e.where(), std::string(e.what()) + ". Without a screen, roam draws by --headless");
  }
}

Context open_headless(int width, int height, Headless how) {
  check_size(width, height);
  how = wished(how);
  std::string tried;
  if (how != Headless::xvfb) {
    try {
      return open_egl(width, height);
    } catch (const Error& e) {
      tried = std::string("EGL: ") + e.what() + ". ";
      if (how == Headless::egl) throw Error("cannot draw without a screen. " + tried + egl_remedy);
    }
  }
  try {
    return on_xvfb(width, height);
  } catch (const Error& e) {
    tried += std::string("Xvfb: ") + e.what() + ". ";
  }
  if (how == Headless::xvfb) throw Error("cannot draw without a screen. " + tried + xvfb_remedy);
  throw Error("cannot draw without a screen. " + tried + egl_remedy + ", or Xvfb (apt-get install xvfb)");
}

}  // namespace roam::graphics
