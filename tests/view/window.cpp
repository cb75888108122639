// roam view in a real window, with xdotool as the person.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <set>
#include <sstream>
#include <thread>

#include "graphics/context.h"
#include "graphics/xvfb.h"
#include "view_scenes.h"

// Last: its macros take names that others use.
#include <X11/Xlib.h>

namespace {

constexpr double patience = 60.0;  // s, for what has to happen on a slow machine

/// A display of our own, for all tests of this program; or one that resets without clients, as between two windows.
void need_display(bool resets) {
  static const osg::ref_ptr<roam::graphics::Xvfb> xvfb = new roam::graphics::Xvfb(1000, 700);
  static osg::ref_ptr<roam::graphics::Xvfb> resetting;
  if (resets) resetting = new roam::graphics::Xvfb(1000, 700, true);
  const roam::graphics::Xvfb& display = resets ? *resetting : *xvfb;
  setenv("DISPLAY", std::string(":").append(std::to_string(display.display())).c_str(), 1);
  display.authorize();
  setenv("XAUTHORITY", display.authority().c_str(), 1);
  setenv("LIBGL_ALWAYS_SOFTWARE", "1", 1);
}

bool try_xdo(const std::string& what) {
  return std::system(std::string("xdotool ").append(what).append(" > /dev/null 2>&1").c_str()) == 0;
}

void xdo(const std::string& what) { ASSERT_TRUE(try_xdo(what)) << what; }

void wait(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

bool eventually(const std::function<bool()>& is_so) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(patience);
  while (std::chrono::steady_clock::now() < end) {
    if (is_so()) return true;
    wait(0.05);
  }
  return is_so();
}

/// The program, in its window, until somebody ends it.
class Window {
 public:
  explicit Window(const std::vector<std::string>& more, const std::string& reader = {}, bool wait_for_body = true,
                  bool resets = false) {
    need_display(resets);
    Display* const until_it_is_there = XOpenDisplay(nullptr);
    XInternAtom(until_it_is_there, "ROAM_TEST", False);  // which a server forgets when it resets
    use_no_settings(folder);
    unsetenv("ROAM_READER");
    if (!reader.empty()) {
      const std::string file = folder.write("reader", "#!/bin/sh\n" + reader);
      ::chmod(file.c_str(), 0755);
      setenv("ROAM_READER", file.c_str(), 1);
    }
    scene = folder.write("scene.obj", room_obj());
    std::vector<std::string> arguments{
        "-c", "cd \"$0\" && exec \"$@\"", folder.file(""), ROAM_PROGRAM, "view", scene, "--json"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    if (std::find(more.begin(), more.end(), "--size") == more.end()) {
      arguments.insert(arguments.end(), {"--size", "320x200"});
    }
    program_ = std::thread([this, arguments] {
      result = run_program("/bin/sh", arguments);
      ended_ = true;
    });
    EXPECT_TRUE(eventually([&] { return ended_ || try_xdo("search --name '^roam: '"); })) << "no window";
    XCloseDisplay(until_it_is_there);
    focus();
    if (!wait_for_body) return;
    // Bookmarks are only kept where there is a body.
    EXPECT_TRUE(eventually([&] {
      try_xdo("key b");
      wait(0.3);
      return ended_ || std::filesystem::exists(folder.file("config/roam/bookmarks.json"));
    })) << "no body";
  }
  ~Window() {
    if (!ended_) end();
    if (program_.joinable()) program_.join();
  }
  /// Moves the mouse to a place in the window, from its upper left corner.
  void point(int x, int y) {
    xdo("search --name '^roam: ' mousemove --window %1 " + std::to_string(x) + " " + std::to_string(y));
  }
  bool focus() { return try_xdo("search --name '^roam: ' windowfocus"); }

  /// Ends it by a key, and gives its report.
  nlohmann::json end(int status = 0) {
    eventually([&] {
      if (!ended_ && focus()) try_xdo("key F10");
      return ended_.load();
    });
    return report(status);
  }
  nlohmann::json report(int status = 0) {
    if (program_.joinable()) program_.join();
    EXPECT_EQ(result.status, status) << result.err;
    return nlohmann::json::parse(result.out, nullptr, false);
  }
  [[nodiscard]] bool ended() const { return ended_; }

  TestFolder folder;
  std::string scene;
  ProgramResult result;

 private:
  std::thread program_;
  std::atomic<bool> ended_ = false;
};

TEST(ViewWindow, WalksWhileAKeyIsDownAndNeverThroughTheWall) {
  Window w({"--at", "14,0,0.95,0", "--verify", "--trace", "way.csv"});
  xdo("keydown w");
  wait(2.0);
  xdo("keyup w");
  wait(1.0);
  xdo("keydown shift keydown w");
  wait(3.0);
  xdo("keyup w keyup shift");
  const nlohmann::json report = w.end();
  EXPECT_NEAR(report["end"]["position"][0], 19.7, 0.01);
  EXPECT_EQ(report["violations"], 0);
  EXPECT_GT(report["verified"]["pieces"], 50);
  EXPECT_GT(report["frames"], 10);
  // The trace tells the same: nothing of it is beyond the wall, and the last row is where the body is.
  std::istringstream rows(w.folder.read("way.csv"));
  std::string row, last;
  std::getline(rows, row);
  EXPECT_EQ(row, "step,t,x,y,z,radius,height,clearance,contacts,event,teleport");
  std::size_t count = 0;
  for (; std::getline(rows, row); ++count) {
    std::istringstream fields(row);
    std::string step, t, x;
    std::getline(fields, step, ',');
    std::getline(fields, t, ',');
    std::getline(fields, x, ',');
    EXPECT_LT(std::stod(x), 19.700001);
    last = x;
  }
  EXPECT_GT(count, 100u);
  EXPECT_NEAR(std::stod(last), report["end"]["position"][0], 1e-9);
}

TEST(ViewWindow, StopsWhenItLosesTheKeyboard) {
  Window w({"--at", "2,0,0.95,0"});
  const roam::graphics::Context other = roam::graphics::open_window("other", 100, 80);
  xdo("keydown w");
  wait(0.7);
  xdo("search --name '^other$' windowfocus");
  wait(3.0);  // 4.2 m, had it gone on
  xdo("keyup w");
  wait(0.5);
  const nlohmann::json report = w.end();
  EXPECT_GT(report["length_m"], 0.2);
  EXPECT_LT(report["length_m"], 3.5);
}

TEST(ViewWindow, ShowsAllOfItselfWhenItIsResized) {
  Window w({"--at", "2,0,0.95,0"});
  xdo("search --name '^roam: ' windowsize 500 400");
  wait(1.5);
  xdo("key p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-1.png")); }));
  const Shot picture(w.folder.file("roam-1.png"));
  EXPECT_EQ(picture.width(), 500);
  EXPECT_EQ(picture.height(), 400);
  EXPECT_GT(picture.colours(), 8u);
  const nlohmann::json report = w.end();
  EXPECT_EQ(report["written"][0], "./roam-1.png");
}

