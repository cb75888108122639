// The plan, and the way to what is clicked on it.
#include <fmt/format.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "roam/error.h"
#include "view/plan_scan.h"
#include "view_tooled.h"

namespace {

using namespace roam;
using namespace roam::app;
using view_stores::Tooled;

/// Length of all pieces, m.
double length_of(const std::vector<glm::vec2>& pieces) {
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < pieces.size(); i += 2) length += glm::distance(pieces[i], pieces[i + 1]);
  return length;
}

TEST(PlanScan, FindsTheWallsOnEverySide) {
  // A box of 4 m x 2 m and a wall at 30 degrees, 3 m long, behind it.
  Mesh mesh{"walls",
            {{-2, -1, -1}, {2, -1, -1}, {2, 1, -1}, {-2, 1, -1}, {-2, -1, 1}, {2, -1, 1}, {2, 1, 1}, {-2, 1, 1}},
            {}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.triangles.push_back({i, j, j + 4});
    mesh.triangles.push_back({i, j + 4, i + 4});
  }
  const double c = 3.0 * std::cos(glm::radians(30.0)), s = 1.5;
  mesh.vertices.insert(mesh.vertices.end(), {{0, 3, -1}, {c, 3 + s, -1}, {c, 3 + s, 1}, {0, 3, 1}});
  mesh.triangles.push_back({8, 9, 10});
  mesh.triangles.push_back({8, 10, 11});
  const World world = World::build({&mesh, 1});
  const auto pieces = scan_plan(world, {Vec3(0.0), 6.0, 0.02}, [] { return true; });
  EXPECT_NEAR(length_of(pieces), 12.0 + 3.0, 0.3);
  const double across = std::cos(glm::radians(30.0)), up = 0.5;
  for (const glm::vec2& p : pieces) {
    const bool on_box = std::abs(std::max(std::abs(p.x) - 2.0, std::abs(p.y) - 1.0)) < 0.02;
    const bool on_wall = std::abs(-up * p.x + across * (p.y - 3.0)) < 0.005;
    EXPECT_TRUE(on_box || on_wall) << p.x << " " << p.y;
  }
  EXPECT_TRUE(scan_plan(world, {Vec3(0, 0, 1.5), 6.0, 0.1}, [] { return true; }).empty()) << "above all walls";
  EXPECT_THROW(static_cast<void>(scan_plan(world, {}, [] { return false; })), Cancelled);
}

TEST(Tools, ShowThePlanOfAStoreAsOfItsScene) {
  for (const bool on_store : {false, true}) {
    Tooled d(on_store);
    d.tap('l');
    ASSERT_TRUE(d.until([&] { return !d.session->tools().plan().walls().empty(); }));
    Box box;
    for (const glm::dvec2& p : d.session->tools().plan().walls()) box.include({p.x, p.y, 0.0});
    EXPECT_NEAR(box.lower.x, 0.0, 0.1);
    EXPECT_NEAR(box.upper.x, 20.0, 0.1);
    EXPECT_NEAR(box.lower.y, -2.0, 0.1);
    EXPECT_NEAR(box.upper.y, 2.0, 0.1);
  }
}

/// Clicks on the large plan, where it shows this point; false if it does not.
bool click_on_plan(Tooled& d, double to_x, double to_y) {
  while (d.session->tools().plan().size() != graphics::PlanSize::large) d.tap('l');
  d.run(0.1);
  d.session->stage().draw();  // which gives the plan its place
  for (double y = -1.0; y < 1.0; y += 0.01) {
    for (double x = -1.0; x < 1.0; x += 0.01) {
      const auto at = d.session->tools().plan().at(x, y);
      if (!at || std::abs(at->x - to_x) > 0.5 || std::abs(at->y - to_y) > 0.5) continue;
      d.click(x, y);
      return true;
    }
  }
  return false;
}

TEST(Tools, GoToWhatIsClickedOnThePlan) {
  Tooled d;
  const double before = d.place().x;
  ASSERT_TRUE(click_on_plan(d, before + 5.0, d.place().y));
  d.run(3.0);
  EXPECT_NEAR(d.place().x, before + 5.0, 1.0);
  d.tap('l');
  EXPECT_EQ(d.session->tools().plan().size(), graphics::PlanSize::none);
  EXPECT_FALSE(d.session->tools().plan().at(0.9, 0.0));
}

TEST(Tools, GoToWhatIsClickedOnThePlanInEveryCamera) {
  Tooled d;
  const double before = d.place().x;
  d.tap('2');
  ASSERT_TRUE(click_on_plan(d, before + 5.0, d.place().y));
  EXPECT_TRUE(d.session->roamer_leads());
  d.run(3.0);
  EXPECT_NEAR(d.place().x, before + 5.0, 1.0);
}

