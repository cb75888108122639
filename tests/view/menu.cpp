// The menu.
#include <chrono>
#include <glm/geometric.hpp>
#include <optional>

#include "view_tooled.h"

namespace {

using namespace roam;
using namespace roam::app;
using view_stores::Tooled;

/// The middle of a line of the open help, found on a vertical line through it.
std::optional<std::pair<double, double>> line_of(graphics::Hud& hud, const std::string& command) {
  for (double x = -0.98; x < 1.0; x += 0.02) {
    double least = 1.0, most = -1.0;
    for (double y = -0.99; y < 1.0; y += 0.01) {
      if (hud.help_at(x, y) != command) continue;
      least = std::min(least, y);
      most = std::max(most, y);
    }
    if (least <= most) return std::pair(x, 0.5 * (least + most));
  }
  return std::nullopt;
}

/// Opens the help, and turns its pages to this line.
std::optional<std::pair<double, double>> find_in_help(Tooled& d, const std::string& command) {
  graphics::Hud& hud = d.session->stage().hud();
  hud.show_help(true);
  for (;;) {
    d.session->stage().draw();
    const auto at = line_of(hud, command);
    if (at || !hud.help_goes_on()) return at;
    d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_DOWN);
    d.run(1.0 / 60.0);
  }
}

/// Opens the help and clicks on a line.
void choose(Tooled& d, const char* command) {
  const auto at = find_in_help(d, command);
  ASSERT_TRUE(at) << command;
  d.click(at->first, at->second);
  d.run(0.1);
  EXPECT_FALSE(d.session->stage().hud().help_shown());
}

TEST(Menu, PressesTheKeyOfTheClickedLine) {
  Tooled d;
  choose(d, "measure");
  EXPECT_TRUE(contains(d.hud(), "Measuring")) << d.hud();
  choose(d, "gravity");
  EXPECT_EQ(d.session->roamer().mode(), Mode::fly);
  EXPECT_TRUE(d.measured().empty()) << "a click in the menu is none on the scene";
}

TEST(Menu, ReachesAndLeavesTheOtherCameras) {
  Tooled d;
  for (const std::size_t i : {1, 2, 3, 4, 5, 6, 7, 1}) {
    choose(d, "cameras");
    EXPECT_FALSE(d.session->roamer_leads());
    EXPECT_TRUE(contains(d.hud(), camera_names()[i] + "  (1: back to the body)")) << d.hud();
  }
  choose(d, "body_camera");
  EXPECT_TRUE(d.session->roamer_leads());
}

TEST(Menu, ReachesCommandsWithCtrl) {
  Tooled d;
  const auto at = find_in_help(d, "picture_with_display");
  ASSERT_TRUE(at);
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(d.folder.file(""));
  d.click(at->first, at->second);
  // Another thread writes the picture, which may wait for a processor.
  const auto limit = std::chrono::steady_clock::now() + std::chrono::seconds(60);
  while (!contains(d.hud(), "roam-1.png") && std::chrono::steady_clock::now() < limit) d.session->stage().draw();
  EXPECT_TRUE(contains(d.hud(), "roam-1.png")) << d.hud();
  std::filesystem::current_path(before);
}

TEST(Menu, ReachesCommandsWithCtrlInEveryCamera) {
  Tooled d;
  choose(d, "cameras");
  choose(d, "layers");
  EXPECT_TRUE(contains(d.hud(), "Objects: ")) << d.hud();
  EXPECT_EQ(d.session->tools().plan().size(), graphics::PlanSize::none) << "which is on the same key without Ctrl";
}

TEST(Menu, TypesNothingIntoQuestionsAndLists) {
  Tooled d;
  d.tap('b');
  d.session->run("name_bookmark");
  choose(d, "measure");
  EXPECT_TRUE(d.session->tools().is_measuring());
  EXPECT_TRUE(contains(d.hud(), "Name of the bookmark: _")) << d.hud();
  d.tap(osgGA::GUIEventAdapter::KEY_Escape);
  d.session->run("layers");
  choose(d, "measure");
  EXPECT_FALSE(d.session->tools().is_measuring());
  choose(d, "cameras");
  EXPECT_FALSE(d.session->roamer_leads());
  EXPECT_TRUE(contains(d.hud(), "[x] ceiling")) << "the letters are not searched: " << d.hud();
}

TEST(Menu, HasAllCommandsInASmallWindow) {
  Tooled d;  // of 640 x 360
  graphics::Hud& hud = d.session->stage().hud();
  for (const auto& command : d.session->roamer().controls().commands()) {
    const bool is_clickable = command.kind == osgRoam::Controls::Kind::pressed || is_camera(command.name);
    EXPECT_EQ(find_in_help(d, command.name).has_value(), is_clickable) << command.name;
    hud.show_help(false);
  }
  hud.show_help(true);
  d.session->stage().draw();
  ASSERT_TRUE(hud.help_goes_on());
  const auto next = line_of(hud, graphics::Hud::help_more);
  ASSERT_TRUE(next);
  d.click(next->first, next->second);
  EXPECT_TRUE(hud.help_shown());
  d.session->stage().draw();
  while (hud.help_goes_on()) {
    d.tap('h');
    d.session->stage().draw();
  }
  d.tap('h');
  EXPECT_FALSE(hud.help_shown()) << "the key closes the last page";
}

TEST(Menu, OpensWithItsButtonAndClosesElsewhere) {
  Tooled d;
  graphics::Hud& hud = d.session->stage().hud();
  hud.set_button("Menu: H");
  const Vec3 before = d.place();
  d.click(-0.93, -0.88);
  EXPECT_TRUE(hud.help_shown());
  d.session->stage().draw();
  d.click(0.999, -0.999, 2);
  EXPECT_FALSE(hud.help_shown());
  d.run(1.0);
  EXPECT_LT(glm::distance(d.place(), before), 1e-3) << "nobody is sent there";
}

}  // namespace