TEST(ViewWindow, SaysThatItsFilmEndsWhenItIsResized) {
  Window w({"--at", "2,0,0.95,0", "--record", "film.mp4"});
  xdo("search --name '^roam: ' windowsize 500 400");
  wait(1.0);
  const nlohmann::json report = w.end(1);
  EXPECT_TRUE(contains(all(report["notes"]), "the film film.mp4 ends after ")) << report["notes"];
  EXPECT_TRUE(contains(w.result.err, "the size of the window has changed")) << w.result.err;
  EXPECT_EQ(report["written"], nlohmann::json({"film.mp4"})) << "as far as it goes";
  EXPECT_GT(w.folder.read("film.mp4").size(), 1000u);
}

/// A window manager that gives every window its own size, whatever the window wishes. It takes its time.
class Manager {
 public:
  Manager(int width, int height) {
    need_display(false);
    // A window that has gone before it is resized: Xlib would end this program.
    before_ = XSetErrorHandler([](Display*, XErrorEvent*) { return 0; });
    Display* const display = XOpenDisplay(nullptr);
    XSelectInput(display, DefaultRootWindow(display), SubstructureRedirectMask);
    XSync(display, False);
    thread_ = std::thread([this, display, width, height] {
      while (!ended_) {
        serve(display, static_cast<unsigned>(width), static_cast<unsigned>(height));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
      }
      XCloseDisplay(display);
    });
  }
  ~Manager() {
    ended_ = true;
    thread_.join();
    XSetErrorHandler(before_);
  }