/// A floor 6 m wide from (x, z) to (x, z).
std::string floor_obj(const char* name, double x0, double z0, double x1, double z1) {
  return fmt::format("o {}\nv {} -3 {}\nv {} -3 {}\nv {} 3 {}\nv {} 3 {}\nf -4 -3 -2 -1\n", name, x0, z0, x1, z1, x1,
                     z1, x0, z0);
}

TEST(Tools, GoUpAndDownASlopeThatIsClickedOnThePlan) {
  const double steep = std::tan(glm::radians(20.0));
  const std::string slope = floor_obj("slope", -20.0, -30.0 * steep, 40.0, 30.0 * steep);
  for (const double way : {12.0, -12.0}) {
    Tooled d(ViewOptions{}, false, slope);
    const double before = d.place().z;
    ASSERT_TRUE(click_on_plan(d, 10.0 + way, 0.0));
    EXPECT_FALSE(contains(d.hud(), "There is no floor")) << d.hud();
    d.run(12.0);
    EXPECT_NEAR(d.place().x, 10.0 + way, 1.0);
    EXPECT_NEAR(d.place().z, before + way * steep, 0.5);
  }
}

TEST(Tools, GoToTheStoreyNearestToTheirOwnThatIsClickedOnThePlan) {
  // A gallery with a ramp up, above a cellar and a hall.
  const std::string building = floor_obj("gallery", 0.0, 0.0, 10.5, 0.0) + floor_obj("ramp", 10.5, 0.0, 25.0, 2.175) +
                               floor_obj("cellar", 15.0, -1.4, 25.0, -1.4) + floor_obj("hall", -5.0, -5.0, 35.0, -5.0);
  const double half = 0.95;
  for (const auto& [x, height] : {std::pair(4.0, 0.0), std::pair(20.0, 1.425), std::pair(30.0, -5.0)}) {
    Tooled d(ViewOptions{}, false, building);
    d.session->roamer().setMode(Mode::fly);
    ASSERT_TRUE(click_on_plan(d, x, 0.0));
    EXPECT_FALSE(contains(d.hud(), "There is no floor")) << d.hud();
    d.run(12.0);
    if (x == 30.0) continue;  // the end of the gallery is in its straight way
    EXPECT_NEAR(d.place().x, x, 1.0);
    EXPECT_NEAR(d.place().z, height + half, 0.2);
  }
  Tooled d(ViewOptions{}, false, building);
  ASSERT_TRUE(click_on_plan(d, 10.0, 6.0));
  EXPECT_TRUE(contains(d.hud(), "There is no floor there")) << d.hud();
}

TEST(Tools, SayThatThereIsNoRoomOnWhatIsClickedOnThePlan) {
  Tooled d(ViewOptions{}, false, floor_obj("floor", 0.0, 0.0, 14.0, 0.0) + floor_obj("cliff", 14.0, 0.0, 40.0, 60.0));
  ASSERT_TRUE(click_on_plan(d, 20.0, 0.0));
  EXPECT_TRUE(contains(d.hud(), "There is no floor with room for the body there")) << d.hud();
}

TEST(Tools, DrawTheLargePlanNoFartherThanTheSceneReaches) {
  Tooled d;  // in a corridor of 20 m
  d.tap('l');
  d.tap('l');
  d.run(0.1);
  d.session->stage().draw();
  double left = 1e9, right = -1e9;
  for (double x = -1.0; x < 1.0; x += 0.002) {
    const auto at = d.session->tools().plan().at(x, 0.0);
    if (!at) continue;
    left = std::min(left, at->x);
    right = std::max(right, at->x);
  }
  EXPECT_NEAR(right - left, 40.0, 1.0);
}

TEST(Tools, DrawThePlanBesideThePictureOnly) {
  Tooled d;
  d.tap('l');
  ASSERT_TRUE(d.until([&] { return !d.session->tools().plan().walls().empty(); }));
  d.run(0.1);
  const std::string with = d.folder.file("with.png"), without = d.folder.file("without.png");
  d.session->stage().draw_picture(with, true);
  d.session->stage().draw_picture(without);
  const auto white = [](const Shot& shot) {
    int count = 0;
    for (int y = 0; y < shot.height(); ++y) {
      for (int x = 0; x < shot.width(); ++x) {
        const osg::Vec4 c = shot.at(x, y);
        count += c.r() > 0.9f && c.g() > 0.9f && c.b() > 0.9f;
      }
    }
    return count;
  };
  EXPECT_GT(white(Shot(with)), white(Shot(without)) + 300);
}

}  // namespace
