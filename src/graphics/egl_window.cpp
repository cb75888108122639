#include "graphics/egl_window.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>
#include <atomic>
#include <cstring>
#include <string>
#include <vector>

#include "graphics/abilities.h"
#include "roam/error.h"

namespace roam::graphics {
namespace {

/// A display that EGL may open.
struct Candidate {
  EGLDisplay display = EGL_NO_DISPLAY;
  std::string name;
};

bool has(const char* extensions, const char* name) {
  if (!extensions) return false;
  const std::string all = std::string(" ") + extensions + " ";
  return all.find(std::string(" ") + name + " ") != std::string::npos;
}

template <class Function>
Function function(const char* name) {
  return reinterpret_cast<Function>(eglGetProcAddress(name));
}

/// The displays in the order in which they are tried. Hardware is first, because surfaceless may use the processor even
/// if there is a graphics card.
std::vector<Candidate> candidates() {
  std::vector<Candidate> hardware, surfaceless, software;
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const auto open_display = function<PFNEGLGETPLATFORMDISPLAYEXTPROC>("eglGetPlatformDisplayEXT");
  if (!open_display) return {};
  if (has(extensions, "EGL_MESA_platform_surfaceless")) {
    surfaceless.push_back({open_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr), "surfaceless"});
  }
  const auto list = function<PFNEGLQUERYDEVICESEXTPROC>("eglQueryDevicesEXT");
  const auto ask = function<PFNEGLQUERYDEVICESTRINGEXTPROC>("eglQueryDeviceStringEXT");
  if (has(extensions, "EGL_EXT_platform_device") && list && ask) {
    std::array<EGLDeviceEXT, 16> devices;
    EGLint count = 0;
    if (!list(static_cast<EGLint>(devices.size()), devices.data(), &count)) count = 0;
    for (EGLint i = 0; i < count; ++i) {
      const EGLDeviceEXT device = devices[static_cast<std::size_t>(i)];
      const bool drawn_by_processor = has(ask(device, EGL_EXTENSIONS), "EGL_MESA_device_software");
      (drawn_by_processor ? software : hardware)
          .push_back({open_display(EGL_PLATFORM_DEVICE_EXT, device, nullptr), "device " + std::to_string(i)});
    }
  }
  std::vector<Candidate> all = std::move(hardware);
  all.insert(all.end(), surfaceless.begin(), surfaceless.end());
  all.insert(all.end(), software.begin(), software.end());
  return all;
}

/// An OpenGL context with a pbuffer of the requested size.
class EglWindow : public osgViewer::GraphicsWindow {
 public:
  EglWindow(EGLDisplay display, EGLConfig config, EGLContext context, int width, int height)
      : display_(display), config_(config), context_(context), width_(width), height_(height) {
    _traits = new osg::GraphicsContext::Traits;
    _traits->x = _traits->y = 0;
    _traits->width = width;
    _traits->height = height;
    _traits->doubleBuffer = false;
    _traits->pbuffer = true;
    setState(new osg::State);
    getState()->setGraphicsContext(this);
    getState()->setContextID(osg::GraphicsContext::createNewContextID());
    getEventQueue()->syncWindowRectangleWithGraphicsContext();
  }

  const char* libraryName() const override { return "roam"; }
  const char* className() const override { return "EglWindow"; }

  bool valid() const override { return context_ != EGL_NO_CONTEXT; }
  bool realizeImplementation() override { return valid(); }
  bool isRealizedImplementation() const override { return valid(); }

  void closeImplementation() override {
    if (!valid()) return;
    releaseContextImplementation();
    if (surface_ != EGL_NO_SURFACE) eglDestroySurface(display_, surface_);
    eglDestroyContext(display_, context_);
    surface_ = EGL_NO_SURFACE;
    context_ = EGL_NO_CONTEXT;
    // The display stays open: EGL shares it between all windows, and closing it would break the others.
  }