 private:
  static void serve(Display* display, unsigned width, unsigned height) {
    while (XPending(display) > 0) {
      XEvent event{};
      XNextEvent(display, &event);
      if (event.type == ConfigureRequest) XResizeWindow(display, event.xconfigurerequest.window, width, height);
      if (event.type != MapRequest) continue;
      wait(0.3);
      XResizeWindow(display, event.xmaprequest.window, width, height);
      XMapWindow(display, event.xmaprequest.window);
    }
  }

  XErrorHandler before_ = nullptr;
  std::atomic<bool> ended_ = false;
  std::thread thread_;
};

TEST(ViewWindow, FilmsInTheSizeThatTheWindowManagerGivesIt) {
  const Manager manager(400, 300);
  Window w({"--at", "2,0,0.95,0", "--record", "film.mp4", "--time", "1"}, {}, false);
  const nlohmann::json report = w.report();
  EXPECT_EQ(report["written"], nlohmann::json({"film.mp4"}));
  EXPECT_FALSE(contains(all(report["notes"]), "the film film.mp4 ends")) << report["notes"];
  const ProgramResult probe = run_program("/usr/bin/ffprobe", {"-v", "error", "-show_entries", "stream=width,height",
                                                               "-of", "csv=p=0", w.folder.file("film.mp4")});
  EXPECT_EQ(probe.out, "400,300\n") << probe.err;
}

TEST(ViewWindow, WritesItsScreenshotInTheSizeThatOneAskedFor) {
  const Manager manager(400, 300);
  Window w({"--at", "2,0,0.95,0", "--size", "900x600", "--screenshot", "shot.png"}, {}, false);
  w.report();
  const Shot picture(w.folder.file("shot.png"));
  EXPECT_EQ(picture.width(), 900);
  EXPECT_EQ(picture.height(), 600);
  EXPECT_GT(picture.colours(), 8u);
}

TEST(ViewWindow, WritesPicturesWithoutTheDisplayUnlessAsked) {
  Window w({"--at", "2,0,0.95,0"});
  xdo("key h key p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-1.png")); }));
  xdo("key ctrl+p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-2.png")); }));
  // The help's panel is dark, the room's walls are light.
  const auto is_dark = [](const osg::Vec4& c) { return c.r() + c.g() + c.b() < 0.6f; };
  EXPECT_FALSE(is_dark(Shot(w.folder.file("roam-1.png")).at(60, 120)));
  EXPECT_TRUE(is_dark(Shot(w.folder.file("roam-2.png")).at(60, 120)));
  w.end();
}

TEST(ViewWindow, WritesPicturesWithoutTheMarksOfTools) {
  Window w({"--at", "18,0,0.95,0"});
  const auto picture = [&](const std::string& keys, const char* name) {
    xdo(keys);
    EXPECT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file(name)); })) << name;
    wait(0.5);
    return Shot(w.folder.file(name)).at(160, 101);
  };
  const osg::Vec4 before = picture("key p", "roam-1.png");
  xdo("key t");
  xdo("search --name '^roam: ' mousemove --window %1 160 100 click 1");
  // The click may come late.
  int number = 1;
  const auto next = [&] { return "roam-" + std::to_string(++number) + ".png"; };
  bool is_marked = false;
  while (!is_marked && number < 12) is_marked = (picture("key ctrl+p", next().c_str()) - before).length() > 0.1f;
  ASSERT_TRUE(is_marked) << "the cross of the measured point";
  EXPECT_LT((picture("key p", next().c_str()) - before).length(), 0.02f);
  w.end();
}

TEST(ViewWindow, WritesPicturesLargerThanItself) {
  Window w({"--at", "2,0,0.95,0", "--picture-scale", "4"});
  xdo("key p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-1.png")); }));
  const Shot large(w.folder.file("roam-1.png"));
  EXPECT_EQ(large.width(), 1280);
  EXPECT_EQ(large.height(), 800);
  xdo("key ctrl+p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-2.png")); }));
  const Shot window(w.folder.file("roam-2.png"));
  EXPECT_EQ(window.width(), 320);
  EXPECT_LT((large.at(1200, 500) - window.at(300, 125)).length(), 0.1f);
  w.end();
}

TEST(ViewWindow, ShowsItsMenuByTheMouseAlone) {
  Window w({"--at", "2,0,0.95,0"});
  xdo("search --name '^roam: ' mousemove --window %1 25 160 click 1");
  wait(0.5);
  xdo("key ctrl+p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-1.png")); }));
  const osg::Vec4 c = Shot(w.folder.file("roam-1.png")).at(60, 120);
  EXPECT_LT(c.r() + c.g() + c.b(), 0.6f) << "the menu's panel is dark, the room's walls are light";
  w.end();
}

