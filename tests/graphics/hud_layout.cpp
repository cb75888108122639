// The parts of the display leave each other free, in small and large windows.
#include <algorithm>
#include <sstream>

#include "graphics/hud.h"
#include "graphics/plan_panel.h"
#include "graphics_stage.h"

namespace roam::test {
namespace {

using namespace graphics;

/// The longest display of a session, with a real one's words.
const std::vector<StatusLine> usual{{"", "walk  1.4 m/s  in the air"},
                                    {"feet", "-12531.56, 1539.00, 181.77"},
                                    {"height", "0.42 m above the floor"},
                                    {"heading", "259\u00b0 W, 12\u00b0 down"},
                                    {"ahead", "aws_robomaker_residential_RoomWindow_01, 13.52 m"},
                                    {"body", "radius 0.30 m, height 1.80 m, support disc 0.64 m, crouched"}};
const std::vector<StatusLine> measuring{
    {"", "walk  0.0 m/s"},
    {"hidden", "12 of 640 objects; the body passes through, except 2 that it cannot tell by their names"},
    {"clear", "over 7.62 m wide, 2.50 m high"},
    {"A", "-0.729, -1.439, 0.895, aws_robomaker_residential_SofaC_01, slope 12.4\u00b0"},
    {"B", "-0.921, -0.398, 0.003, aws_robomaker_residential_Carpet_01, slope 0\u00b0"},
    {"A to B", "1.383 m: 1.058 m level, 0.892 m down, slope 40.1\u00b0"},
    {"way", "NO: a body 0.60 m wide and 1.80 m high does not get from A to B.", Tone::warning},
    {"", "why A is 0.067 m from \"aws_robomaker_residential_Handle_01\", at (-0.73, -1.44, 0.90)"},
    {"", "0.233 m too near; the nearest place with room is (-0.35, -1.20, 0.00), 0.45 m away"}};

const char* const message =
    "blocked by aws_robomaker_residential_CoffeeTable_01: opening 0.51 m for a body of 0.60 m\n"
    "written: /home/somebody/with/a/long/name/roam-12.path\nbookmark 12";

HudList long_list(std::size_t rows) {
  HudList list{"Objects: 640, hidden: 12   wheel: 614 more", "search: window   (click: ends)", {}};
  for (std::size_t i = 0; i < rows; ++i) {
    list.rows.push_back({"aws_robomaker_residential_RoomWindow_" + std::to_string(i), std::to_string(i),
                         i % 3 == 0 ? "open" : "", false, static_cast<int>(i % 4), ListRow::Box::half});
  }
  return list;
}

std::string text_of(const Rectangle& r) {
  std::ostringstream text;
  text << r.width << " x " << r.height << " at " << r.x << ", " << r.y;
  return text.str();
}

/// The parts are in the picture, and no two of them overlap.
void expect_apart(Stage& stage, const Hud& hud, const PlanPanel* plan, int width, int height) {
  (void)stage.picture(true);
  std::vector<Rectangle> all = hud.panels();
  if (plan != nullptr) all.push_back(plan->place());
  EXPECT_FALSE(all.empty());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Rectangle& r = all[i];
    EXPECT_GE(r.x, 0) << text_of(r);
    EXPECT_GE(r.y, 0) << text_of(r);
    EXPECT_LE(r.x + r.width, width) << text_of(r);
    EXPECT_LE(r.y + r.height, height) << text_of(r);
    for (std::size_t k = 0; k < i; ++k) EXPECT_FALSE(overlap(r, all[k])) << text_of(r) << " over " << text_of(all[k]);
  }
}

class GraphicsHudLayout : public testing::TestWithParam<std::pair<int, int>> {};

TEST_P(GraphicsHudLayout, KeepsItsPartsApart) {
  const auto [width, height] = GetParam();
  Stage stage(width, height);
  Hud hud(stage.frame);
  PlanPanel plan(stage.frame);
  hud.set_button("Menu: H");
  hud.set_recording("1234.5 m, 12 min 3 s");
  for (const auto* lines : {&usual, &measuring}) {
    for (const bool hinted : {false, true}) {
      for (const bool told : {false, true}) {
        for (const PlanSize size : {PlanSize::none, PlanSize::small, PlanSize::large}) {
          for (const bool listed : {false, true}) {
            SCOPED_TRACE(testing::Message() << lines->size() << " lines, hint " << hinted << ", message " << told
                                            << ", plan " << int(size) << ", list " << listed);
            if (listed && size != PlanSize::none) continue;  // the list takes the plan's place
            hud.set_status(*lines);
            hud.set_hint(hinted ? "Name of the bookmark: somewhere in the gallery behind the second door, on the "
                                  "left_     Enter: keep     Escape: cancel"
                                : "");
            hud.set_message(told ? message : "", Tone::warning);
            hud.set_progress(told ? 0.4 : -1.0);
            plan.set_view({.size = size, .centre = {0, 0}, .half = 10.0, .yaw = 0.0});
            hud.set_plan(plan.place());
            hud.set_list(listed ? std::optional(long_list(hud.list_rows() + 5)) : std::nullopt);
            expect_apart(stage, hud, size == PlanSize::none ? nullptr : &plan, width, height);
          }
        }
      }
    }
  }
}

TEST_P(GraphicsHudLayout, KeepsTheHelpApart) {
  const auto [width, height] = GetParam();
  Stage stage(width, height);
  Hud hud(stage.frame);
  std::vector<HelpLine> keys;
  for (int section = 0; section < 4; ++section) {
    keys.push_back({"Section", ""});
    for (int i = 0; i < 12; ++i) keys.push_back({"Ctrl+Delete", "changes between walking and flying", "walk"});
  }
  hud.set_help(keys);
  hud.set_status(usual);
  hud.set_button("Menu: H");
  hud.set_message("written: /tmp/roam-1.png");
  hud.set_list(long_list(10));
  hud.show_help(true);
  expect_apart(stage, hud, nullptr, width, height);
}

TEST(GraphicsHudMessage, EndsWithAWholeSentence) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  const auto height = [&](const std::string& text) {
    hud.set_message(text);
    (void)stage.picture(true);
    return hud.panels().at(0).height;
  };
  const std::string one = "a sentence that is so long that it takes more than a line of this window, which is small";
  EXPECT_FLOAT_EQ(height(one + "\n" + one + "\n" + one + "\n" + one), height(one + "\n" + one));
}

