// Hours of a person who presses everything, at high speed: nothing gives way and no memory grows.
//
// ROAM_SOAK_HOURS says how many hours are simulated (default: 0.1, 21,600 frames; the soak of a release is 8), and
// ROAM_SOAK_DRAWN how many minutes of that kind are drawn, small, frame by frame (default: 0.05).
//
// The keys are those of the window's own table of commands, so a new command is pressed by itself.
#include <gtest/gtest.h>
#include <malloc.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <optional>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "roam/generate.h"
#include "sanitizer.h"
#include "view/session.h"
#include "view_scenes.h"

#ifdef __SANITIZE_ADDRESS__
// The address sanitizer keeps freed memory back, 256 MB of it: that is no growth of ours. The rest is as in
// cmake/sanitizers.cpp.
extern "C" const char* __asan_default_options() {
  return "intercept_tls_get_addr=0:print_suppressions=0:quarantine_size_mb=1:thread_local_quarantine_size_kb=64";
}
#endif

namespace {

using namespace roam;
using namespace roam::app;

double number_from(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

/// Commands that have no key here.
constexpr const char* left_out[] = {
    "quit",     // ends the window
    "store",    // builds a store beside the scene, for hours
    "release",  // its key, Escape, is pressed apart: twice within 3 s it ends the window
};

/// Commands that read the scene anew.
constexpr const char* rereading[] = {"turn", "unit", "leave_out", "show_all"};

template <std::size_t n>
bool has(const char* const (&names)[n], const std::string& name) {
  return std::find(std::begin(names), std::end(names), name) != std::end(names);
}

ViewSettings settings_without_some_keys() {
  ViewSettings settings;
  for (const char* name : left_out) settings.keys[name] = {};
  return settings;
}

/// Presses keys, drags, clicks and scrolls at random, the same on every machine.
class Person {
 public:
  void act(Session& session) {
    events_ = session.stage().viewer().getEventQueue();
    ++frames_;
    // No key moves the body while another camera leads.
    if (session.roaming() && !session.roamer_leads() && random_() % 60 == 0) tap('1');
    switch (random_() % 40) {
      case 0:
      case 1:
      case 2:
      case 3: {
        // Going is what a person does most.
        static constexpr int keys[] = {'w',
                                       'w',
                                       'w',
                                       'a',
                                       's',
                                       'd',
                                       'q',
                                       'e',
                                       'c',
                                       osgGA::GUIEventAdapter::KEY_Shift_L,
                                       osgGA::GUIEventAdapter::KEY_Control_L};
        const int key = keys[random_() % std::size(keys)];
        random_() % 3 != 0 ? events_->keyPress(key) : events_->keyRelease(key);
        break;
      }
      case 4:
        tap(' ');
        break;
      case 5:
        if (random_() % 5 == 0) press_any_of(session.roamer().controls());
        break;
      case 6:
        if (random_() % 20 == 0) press_another();
        break;
      case 7:
        events_->mouseScroll(random_() % 2 != 0 ? osgGA::GUIEventAdapter::SCROLL_UP
                                                : osgGA::GUIEventAdapter::SCROLL_DOWN);
        break;
      case 8:
        if (random_() % 20 == 0) {
          const auto [x, y] = place();
          events_->mouseDoubleButtonPress(x, y, 1);
        }
        break;
      case 9: {
        const auto [x, y] = place();
        events_->mouseButtonPress(x, y, 1);
        break;
      }
      case 10: {
        const auto [x, y] = place();
        events_->mouseButtonRelease(x, y, 1);
        break;
      }
      case 11:
        if (random_() % 4 == 0) click(session);
        break;
      default:
        if (random_() % 4 == 0) {
          const auto [x, y] = place();
          events_->mouseMotion(x, y);
        }
    }
  }

 private:
  void tap(int key) {
    events_->keyPress(key);
    events_->keyRelease(key);
  }
  void press_any_of(const osgRoam::Controls& controls) {
    const auto& all = controls.commands();
    const osgRoam::Controls::Command& command = all[random_() % all.size()];
    if (command.kind != osgRoam::Controls::Kind::pressed) return;
    if (has(rereading, command.name) && random_() % 4 != 0) return;  // it takes long
    if (command.keys.empty()) return;
    const auto [symbol, ctrl] = command.keys.front();
    constexpr int ctrl_key = osgGA::GUIEventAdapter::KEY_Control_L;
    if (ctrl) events_->keyPress(ctrl_key, ctrl_key);
    tap(symbol);
    if (ctrl) events_->keyRelease(ctrl_key, ctrl_key);
  }
  /// Keys that are in no table: those of prompts, Escape, and the cameras.
  void press_another() {
    using Adapter = osgGA::GUIEventAdapter;
    constexpr std::uint64_t calm = 4 * 60;  // frames
    switch (random_() % 5) {
      case 0:
        tap(Adapter::KEY_BackSpace);
        break;
      case 1:
        tap(Adapter::KEY_Return);
        break;
      case 2:
        tap('1' + static_cast<int>(random_() % camera_names().size()));
        break;
      default:
        if (frames_ < calm_until_) break;
        calm_until_ = frames_ + calm;
        tap(Adapter::KEY_Escape);
    }
  }
  /// On what is seen now.
  void click(Session& session) {
    if (random_() % 8 == 0) session.stage().draw();
    const auto [x, y] = place();
    events_->mouseButtonPress(x, y, 1);
    events_->mouseButtonRelease(x, y, 1);
  }
  /// Any point of the window.
  std::array<float, 2> place() {
    const osgGA::GUIEventAdapter& now = *events_->getCurrentEventState();
    const auto between = [&](float least, float most) {
      return least + (most - least) * static_cast<float>(random_() % 1000) / 1000.0f;
    };
    const float x = between(now.getXmin(), now.getXmax());
    return {x, between(now.getYmin(), now.getYmax())};
  }

  osgGA::EventQueue* events_ = nullptr;
  std::uint64_t frames_ = 0, calm_until_ = 0;
  std::mt19937 random_{7};
};

/// Small, without a screen, and in a hurry.
ViewOptions options_for(const std::vector<std::filesystem::path>& scenes, const TestFolder& folder,
                        const std::string& size = "160x100") {
  use_no_settings(folder);
  setenv("ROAM_READER", ROAM_READER_PROGRAM, 1);
  ViewOptions options;
  options.scene.scenes = scenes;
  options.scene.no_profile = true;  // nothing is written beside the scene
  options.program = ROAM_PROGRAM;
  options.headless = true;
  options.size = size;
  options.time_limit = 1e9;
  options.speed = 30.0;
  return options;
}

/// The folder into which keys write pictures and paths.
class WorkingFolder {
 public:
  explicit WorkingFolder(const TestFolder& folder) { std::filesystem::current_path(folder.file("")); }
  ~WorkingFolder() { std::filesystem::current_path(before_); }
  WorkingFolder(const WorkingFolder&) = delete;
  WorkingFolder& operator=(const WorkingFolder&) = delete;

 private:
  std::filesystem::path before_ = std::filesystem::current_path();
};

/// Sessions in a row, as in the program: some keys end one for another one.
class Sessions {
 public:
  explicit Sessions(ViewOptions options) : given_(std::move(options)), options_(given_) { begin(); }

  [[nodiscard]] Session& now() { return *session_; }
  /// A frame. A scene in another frame is not roamed for long: in most there is nothing to walk on.
  void frame() {
    constexpr std::uint64_t strange_frames = 300;
    const bool is_strange = options_.scene.up != given_.scene.up || options_.scene.unit != given_.scene.unit;
    if (is_strange && ++strange_ > strange_frames) {
      finish();
      options_ = given_;
      begin();
    }
    if (session_->frame()) {
      // A fast ghost has come to the end of all space, and goes home.
      osgRoam::Manipulator& roamer = session_->roamer();
      if (roamer.problem().find("the ghost would leave the space") != std::string::npos) roamer.home(0.0);
      return;
    }
    const std::optional<NextSession> next = session_->next();
    finish();
    // Without it, a click on the menu has ended the program, which is begun again.
    if (next) static_cast<void>(go_on(options_, *next, given_));
    begin();
  }
  void finish() {
    EXPECT_EQ(session_->roamer().problem(), "");
    const Tally& tally = session_->log().tally();
    steps_ += tally.steps;
    length_ += tally.length;
    least_gap_ = std::min(least_gap_, tally.least_gap);
    Unwritten unwritten;
    static_cast<void>(session_->finish(unwritten));
    unwritten.raise();
    session_.reset();
    ++count_;
  }
  [[nodiscard]] int count() const { return count_; }
  [[nodiscard]] std::uint64_t steps() const { return steps_; }
  [[nodiscard]] double length() const { return length_; }
  /// The least clearance of the axis minus the radius, which `Y` makes smaller in places; 0: none was certified.
  [[nodiscard]] double least_gap() const { return least_gap_; }

 private:
  void begin() {
    strange_ = 0;
    const ViewSettings settings = settings_without_some_keys();
    session_.emplace(options_, make_plan(options_, settings), settings);
    while (!session_->roaming()) ASSERT_TRUE(session_->frame());
  }

  const ViewOptions given_;
  ViewOptions options_;
  std::optional<Session> session_;
  std::uint64_t strange_ = 0, steps_ = 0;
  int count_ = 0;
  double length_ = 0.0;
  double least_gap_ = std::numeric_limits<double>::infinity();
};

/// Without what the allocator keeps, as of a scene that was read anew.
std::uint64_t settled_bytes() {
  malloc_trim(0);
  return resident_bytes();
}

void soak(const std::vector<std::filesystem::path>& scenes, double hours, bool drawn,
          const std::string& size = "160x100") {
  const TestFolder folder;
  const WorkingFolder there(folder);
  Sessions sessions(options_for(scenes, folder, size));
  Person person;
  const auto frames = static_cast<std::uint64_t>(hours * 3600.0 * 60.0);
  // What is loaded lazily is there after a minute, drawn or not; the short soak has less.
  const std::uint64_t settled = std::min<std::uint64_t>(3600, frames / 3);
  std::uint64_t before = 0;
  for (std::uint64_t i = 0; i < frames; ++i) {
    if (i == settled) before = settled_bytes();
    // A drawn frame takes long: then the person is faster.
    for (int acts = drawn ? 10 : 1; acts > 0; --acts) person.act(sessions.now());
    ASSERT_NO_FATAL_FAILURE(sessions.frame()) << "frame " << i;
    if (drawn) sessions.now().stage().draw();
  }
  const double grown = static_cast<double>(settled_bytes()) - static_cast<double>(before);
  sessions.finish();
  std::cout << sessions.count() << " sessions, " << sessions.steps() << " steps, " << sessions.length() << " m, "
            << static_cast<double>(before) * 1e-6 << " MB after the first minute, " << grown * 1e-6
            << " MB more at the end, least gap " << sessions.least_gap() << " m\n";
  EXPECT_GT(sessions.steps(), frames / 2);
  EXPECT_GT(sessions.length(), 0.5 * static_cast<double>(frames) / 60.0);
  constexpr double rounding = 1e-9;
  EXPECT_GE(sessions.least_gap(), -1e-6 - rounding);
  // Bookmarks are kept, 100 bytes each; the allocator keeps some slack. A leak of 100 bytes a step would be more. In
  // less than a minute, not all of the scene has been seen and sent to the driver.
  const double unseen = drawn && settled < 3600 ? 16e6 : 0.0;
  const double read_anew = 2e6 * (sessions.count() - 1);      // holes that another scene leaves in the heap
  const double surrounded = test::has_sanitizer ? 2.0 : 1.0;  // what a sanitizer puts around each allocation
  EXPECT_LT(grown, surrounded * (8e6 + unseen + read_anew + 20.0 * static_cast<double>(frames)));
}

std::filesystem::path gallery(const TestFolder& folder) {
  const std::string file = folder.file("gallery.ply");
  generate::write_scene(generate::gallery({.triangles = 200'000, .seed = 1}), file);
  return file;
}

TEST(Soak, OnTheGallery) {
  const TestFolder folder;
  soak({gallery(folder)}, number_from("ROAM_SOAK_HOURS", 0.1), false);
}

TEST(Soak, OnThePit) {
  ROAM_NEEDS_TEST_DATA();
  soak({(roam::test::test_data() / "pit_osgb").string()}, number_from("ROAM_SOAK_HOURS", 0.1), false);
}

TEST(Soak, DrawnOnTheGallery) {
  const TestFolder folder;
  for (const char* size : {"160x100", "640x360", "200x300"}) {
    soak({gallery(folder)}, number_from("ROAM_SOAK_DRAWN", 0.05) / 60.0 / 3.0, true, size);
  }
}

TEST(Soak, DrawnOnThePitWhilePagesComeAndGo) {
  ROAM_NEEDS_TEST_DATA();
  soak({(roam::test::test_data() / "pit_osgb").string()}, number_from("ROAM_SOAK_DRAWN", 0.05) / 60.0, true);
}

// Says most under a sanitizer: what reads pages must not be taken away from the pager while it reads.
TEST(Soak, ClosedAgainAndAgainWhilePagesCome) {
  ROAM_NEEDS_TEST_DATA();
  const TestFolder folder;
  const ViewOptions options = options_for({(roam::test::test_data() / "pit_osgb").string()}, folder);
  for (int frames = 1; frames <= 8; ++frames) {
    Session session(options, make_plan(options, {}), {});
    while (!session.roaming()) ASSERT_TRUE(session.frame());
    // Few enough that the pager still reads what they ask for.
    for (int i = 0; i < frames; ++i) {
      ASSERT_TRUE(session.frame());
      session.stage().draw();
    }
  }
}

}  // namespace