TEST(ViewWindow, SaysOnceWhatItLeavesOutWithoutAGraphicsCard) {
  const std::string note =
      "no graphics card: drawn plain, without shadows, gloss, ambient occlusion, lines and smoothing";
  const auto count = [&](const std::vector<std::string>& options) {
    Window window(options);
    const std::string notes = all(window.end().at("notes"));
    int found = 0;
    for (std::size_t at = notes.find(note); at != std::string::npos; at = notes.find(note, at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count({}), 1);
  EXPECT_EQ(count({"--quality", "plain"}), 0) << "as the person wants it";
}

TEST(ViewWindow, WritesEachPictureToAFileOfItsOwn) {
  Window w({"--at", "2,0,0.95,0"});
  xdo("key p key p");
  for (const char* name : {"roam-1.png", "roam-2.png"}) {
    ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file(name)); })) << name;
    EXPECT_EQ(Shot(w.folder.file(name)).width(), 320);
  }
  const nlohmann::json report = w.end();
  const std::set<std::string> written = report["written"];
  EXPECT_EQ(written, (std::set<std::string>{"./roam-1.png", "./roam-2.png"}));
}

TEST(ViewWindow, FillsTheScreenAndLeavesIt) {
  Window w({"--at", "2,0,0.95,0"});
  const auto size_after = [&](const char* key, const char* picture) {
    xdo(std::string("key ") + key);
    wait(1.5);
    xdo("key p");
    EXPECT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file(picture)); }));
    return Shot(w.folder.file(picture)).width();
  };
  EXPECT_EQ(size_after("f", "roam-1.png"), 1000);
  EXPECT_EQ(size_after("f", "roam-2.png"), 320);
  w.end();
}

TEST(ViewWindow, LooksWithTheGrabbedMouseUntilEscapeAndEndsWithTheNextTwo) {
  Window w({"--at", "2,0,0.95,0"});
  w.point(160, 100);
  wait(0.5);
  xdo("key m");
  wait(1.0);
  for (int i = 0; i < 8; ++i) {
    xdo("mousemove_relative -- -20 0");
    wait(0.2);
  }
  xdo("key Escape");
  wait(1.5);
  EXPECT_FALSE(w.ended());
  xdo("key Escape");
  wait(0.5);
  EXPECT_FALSE(w.ended());
  xdo("key Escape");
  EXPECT_TRUE(eventually([&] { return w.ended(); }));
  EXPECT_GT(w.report()["end"]["yaw"], 10.0);
}

TEST(ViewWindow, DragsLookAround) {
  Window w({"--at", "2,0,0.95,0"});
  w.point(100, 100);
  xdo("mousedown 1");
  wait(0.3);
  w.point(150, 100);
  wait(0.3);
  w.point(150, 150);
  wait(0.3);
  xdo("mouseup 1");
  const nlohmann::json report = w.end();
  EXPECT_NE(report["end"]["yaw"], 0.0);
  EXPECT_NE(report["end"]["pitch"], 0.0);
}

TEST(ViewWindow, DragsASideOfTheSectionsBox) {
  Window w({"--at", "2,0,0.95,0", "--section", "box 13.7 -6.3 -4.7, 26.3 6.3 7.9"});
  w.point(10, 190);
  wait(0.5);
  xdo("key ctrl+x");
  wait(1.0);
  // The box is about the wall, 18 m ahead; the point on its top is 6.3 m above the eye.
  w.point(160, 45);
  wait(0.5);
  xdo("mousedown 1");
  wait(0.3);
  w.point(160, 60);
  wait(0.3);
  w.point(160, 75);
  wait(0.3);
  xdo("mouseup 1");
  wait(0.5);
  const nlohmann::json report = w.end();
  ASSERT_TRUE(report["section_box"].is_object()) << report;
  EXPECT_NEAR(report["section_box"]["upper"][2], 4.5, 1.0);
  EXPECT_NEAR(report["section_box"]["lower"][2], -4.7, 0.3);
  EXPECT_EQ(report["end"]["yaw"], 0.0);
}