  bool makeCurrentImplementation() override {
    eglBindAPI(EGL_OPENGL_API);  // a setting of each thread, which defaults to OpenGL ES
    const EGLint width = width_, height = height_;
    if (surface_ == EGL_NO_SURFACE || width != surface_width_ || height != surface_height_) {
      const EGLint size[] = {EGL_WIDTH, width, EGL_HEIGHT, height, EGL_NONE};
      const EGLSurface replacement = eglCreatePbufferSurface(display_, config_, size);
      if (replacement == EGL_NO_SURFACE) return false;
      const EGLSurface replaced = surface_;
      surface_ = replacement;
      surface_width_ = width;
      surface_height_ = height;
      const bool current = eglMakeCurrent(display_, surface_, surface_, context_) == EGL_TRUE;
      if (replaced != EGL_NO_SURFACE) eglDestroySurface(display_, replaced);
      return current;
    }
    return eglMakeCurrent(display_, surface_, surface_, context_) == EGL_TRUE;
  }
  bool makeContextCurrentImplementation(osg::GraphicsContext*) override { return makeCurrentImplementation(); }
  bool releaseContextImplementation() override {
    eglBindAPI(EGL_OPENGL_API);
    return eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT) == EGL_TRUE;
  }
  void swapBuffersImplementation() override { glFlush(); }

  /// The surface is resized when a thread next makes it current.
  bool setWindowRectangleImplementation(int, int, int width, int height) override {
    if (width < 1 || height < 1) return false;
    width_ = width;
    height_ = height;
    getEventQueue()->windowResize(0, 0, width, height);
    resized(0, 0, width, height);
    return true;
  }
  bool setWindowDecorationImplementation(bool) override { return false; }
  void grabFocus() override {}
  void grabFocusIfPointerInWindow() override {}
  void raiseWindow() override {}
  void setWindowName(const std::string& name) override { _traits->windowName = name; }
  void setCursor(MouseCursor) override {}
  void setSyncToVBlank(bool) override {}

 protected:
  ~EglWindow() override { close(true); }

 private:
  EGLDisplay display_;
  EGLConfig config_;
  EGLContext context_;
  EGLSurface surface_ = EGL_NO_SURFACE;
  EGLint surface_width_ = 0, surface_height_ = 0;
  std::atomic<int> width_, height_;  // requested size; one thread sets it, and the drawing thread applies it
};

std::string failure(const char* what) {
  switch (const EGLint code = eglGetError()) {
    case EGL_NOT_INITIALIZED:
      return std::string(what) + ": no driver";
    case EGL_BAD_ALLOC:
      return std::string(what) + ": out of memory";
    default: {
      char digits[16];
      std::snprintf(digits, sizeof digits, "0x%04x", static_cast<unsigned>(code));
      return std::string(what) + ": EGL error " + digits;
    }
  }
}

/// Opens a window on the display. Returns null, with the reason in `why`, if that fails.
osg::ref_ptr<EglWindow> open_on(EGLDisplay display, int width, int height, std::string& why) {
  if (display == EGL_NO_DISPLAY || !eglInitialize(display, nullptr, nullptr)) {
    why = failure("cannot be initialized");
    return nullptr;
  }
  if (!eglBindAPI(EGL_OPENGL_API)) {
    why = failure("has no OpenGL");
    return nullptr;
  }
  // No depth and no samples, because Frame draws to buffers of its own.
  const EGLint wishes[] = {EGL_SURFACE_TYPE,
                           EGL_PBUFFER_BIT,
                           EGL_RENDERABLE_TYPE,
                           EGL_OPENGL_BIT,
                           EGL_RED_SIZE,
                           8,
                           EGL_GREEN_SIZE,
                           8,
                           EGL_BLUE_SIZE,
                           8,
                           EGL_NONE};
  EGLConfig config = nullptr;
  EGLint count = 0;
  if (!eglChooseConfig(display, wishes, &config, 1, &count) || count == 0) {
    why = failure("offers no pbuffer for OpenGL");
    return nullptr;
  }
  const EGLContext context = eglCreateContext(display, config, EGL_NO_CONTEXT, nullptr);
  if (context == EGL_NO_CONTEXT) {
    why = failure("makes no OpenGL context");
    return nullptr;
  }
  osg::ref_ptr<EglWindow> window = new EglWindow(display, config, context, width, height);
  if (!window->makeCurrent()) {
    why = failure("gives no pbuffer of this size");
    return nullptr;
  }
  window->releaseContext();
  return window;
}

}  // namespace

Context open_egl(int width, int height) {
  std::string tried;
  for (const Candidate& candidate : candidates()) {
    std::string why;
    try {
      if (const auto window = open_on(candidate.display, width, height, why)) {
        return {window, ask_abilities(*window), "EGL, " + candidate.name, true};
      }
    } catch (const Error& error) {
      why = std::string("is of no use: ") + error.what();
    }
    tried += (tried.empty() ? "" : "; ") + candidate.name + " " + why;
  }
  throw Error(tried.empty() ? "EGL has neither the surfaceless platform nor a device" : tried);
}

}  // namespace roam::graphics
