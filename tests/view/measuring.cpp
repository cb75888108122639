// Measuring, and what is hidden for it.
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "view_tooled.h"

namespace {

using namespace roam;
using namespace roam::app;
using view_stores::Tooled;

TEST(Tools, MeasureBetweenClickedPoints) {
  for (const bool on_store : {false, true}) {
    Tooled d(on_store);
    d.tap('t');
    EXPECT_TRUE(contains(d.hud(), "Measuring: click two points; T ends")) << d.hud();
    EXPECT_TRUE(contains(d.hud(), "clear: 4.00 m wide, 3.00 m high")) << d.hud();
    d.click(0, 0);
    ASSERT_TRUE(d.until([&] { return contains(d.hud(), ", front, wall facing 270\u00b0 (W)"); })) << d.hud();
    d.click(0, -0.9);
    ASSERT_TRUE(d.until([&] { return contains(d.hud(), ", floor, slope 0"); })) << d.hud();
    EXPECT_TRUE(contains(d.hud(), "A to B: ")) << d.hud();
    const std::vector<Measurement> all = d.measured();
    ASSERT_EQ(all.size(), 1u);
    const Pick &a = all[0].a, &b = *all[0].b;
    EXPECT_NEAR(a.point.x, 20.0, 2e-3);
    EXPECT_NEAR(a.point.y, 0.0, 1e-3);
    EXPECT_NEAR(a.point.z, 1.5, 0.05) << "the height of the eye";
    EXPECT_NEAR(a.normal.x, -1.0, 1e-3);
    EXPECT_NEAR(b.point.z, 0.0, 2e-3);
    // The eye looks down by the angle of that point.
    const double down = std::atan(0.9 * std::tan(glm::radians(32.5)));
    EXPECT_NEAR(b.point.x, 10.0 + a.point.z / std::tan(down), 0.05);
    const Span span = span_of(a.point, b.point);
    EXPECT_NEAR(span.distance, glm::distance(a.point, b.point), 1e-9);
    EXPECT_NEAR(span.height, b.point.z - a.point.z, 1e-9);
    EXPECT_LT(span.slope_degrees, 0.0);
  }
}

TEST(Tools, SayWhatAClickedSurfaceIs) {
  const double c = std::cos(glm::radians(3.0)), s = std::sin(glm::radians(3.0)), d = std::sqrt(0.5);
  EXPECT_EQ(surface_text({0, 0, 1}), "floor, slope 0\u00b0");
  EXPECT_EQ(surface_text({s, 0, c}), "floor, slope 3\u00b0");
  EXPECT_EQ(surface_text({s, 0, -c}), "ceiling, slope 3\u00b0");
  EXPECT_EQ(surface_text({0, 1, 0}), "wall facing 0\u00b0 (N)");
  EXPECT_EQ(surface_text({d, -d, 0}), "wall facing 135\u00b0 (SE)");
  EXPECT_EQ(surface_text({-c, 0, s}), "wall facing 270\u00b0 (W), slope 87\u00b0");
  EXPECT_EQ(surface_text({0, -c, -s}), "wall facing 180\u00b0 (S), overhanging, slope 87\u00b0");
}

TEST(Tools, NameTheSiteOfAPoint) {
  Tooled d;
  d.session.reset();
  d.options.origin = {512'000.0, 5'403'000.0, 400.0};
  d.begin();
  d.tap('t');
  d.click(0, 0);
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), ", front, wall facing "); })) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "site: 512020.00, 5403000.00, 401.")) << d.hud();
}

TEST(Tools, GiveMeasurementsInTheReport) {
  Tooled d;
  d.tap('t');
  d.click(0, 0);
  d.click(0.5, 0);
  d.click(0, 0);
  const Json json = json_report(d.finish());
  ASSERT_EQ(json["measurements"].size(), 2u);
  const Json& first = json["measurements"][0];
  EXPECT_EQ(first["a"]["object"], "front");
  EXPECT_NEAR(first["a"]["point"][0], 20.0, 2e-3);
  EXPECT_GT(first["distance_m"], 0.1);
  EXPECT_TRUE(json["measurements"][1]["b"].is_null());
}