TEST(ViewWindow, ComesBackWithTheSceneTurned) {
  Window w({"--at", "2,0,0.95,0"}, {}, true, true);
  xdo("key p");
  ASSERT_TRUE(eventually([&] { return std::filesystem::exists(w.folder.file("roam-1.png")); }));
  xdo("key u");
  wait(2.0);
  Display* const display = XOpenDisplay(nullptr);
  EXPECT_NE(XInternAtom(display, "ROAM_TEST", True), None) << "between two windows the server lost its last client";
  XCloseDisplay(display);
  const nlohmann::json report = w.end();
  EXPECT_EQ(report["frame"]["up"], "y");
  EXPECT_EQ(report["written"], nlohmann::json({"./roam-1.png"})) << "by the first window";
}

TEST(ViewWindow, GoesToWhatIsDoubleClicked) {
  Window w({"--at", "2,0,0.95,0", "--verify"});
  w.point(160, 100);
  wait(0.5);
  xdo("click --repeat 2 --delay 80 1");
  wait(4.0);
  const nlohmann::json report = w.end();
  EXPECT_GT(report["end"]["position"][0], 5.0);
  EXPECT_EQ(report["violations"], 0);
}

TEST(ViewWindow, EscapeClosesTheHelpFirst) {
  Window w({"--at", "2,0,0.95,0"});
  xdo("key h");
  wait(0.7);
  xdo("key Escape");
  wait(1.5);
  EXPECT_FALSE(w.ended());
  xdo("key Escape");
  wait(0.5);
  EXPECT_FALSE(w.ended());
  xdo("key Escape");
  EXPECT_TRUE(eventually([&] { return w.ended(); }));
}

TEST(ViewWindow, ReplaysAPathInItsOwnTime) {
  const TestFolder folder;
  const std::string path = folder.write("p.path", "2 0 0.3\n6.2 0 0.3\n");
  const auto begin = std::chrono::steady_clock::now();
  Window w({"--path", path, "--verify"}, {}, false);
  const nlohmann::json report = w.report();
  EXPECT_GT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 3.0);  // 4.2 m at 1.4 m/s
  EXPECT_EQ(report["outcome"], "reached");
  EXPECT_EQ(report["violations"], 0);
}

/// As a window manager does when the cross is clicked.
void close_window() {
  Display* display = XOpenDisplay(nullptr);
  ASSERT_NE(display, nullptr);
  FILE* found = ::popen("xdotool search --name '^roam: '", "r");
  unsigned long window = 0;
  ASSERT_EQ(std::fscanf(found, "%lu", &window), 1);
  ::pclose(found);
  XEvent event{};
  event.xclient.type = ClientMessage;
  event.xclient.window = window;
  event.xclient.message_type = XInternAtom(display, "WM_PROTOCOLS", False);
  event.xclient.format = 32;
  event.xclient.data.l[0] = static_cast<long>(XInternAtom(display, "WM_DELETE_WINDOW", False));
  XSendEvent(display, window, False, NoEventMask, &event);
  XCloseDisplay(display);
}

TEST(ViewWindow, ClosedWhileLoadingEndsAtOnceAndLeavesNoReader) {
  Window w({}, "echo $$ >> \"$(dirname \"$0\")/pids\"\nexec sleep 100\n", false);
  EXPECT_TRUE(eventually([&] {
    const std::string pids = w.folder.read("pids");
    return std::count(pids.begin(), pids.end(), '\n') == 2;
  }));
  wait(1.0);
  const auto begin = std::chrono::steady_clock::now();
  close_window();
  EXPECT_TRUE(eventually([&] { return w.ended(); }));
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 2.0);
  const nlohmann::json report = w.report();
  EXPECT_EQ(report["roamed"], false);
  std::string hud;
  for (const auto& line : report["hud"]) hud += line.get<std::string>() + "\n";
  EXPECT_TRUE(contains(hud, "Loading the walls; then you can walk.")) << hud;
  EXPECT_TRUE(contains(hud, "H: help     W A S D: walk     drag: look")) << hud;
  std::istringstream pids(w.folder.read("pids"));
  for (pid_t pid = 0; pids >> pid;) EXPECT_NE(::kill(pid, 0), 0) << "a reader still runs";
}

TEST(ViewWindow, ClosedWhileRoamingEndsInGoodOrder) {
  Window w({"--trace", "way.csv"});
  close_window();
  EXPECT_TRUE(eventually([&] { return w.ended(); }));
  EXPECT_EQ(w.report()["roamed"], true);
  EXPECT_GT(w.folder.read("way.csv").size(), 100u);
}

}  // namespace
