// Hours of a person who presses everything, at high speed: nothing gives way and no memory grows.
//
// ROAM_SOAK_HOURS says how many hours are simulated (default: 0.1, 21,600 frames; the soak of a release is 8), and
// ROAM_SOAK_DRAWN how many minutes of that kind are drawn, small, frame by frame (default: 0.05).
#include <gtest/gtest.h>

#include <cstdlib>
#include <random>
#include <thread>

#include "roam/generate.h"
#include "view/session.h"
#include "view_scenes.h"

#ifdef __SANITIZE_ADDRESS__
// The address sanitizer keeps freed memory back, 256 MB of it: that is no growth of ours.
extern "C" const char* __asan_default_options() { return "quarantine_size_mb=1:thread_local_quarantine_size_kb=64"; }
#endif

namespace {

using namespace roam;
using namespace roam::app;

double number_from(const char* variable, double otherwise) {
  const char* text = std::getenv(variable);
  return text == nullptr ? otherwise : std::strtod(text, nullptr);
}

/// Presses keys, drags, clicks and scrolls at random, the same on every machine.
class Person {
 public:
  explicit Person(osgGA::EventQueue& events) : events_(events) {}

  void act() {
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
        random_() % 3 != 0 ? events_.keyPress(key) : events_.keyRelease(key);
        break;
      }
      case 4:
        tap(' ');
        break;
      case 5:
        if (random_() % 8 == 0) tap("gnhvbp"[random_() % 5]);
        break;
      case 6:
        if (random_() % 50 == 0) tap(osgGA::GUIEventAdapter::KEY_Home);
        break;
      case 7:
        events_.mouseScroll(random_() % 2 != 0 ? osgGA::GUIEventAdapter::SCROLL_UP
                                               : osgGA::GUIEventAdapter::SCROLL_DOWN);
        break;
      case 8:
        if (random_() % 20 == 0) events_.mouseDoubleButtonPress(place(160), place(100), 1);
        break;
      case 9:
        events_.mouseButtonPress(place(160), place(100), 1);
        break;
      case 10:
        events_.mouseButtonRelease(place(160), place(100), 1);
        break;
      default:
        if (random_() % 4 == 0) events_.mouseMotion(place(160), place(100));
    }
  }

 private:
  void tap(int key) {
    events_.keyPress(key);
    events_.keyRelease(key);
  }
  float place(unsigned size) { return static_cast<float>(random_() % size); }

  osgGA::EventQueue& events_;
  std::mt19937 random_{7};
};

/// Small, without a screen, and in a hurry.
ViewOptions options_for(const std::vector<std::filesystem::path>& scenes, const TestFolder& folder) {
  use_no_settings(folder);
  setenv("ROAM_READER", ROAM_READER_PROGRAM, 1);
  ViewOptions options;
  options.scene.scenes = scenes;
  options.headless = true;
  options.size = "160x100";
  options.time_limit = 1e9;
  options.speed = 30.0;
  return options;
}

void soak(const std::vector<std::filesystem::path>& scenes, double hours, bool drawn) {
  const TestFolder folder;
  const ViewOptions options = options_for(scenes, folder);
  const ViewPlan plan = make_plan(options, {});
  Session session(options, plan, {});
  while (!session.roaming()) ASSERT_TRUE(session.frame());
  Person person(*session.stage().viewer().getEventQueue());
  const auto frames = static_cast<std::uint64_t>(hours * 3600.0 * 60.0);
  // What is loaded lazily is there after a minute, drawn or not; the short soak has less.
  const std::uint64_t settled = std::min<std::uint64_t>(3600, frames / 3);
  std::uint64_t before = 0;
  for (std::uint64_t i = 0; i < frames; ++i) {
    if (i == settled) before = resident_bytes();
    person.act();
    ASSERT_TRUE(session.frame());
    if (drawn) session.stage().draw();
  }
  const double grown = static_cast<double>(resident_bytes()) - static_cast<double>(before);
  std::cout << session.log().tally().steps << " steps, " << session.log().tally().length << " m, "
            << static_cast<double>(before) * 1e-6 << " MB after the first minute, " << grown * 1e-6
            << " MB more at the end, least clearance " << session.log().tally().least_axis_clearance << " m\n";
  EXPECT_EQ(session.roamer().problem(), "");
  EXPECT_GT(session.log().tally().steps, frames / 2);
  EXPECT_GT(session.log().tally().length, 0.5 * static_cast<double>(frames) / 60.0);
  EXPECT_GE(session.log().tally().least_axis_clearance, plan.walker.radius - 1e-6);
  // Bookmarks are kept, 100 bytes each; the allocator keeps some slack. A leak of 100 bytes a step would be more. In
  // less than a minute, not all of the scene has been seen and sent to the driver.
  const double unseen = drawn && settled < 3600 ? 16e6 : 0.0;
  EXPECT_LT(grown, 8e6 + unseen + 20.0 * static_cast<double>(frames));
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
  soak({gallery(folder)}, number_from("ROAM_SOAK_DRAWN", 0.05) / 60.0, true);
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