TEST(Tools, LeaveTheBodyWhereItIsWhileMeasuring) {
  Tooled d;
  const Vec3 before = d.place();
  d.tap('t');
  d.click(0, 0, 2);
  d.run(2.0);
  EXPECT_LT(glm::distance(d.place(), before), 1e-3);
  d.tap('t');
  d.run(1.0);
  d.click(0, 0, 2);
  d.run(2.0);
  EXPECT_GT(glm::distance(d.place(), before), 1.0) << "without the tool a double click goes there";
  EXPECT_EQ(d.measured().size(), 1u);
}

TEST(Tools, GoToNothingThatIsHidden) {
  ViewOptions hidden, cut;
  hidden.hide = {"front"};
  cut.section = {"x<15"};
  for (const ViewOptions& options : {hidden, cut}) {
    Tooled d(options);
    const Vec3 before = d.place();
    d.click(0, 0, 2);
    d.run(2.0);
    EXPECT_LT(glm::distance(d.place(), before), 1e-3);
  }
}

TEST(Section, LeavesTheHeightButHidesTheObjectAhead) {
  Tooled d;
  d.run(0.5);
  ASSERT_TRUE(contains(d.hud(), "ahead") && contains(d.hud(), "on the floor")) << d.hud();
  d.tap('x');
  d.click(0, -0.9);
  d.run(0.5);
  EXPECT_TRUE(contains(d.hud(), "on the floor")) << "hidden, but the body stands on it: " << d.hud();
  EXPECT_FALSE(contains(d.hud(), "ahead")) << "the foot of the wall is seen, but not before the eye: " << d.hud();
}

TEST(Tools, BringTheDisplayBackForWhatItShows) {
  Tooled d;
  auto& stage = d.session->stage();
  stage.set_hud(HudMode::off);
  d.tap('v');
  EXPECT_EQ(stage.hud().detail(), graphics::Detail::off);
  d.tap('h');
  EXPECT_TRUE(contains(d.hud(), "shows or hides this menu")) << d.hud();
  d.tap('h');
  stage.set_hud(HudMode::off);
  d.session->run("layers");
  d.run(0.1);
  EXPECT_TRUE(contains(d.hud(), "Objects: ")) << d.hud();
  d.session->run("layers");
  d.tap('t');
  // A tool that is on already is shown again, not ended; in one line there is no room for it.
  for (const HudMode mode : {HudMode::off, HudMode::minimal}) {
    stage.set_hud(mode);
    d.tap('t');
    EXPECT_TRUE(contains(d.hud(), "clear: ")) << d.hud();
    stage.set_hud(mode);
    d.session->run("probe");
    EXPECT_TRUE(contains(d.hud(), "clear: ")) << d.hud();
  }
  stage.set_hud(HudMode::minimal);
  d.session->run("plan");
  EXPECT_EQ(stage.hud().detail(), graphics::Detail::minimal) << "which shows the plan";
}

TEST(Tools, LetTheKeysGoWithTheDisplay) {
  Tooled d;
  auto& hud = d.session->stage().hud();
  const auto switch_off = [&] {
    for (int i = 0; i < 4 && hud.detail() != graphics::Detail::off; ++i) d.tap(osgGA::GUIEventAdapter::KEY_F1);
  };
  d.session->run("layers");
  switch_off();
  const double before = d.place().x;
  d.press('w');
  d.run(1.0);
  d.release('w');
  EXPECT_GT(d.place().x, before + 0.5) << "a list that nobody sees takes no letters";
  d.tap('h');
  ASSERT_TRUE(hud.help_shown());
  switch_off();
  EXPECT_FALSE(hud.help_shown()) << "nor does the help take the mouse";
  const double speed = d.session->roamer().speed();
  d.events().mouseScroll(osgGA::GUIEventAdapter::SCROLL_UP);
  d.run(0.1);
  EXPECT_GT(d.session->roamer().speed(), speed);
}

TEST(Tools, DrawTheMeasuredLine) {
  Tooled d;
  d.tap('t');
  d.click(-0.5, -0.5);
  d.click(0.5, -0.5);
  const std::string shot = d.folder.file("line.png");
  d.session->stage().draw_picture(shot);
  const Shot picture(shot);
  int purple = 0;
  for (int y = 0; y < picture.height(); ++y) {
    for (int x = 0; x < picture.width(); ++x) {
      const osg::Vec4 c = picture.at(x, y);
      purple += c.r() > c.g() + 0.25f && c.b() > c.g() + 0.15f;
    }
  }
  EXPECT_GT(purple, 50);
}

}  // namespace
