// The plan beside the picture.

#include "graphics/plan_panel.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "graphics/hud.h"
#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::Hud;
using graphics::PlanPanel;
using graphics::PlanSize;

/// Pixels of the plan's right half that a colour test accepts: their mean place.
template <class Test>
glm::dvec2 middle_of(const osg::Image& picture, int left, const Test& test) {
  glm::dvec2 sum(0.0);
  int count = 0;
  for (int y = 0; y < picture.t(); ++y) {
    for (int x = left; x < picture.s(); ++x) {
      if (!test(at(picture, x, y))) continue;
      sum += glm::dvec2(x, y);
      ++count;
    }
  }
  EXPECT_GT(count, 5);
  return sum / std::max(1.0, static_cast<double>(count));
}

bool is_blue(const Pixel& p) { return p.b > p.r + 80; }
bool is_dark(const Pixel& p) { return p.r < 90 && p.g < 90 && p.b < 90; }

TEST(GraphicsPlanPanel, SaysThatItIsBeingDrawn) {
  Stage stage(640, 360);
  PlanPanel plan(stage.frame);
  plan.set_view({.size = PlanSize::small, .is_coming = true});
  const auto coming = stage.picture(true);
  plan.set_view({.size = PlanSize::small});
  EXPECT_GT(differing(*coming, *stage.picture(true)), 50);
}

TEST(GraphicsPlanPanel, ShowsWallsWhereTheyAre) {
  Stage stage(640, 360);
  PlanPanel plan(stage.frame);
  // A wall 5 m north of the body, far from the origin.
  const glm::dvec2 body(4e6, 5e6);
  plan.set_lines({.base = body + glm::dvec2(1.0, 0.0), .walls = {{-3.0f, 5.0f}, {1.0f, 5.0f}}});
  plan.set_view({.size = PlanSize::small, .centre = body, .half = 10.0, .yaw = 0.0});
  const auto picture = stage.picture(true);
  const glm::dvec2 arrow = middle_of(*picture, 400, is_blue);
  const auto centre = plan.at(2.0 * arrow.x / 640 - 1.0, 2.0 * arrow.y / 360 - 1.0);
  ASSERT_TRUE(centre);
  EXPECT_LT(glm::distance(*centre, body), 0.7);
  // The wall is the dark row above the arrow; the scale and the letter are nearer to the edges.
  int dark = 0;
  for (int x = 400; x < 640; ++x) {
    for (int y = 0; y < 360; ++y) {
      const auto place = plan.at(2.0 * (x + 0.5) / 640 - 1.0, 2.0 * (y + 0.5) / 360 - 1.0);
      if (!place || !is_dark(at(*picture, x, y)) || std::abs(place->x - body.x) > 7.0) continue;
      if (place->y < body.y || place->y > body.y + 7.0) continue;
      EXPECT_NEAR(place->y, body.y + 5.0, 0.4);
      EXPECT_GT(place->x, body.x - 2.5);
      EXPECT_LT(place->x, body.x + 2.5);
      ++dark;
    }
  }
  EXPECT_GT(dark, 10);
}

TEST(GraphicsPlanPanel, ShowsNamedPlacesThatLieOnIt) {
  const auto is_green = [](const Pixel& p) { return p.g > p.r + 40 && p.g > p.b + 20; };
  Stage stage(640, 360);
  PlanPanel plan(stage.frame);
  const glm::dvec2 body(4e6, 5e6), door = body + glm::dvec2(-4.0, 3.0);
  plan.set_places({{door, "door"}, {body + glm::dvec2(50.0, 0.0), "far"}});
  plan.set_view({.size = PlanSize::small, .centre = body, .half = 10.0, .yaw = 0.0});
  const auto picture = stage.picture(true);
  int left = 640, bottom = 0, count = 0;
  for (int y = 0; y < 360; ++y) {
    for (int x = 400; x < 640; ++x) {
      if (!is_green(at(*picture, x, y))) continue;
      ++count;
      if (x < left) bottom = y;
      left = std::min(left, x);
    }
  }
  EXPECT_GT(count, 20);
  const auto dot = plan.at(2.0 * (left + 3) / 640 - 1.0, 2.0 * bottom / 360 - 1.0);
  ASSERT_TRUE(dot);
  EXPECT_LT(glm::distance(*dot, door), 0.8);
  plan.set_places({});
  const auto without = stage.picture(true);
  int rest = 0;
  for (int y = 0; y < 360; ++y) {
    for (int x = 400; x < 640; ++x) rest += is_green(at(*without, x, y));
  }
  EXPECT_EQ(rest, 0);
}

