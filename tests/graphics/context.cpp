// Where is drawn to: EGL, Xvfb, a window, and what is said when there is none.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <thread>

#include "environment_variable.h"
#include "graphics/xvfb.h"
#include "graphics_stage.h"
#include "process/child.h"
#include "process/find_program.h"

// Last: their macros take names that others use.
#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <X11/Xlib.h>
#include <X11/Xutil.h>

namespace roam::test {
namespace {

using graphics::Headless;

/// What the call complains of; empty when it does not.
std::string complaint_of(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& e) {
    return e.what();
  }
  return {};
}

void expect_holds(const std::string& text, std::initializer_list<const char*> words) {
  for (const char* word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " is missing in: " << text;
}

/// Whether the process runs; one that has ended and waits to be collected does not.
bool runs(pid_t pid) {
  std::ifstream stat("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  if (!std::getline(stat, line)) return false;
  const std::size_t end = line.rfind(')');
  return line.size() > end + 2 && line[end + 2] != 'Z';
}

bool ends_soon(pid_t pid) {
  for (int i = 0; i < 1000 && runs(pid); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(10));
  return !runs(pid);
}

bool shows_a_red_wall(Stage& stage) {
  stage.add(paint(quad({0, 4, 0}, {9, 0, 0}, {0, 0, 9}), {1, 0, 0, 1}));
  const Pixel middle = at(*stage.picture(), stage.frame.width() / 2, stage.frame.height() / 2);
  return middle.r > 100 && middle.g < 40;
}

TEST(GraphicsContext, EglDrawsWithoutAScreen) {
  unsetenv("DISPLAY");
  Stage stage(320, 180, {}, Headless::egl);
  expect_holds(stage.context.describe(), {"EGL", "OpenGL"});
  EXPECT_TRUE(stage.context.headless);
  EXPECT_TRUE(shows_a_red_wall(stage));
}

TEST(GraphicsContext, XvfbDrawsWithoutAScreen) {
  unsetenv("DISPLAY");
  Stage stage(320, 180, {}, Headless::xvfb);
  expect_holds(stage.context.describe(), {"Xvfb :", "OpenGL"});
  EXPECT_TRUE(shows_a_red_wall(stage));
}

TEST(GraphicsContext, BothDrawTheSamePicture) {
  const auto draw = [](Headless how) {
    Stage stage(320, 180, {}, how);
    stage.add(quad({0, 4, 0}, {1, 0.2, 0.3}, {0, 0.1, 1}));
    return stage.picture();
  };
  EXPECT_EQ(differing(*draw(Headless::egl), *draw(Headless::xvfb)), 0);
}

TEST(GraphicsContext, WhatTheProcessorDrawsIsToldSo) {
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
  EXPECT_TRUE(graphics::open_headless(64, 64, Headless::xvfb).abilities.software);
  unsetenv("LIBGL_ALWAYS_SOFTWARE");
}

TEST(GraphicsContext, SeveralCanBeOpenAtOnceAndCloseInAnyOrder) {
  auto first = std::make_unique<Stage>(64, 64, graphics::FrameSettings{}, Headless::egl);
  auto second = std::make_unique<Stage>(64, 64, graphics::FrameSettings{}, Headless::egl);
  EXPECT_TRUE(shows_a_red_wall(*first));
  EXPECT_TRUE(shows_a_red_wall(*second));
  first.reset();
  EXPECT_TRUE(shows_a_red_wall(*second));
}

TEST(GraphicsContext, TheEnvironmentChoosesTheWay) {
  setenv("ROAM_HEADLESS", "xvfb", 1);
  EXPECT_EQ(graphics::open_headless(64, 64).place.substr(0, 4), "Xvfb");
  setenv("ROAM_HEADLESS", "egl", 1);
  EXPECT_EQ(graphics::open_headless(64, 64).place.substr(0, 3), "EGL");
  setenv("ROAM_HEADLESS", "magic", 1);
  expect_holds(complaint_of([] { (void)graphics::open_headless(64, 64); }), {"ROAM_HEADLESS", "magic", "egl", "xvfb"});
  unsetenv("ROAM_HEADLESS");
}

/// The process that serves a display; 0: none. Another test may take the number of one that has ended.
pid_t server_of(const std::string& display) {
  sockaddr_un address{.sun_family = AF_UNIX, .sun_path = {}};
  ("/tmp/.X11-unix/X" + display).copy(address.sun_path, sizeof address.sun_path - 1);
  const int connection = socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
  ucred peer{};
  socklen_t size = sizeof peer;
  if (connect(connection, reinterpret_cast<const sockaddr*>(&address), sizeof address) != 0 ||
      getsockopt(connection, SOL_SOCKET, SO_PEERCRED, &peer, &size) != 0) {
    peer.pid = 0;
  }
  close(connection);
  return peer.pid;
}

TEST(GraphicsContext, XvfbEndsWithTheWindowAndLeavesNothing) {
  pid_t server = 0;
  std::string display;
  {
    const osg::ref_ptr<graphics::Xvfb> xvfb = new graphics::Xvfb(640, 480);
    server = xvfb->pid();
    display = std::to_string(xvfb->display());
    EXPECT_TRUE(runs(server));
    EXPECT_EQ(server_of(display), server);
  }
  EXPECT_FALSE(runs(server));
  EXPECT_NE(server_of(display), server);

  // And the one that open_headless starts.
  {
    const graphics::Context context = graphics::open_headless(64, 64, Headless::xvfb);
    display = context.place.substr(context.place.find(':') + 1);
    server = server_of(display);
    EXPECT_TRUE(runs(server));
  }
  EXPECT_NE(server_of(display), server);
}

TEST(GraphicsContext, XvfbEndsAlsoWhenTheProgramIsKilled) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t program = fork();
  if (program == 0) {
    const osg::ref_ptr<graphics::Xvfb> xvfb = new graphics::Xvfb(640, 480);
    const pid_t server = xvfb->pid();
    if (write(ends[1], &server, sizeof server) == sizeof server) raise(SIGKILL);
    _exit(1);
  }
  pid_t server = 0;
  ASSERT_EQ(read(ends[0], &server, sizeof server), static_cast<ssize_t>(sizeof server));
  close(ends[0]);
  close(ends[1]);
  int status = 0;
  ASSERT_EQ(waitpid(program, &status, 0), program);
  EXPECT_TRUE(WIFSIGNALED(status));
  EXPECT_TRUE(ends_soon(server));
}

TEST(GraphicsContext, XvfbRefusesThoseWithoutItsCookie) {
  const osg::ref_ptr<graphics::Xvfb> xvfb = new graphics::Xvfb(640, 480);
  const auto connects = [&](const std::string& authority) {
    const std::string command = "XAUTHORITY=" + authority + " xdotool getdisplaygeometry > /dev/null 2>&1";
    setenv("DISPLAY", std::string(":").append(std::to_string(xvfb->display())).c_str(), 1);
    const bool connected = std::system(command.c_str()) == 0;
    unsetenv("DISPLAY");
    return connected;
  };
  EXPECT_FALSE(connects("/nonexistent"));
  EXPECT_TRUE(connects(xvfb->authority()));
}

TEST(GraphicsContext, AWindowOpensOnTheDisplay) {
  const osg::ref_ptr<graphics::Xvfb> xvfb = new graphics::Xvfb(800, 600);
  xvfb->authorize();
  setenv("DISPLAY", std::string(":").append(std::to_string(xvfb->display())).c_str(), 1);
  {
    const graphics::Context context = graphics::open_window("a title", 400, 300);
    EXPECT_FALSE(context.headless);
    EXPECT_EQ(context.window->getWindowName(), "a title");
    EXPECT_EQ(context.width(), 400);
    osgViewer::Viewer viewer;
    graphics::Frame frame(viewer, context, {});
    osg::ref_ptr<osg::Image> taken;
    frame.request_picture(true, [&](osg::ref_ptr<osg::Image> image) { taken = image; });
    viewer.frame();
    ASSERT_TRUE(taken);
    EXPECT_EQ(taken->s(), 400);
    EXPECT_EQ(taken->t(), 300);
  }
  unsetenv("DISPLAY");
}

TEST(GraphicsContext, AWindowIsGreyUntilItsFirstFrame) {
  const osg::ref_ptr<graphics::Xvfb> xvfb = new graphics::Xvfb(800, 600);
  xvfb->authorize();
  const std::string name = std::string(":").append(std::to_string(xvfb->display()));
  setenv("DISPLAY", name.c_str(), 1);
  {
    const graphics::Context context = graphics::open_window("a title", 400, 300);
    const std::unique_ptr<Display, int (*)(Display*)> display(XOpenDisplay(name.c_str()), XCloseDisplay);
    ASSERT_TRUE(display);
    unsigned long pixel = 0;
    for (int i = 0; i < 100 && pixel == 0; ++i) {
      const std::unique_ptr<XImage, int (*)(XImage*)> image(
          XGetImage(display.get(), DefaultRootWindow(display.get()), 400, 300, 1, 1, AllPlanes, ZPixmap),
          [](XImage* one) { return XDestroyImage(one); });
      ASSERT_TRUE(image);
      pixel = XGetPixel(image.get(), 0, 0) & 0xFFFFFF;
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
    EXPECT_EQ(pixel, 0x737D87u);
  }
  unsetenv("DISPLAY");
}

TEST(GraphicsContext, WithoutADisplayItSaysWhatToDo) {
  unsetenv("DISPLAY");
  expect_holds(complaint_of([] { (void)graphics::open_window("", 64, 64); }), {"DISPLAY", "not set", "--headless"});
  setenv("DISPLAY", ":9987", 1);
  expect_holds(complaint_of([] { (void)graphics::open_window("", 64, 64); }), {":9987", "--headless"});
  unsetenv("DISPLAY");
}

TEST(GraphicsContext, ADisplayWithoutOpenGlIsToldSo) {
  const std::filesystem::path program = process::find_program("Xvfb");
  ASSERT_FALSE(program.empty());
  int ends[2];
  ASSERT_EQ(pipe2(ends, O_CLOEXEC), 0);
  process::Child server(program,
                        {"-displayfd", "3", "-screen", "0", "640x480x24", "-nolisten", "tcp", "-extension", "GLX"},
                        {.descriptors = {{ends[1], 3}}});
  char line[16] = {};
  ASSERT_GT(read(ends[0], line, sizeof line - 1), 0);
  setenv("DISPLAY", (std::string(":") + std::to_string(std::atoi(line))).c_str(), 1);
  expect_holds(complaint_of([] { (void)graphics::open_window("", 64, 64); }), {"GLX", "--headless"});
  unsetenv("DISPLAY");
  close(ends[0]);
  close(ends[1]);
}

TEST(GraphicsContext, RefusesSizesThatCannotBe) {
  for (const auto& [width, height] : {std::pair{0, 10}, std::pair{10, -1}, std::pair{20'000, 10}}) {
    expect_holds(complaint_of([&, w = width, h = height] { (void)graphics::open_headless(w, h); }), {"16384"});
    expect_holds(complaint_of([&, w = width, h = height] { (void)graphics::open_window("", w, h); }), {"16384"});
  }
}

// What a process has loaded of OpenGL stays, so these run in a process of their own each, which says its finding in
// its last words.
class GraphicsContextDeathTest : public testing::Test {
 protected:
  GraphicsContextDeathTest() { GTEST_FLAG_SET(death_test_style, "threadsafe"); }
  static void say(const std::string& words) {
    std::cerr << words << std::endl;
    std::_Exit(0);
  }
  static void say_complaint(Headless how) {
    say(complaint_of([&] { (void)graphics::open_headless(64, 64, how); }));
  }
  static void lose_egl() { setenv("__EGL_VENDOR_LIBRARY_FILENAMES", "/nowhere/egl.json", 1); }
  static void lose_programs() { setenv("PATH", "/nowhere", 1); }
};

TEST_F(GraphicsContextDeathTest, WithNeitherEglNorXvfbItSaysWhatToInstall) {
  const auto lose_both = [](Headless how) {
    lose_egl();
    lose_programs();
    say_complaint(how);
  };
  EXPECT_EXIT(lose_both(Headless::any), testing::ExitedWithCode(0),
              "EGL: .*Xvfb is not on the PATH.*libegl1 libgl1-mesa-dri.*apt-get install xvfb");
  EXPECT_EXIT(lose_both(Headless::egl), testing::ExitedWithCode(0), "EGL: .*libegl1 libgl1-mesa-dri");
  EXPECT_EXIT(lose_both(Headless::xvfb), testing::ExitedWithCode(0), "apt-get install xvfb");
}

TEST_F(GraphicsContextDeathTest, WithoutEglItTakesXvfb) {
  const auto open = [] {
    lose_egl();
    unsetenv("DISPLAY");
    std::string place;
    {
      Stage stage;
      place = stage.context.place + (shows_a_red_wall(stage) ? " draws" : " does not draw");
    }
    say(place);
  };
  EXPECT_EXIT(open(), testing::ExitedWithCode(0), "Xvfb :[0-9]+ draws");
}

TEST_F(GraphicsContextDeathTest, AnOpenGlThatIsTooOldIsToldSo) {
  const auto open = [](Headless how) {
    setenv("MESA_GL_VERSION_OVERRIDE", "1.4", 1);
    say_complaint(how);
  };
  EXPECT_EXIT(open(Headless::egl), testing::ExitedWithCode(0), "too old.*1\\.4.*2\\.1");
  EXPECT_EXIT(open(Headless::xvfb), testing::ExitedWithCode(0), "too old.*1\\.4.*2\\.1");
}

bool has_egl_devices() {
  const auto list = reinterpret_cast<PFNEGLQUERYDEVICESEXTPROC>(eglGetProcAddress("eglQueryDevicesEXT"));
  EGLint count = 0;
  return list != nullptr && list(0, nullptr, &count) == EGL_TRUE && count > 0;
}

TEST_F(GraphicsContextDeathTest, ADeviceOfNoUseDoesNotEndTheSearch) {
  // The version is that of Mesa's drivers.
  const EnvironmentVariable mesa("__EGL_VENDOR_LIBRARY_FILENAMES", "/usr/share/glvnd/egl_vendor.d/50_mesa.json");
  if (!has_egl_devices()) GTEST_SKIP() << "Mesa's EGL has no devices";
  const auto open = [] {
    setenv("MESA_GL_VERSION_OVERRIDE", "1.4", 1);
    say_complaint(Headless::egl);
  };
  EXPECT_EXIT(open(), testing::ExitedWithCode(0), "is of no use: .*too old.*; .* is of no use: .*too old.*libegl1");
}

TEST_F(GraphicsContextDeathTest, WithoutClipControlItDrawsWithAnOrdinaryDepth) {
  const auto open = [] {
    setenv("MESA_EXTENSION_OVERRIDE", "-GL_ARB_clip_control", 1);
    setenv("MESA_GL_VERSION_OVERRIDE", "3.0", 1);
    Stage stage;
    say(stage.frame.describe() + (shows_a_red_wall(stage) ? " draws" : " does not draw"));
  };
  EXPECT_EXIT(open(), testing::ExitedWithCode(0), "ordinary 24-bit depth.*lacks.*draws");
}

}  // namespace
}  // namespace roam::test