TEST(GraphicsHudHint, IsBrokenBesideAList) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_hint("Name of the bookmark: at the second door_     Enter: keep     Escape: cancel");
  (void)stage.picture(true);
  ASSERT_EQ(hud.panels().size(), 1u);
  const Rectangle whole = hud.panels()[0];
  hud.set_list(long_list(5));
  (void)stage.picture(true);
  const Rectangle broken = hud.panels()[0];
  EXPECT_LT(broken.width, whole.width);
  EXPECT_GT(broken.height, 1.4f * whole.height) << "no word of it is cut";
}

TEST_P(GraphicsHudLayout, HidesLabelsThatLieBehindAPart) {
  const auto [width, height] = GetParam();
  Stage stage(width, height);
  Hud hud(stage.frame);
  PlanPanel plan(stage.frame);
  hud.set_status(measuring);
  hud.set_button("Menu: H");
  hud.set_message(message, Tone::warning);
  for (const PlanSize size : {PlanSize::small, PlanSize::large, PlanSize::none}) {
    plan.set_view({.size = size, .centre = {0, 0}, .half = 10.0, .yaw = 0.0});
    hud.set_plan(plan.place());
    hud.set_list(size == PlanSize::none ? std::optional(long_list(hud.list_rows())) : std::nullopt);
    hud.set_labels({});
    const auto without = stage.picture(true);
    std::vector<Rectangle> all = hud.panels();
    if (size != PlanSize::none) all.push_back(plan.place());
    ASSERT_GE(all.size(), 4u);
    for (const Rectangle& r : all) {
      std::vector<HudLabel> labels;
      for (const float share : {0.0f, 0.5f, 1.0f})
        labels.push_back({"too narrow", r.x + share * r.width, r.y + 0.5f * r.height - 8.0f});
      hud.set_labels(labels);
      EXPECT_EQ(differing(*without, *stage.picture(true)), 0) << "plan " << int(size) << ", behind " << text_of(r);
    }
  }
  hud.set_list(std::nullopt);
  const float x = 0.8f * static_cast<float>(width), y = 0.5f * static_cast<float>(height);
  (void)stage.picture(true);
  const auto without = stage.picture(true);
  hud.set_labels({{"too narrow", x, y}});
  const auto with = stage.picture(true);
  EXPECT_GT(differing(*without, *with), 500) << "where no part is";
  // A part that comes later hides it, too.
  hud.set_list(long_list(3));
  const auto listed = stage.picture(true);
  hud.set_labels({});
  EXPECT_EQ(differing(*listed, *stage.picture(true)), 0);
}

TEST_P(GraphicsHudLayout, PutsALabelBelowItsPointWhereAPartIsAbove) {
  const auto [width, height] = GetParam();
  Stage stage(width, height);
  Hud hud(stage.frame);
  hud.set_message("here");
  (void)stage.picture(true);
  ASSERT_EQ(hud.panels().size(), 1u);
  const Rectangle part = hud.panels().front();
  const auto without = stage.picture(true);
  hud.set_labels({{"A", part.x + 0.5f * part.width, part.y - 2.0f}});
  EXPECT_GT(differing(*without, *stage.picture(true)), 50);
}

INSTANTIATE_TEST_SUITE_P(Windows, GraphicsHudLayout,
                         testing::Values(std::pair(640, 1000), std::pair(420, 760), std::pair(640, 360),
                                         std::pair(1280, 720), std::pair(3840, 2160)),
                         [](const auto& size) {
                           return std::to_string(size.param.first) + "x" + std::to_string(size.param.second);
                         });

TEST(GraphicsHudList, HasRowsToClick) {
  Stage stage(640, 360);
  Hud hud(stage.frame);
  hud.set_list(HudList{
      "Objects",
      "search",
      {{"Wall", "wall", {}, false, 0, ListRow::Box::on}, {"Door", "door", "open", false, 0, ListRow::Box::off}}});
  const auto list = stage.picture(true);
  EXPECT_GT(hud.list_rows(), 10u);
  std::vector<std::string> found;
  for (double y = 1.0; y > -1.0; y -= 0.01) {
    const std::string name = hud.list_at(0.8, y);
    EXPECT_TRUE(name.empty() || hud.list_covers(0.8, y));
    if (!name.empty() && (found.empty() || found.back() != name)) found.push_back(name);
  }
  EXPECT_EQ(found, (std::vector<std::string>{Hud::list_search, "wall", "door"}));
  EXPECT_FALSE(hud.list_covers(-0.5, 0.0));
  EXPECT_NE(hud.text().find("[x] Wall\n[ ] Door\n"), std::string::npos) << hud.text();
  hud.set_list_focus("door");
  EXPECT_GT(differing(*list, *stage.picture(true), 6), 200);
  hud.set_list(std::nullopt);
  (void)stage.picture(true);
  EXPECT_EQ(hud.list_at(0.8, 0.0), "");
}

}  // namespace
}  // namespace roam::test