TEST(GraphicsPlanPanel, HasItsScaleOverTheWalls) {
  Stage stage(640, 360);
  PlanPanel plan(stage.frame);
  const auto lower_left = [&] {
    plan.set_view({.size = PlanSize::small, .half = 12.0});
    const auto picture = stage.picture(true);
    const graphics::Rectangle r = plan.place();
    std::vector<Pixel> pixels;
    for (int y = 0; y < 24; ++y) {
      for (int x = 0; x < 32; ++x) pixels.push_back(at(*picture, static_cast<int>(r.x) + x, static_cast<int>(r.y) + y));
    }
    return pixels;
  };
  const auto alone = lower_left();
  std::vector<glm::vec2> walls;
  for (float i = -12.0f; i < 12.0f; i += 0.4f) walls.insert(walls.end(), {{-12.0f, i}, {12.0f, i}});
  plan.set_lines({.walls = walls});
  EXPECT_EQ(lower_left(), alone);
  EXPECT_GT(std::count_if(alone.begin(), alone.end(), is_dark), 20) << "the bar and its number";
}

TEST(GraphicsPlanPanel, LeavesRoomForTheStatusInATallWindow) {
  Stage stage(500, 900);
  Hud hud(stage.frame);
  PlanPanel plan(stage.frame);
  hud.set_status({{"walk", "0.0 m/s"}, {"ahead", "IfcWallStandardCase_BasicWall:Exterior-Brick, 3.71 m"}});
  for (const PlanSize size : {PlanSize::small, PlanSize::large}) {
    plan.set_view({.size = size, .centre = {0, 0}, .half = 10.0, .yaw = 0.0});
    hud.set_plan(plan.place());
    (void)stage.picture(true);
    ASSERT_EQ(hud.panels().size(), 1u);
    EXPECT_LT(hud.panels()[0].x + hud.panels()[0].width, plan.place().x);
  }
}

TEST(GraphicsPlanPanel, LeavesRoomForTheWholeHintInATallWindow) {
  Stage stage(420, 760);
  Hud hud(stage.frame);
  PlanPanel plan(stage.frame);
  hud.set_hint("H: help     W A S D: walk     drag: look");
  const auto hint = [&] {
    hud.set_plan(plan.place());
    (void)stage.picture(true);
    return hud.panels().at(0);
  };
  const graphics::Rectangle alone = hint();
  plan.set_view({.size = PlanSize::small, .centre = {0, 0}, .half = 10.0, .yaw = 0.0});
  EXPECT_EQ(hint().width, alone.width) << "not shortened";
  EXPECT_FALSE(overlap(hint(), plan.place()));
}

TEST(GraphicsPlanPanel, IsNotThereUnlessWanted) {
  Stage stage(640, 360);
  const auto without = stage.picture(true);
  PlanPanel plan(stage.frame);
  plan.set_lines({.walls = {{0.0f, 0.0f}, {5.0f, 5.0f}}});
  const auto differs = [&] {
    const auto with = stage.picture(true);
    int pixels = 0;
    for (int y = 0; y < 360; ++y) {
      for (int x = 0; x < 640; ++x) pixels += at(*without, x, y).distance(at(*with, x, y)) > 8;
    }
    return pixels;
  };
  EXPECT_EQ(differs(), 0);
  EXPECT_FALSE(plan.at(0.9, 0.5));
  plan.set_view({.size = PlanSize::small});
  const int small = differs();
  EXPECT_GT(small, 5000);
  plan.set_view({.size = PlanSize::large});
  EXPECT_GT(differs(), 4 * small);
  plan.set_view({});
  EXPECT_EQ(differs(), 0);
}

}  // namespace
}  // namespace roam::test
