// The tools of roam view: measuring, the plan.
#include <fmt/format.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "roam/error.h"
#include "view/plan_scan.h"
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

// ----------------------------------------------------------------------------------------------------------- plan

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

TEST(Probing, FindsAWayBetweenMeasuredPoints) {
  Tooled d;
  d.tap('i');
  EXPECT_TRUE(contains(d.hud(), "First press T and click where to go, or start and end; then press I")) << d.hud();
  d.tap('t');
  d.tap('i');
  EXPECT_TRUE(contains(d.hud(), "First click where to go, or start and end; then press I")) << "T is on: " << d.hud();
  d.click(-0.5, -0.9);
  d.tap('i');
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), "probe: YES: a body 0.60 m wide"); }))
      << "from the body: " << d.hud();
  EXPECT_TRUE(contains(d.hud(), "A: the body's place")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "narrowest: ")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "way: ") && contains(d.hud(), " m long")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "at A: on the floor at (10.00, 0.00, 0.00)\n")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "at B: not moved: on the floor at ")) << d.hud();
  d.click(0.3, -0.9);
  EXPECT_FALSE(contains(d.hud(), "YES")) << "that was of another question: " << d.hud();
  d.tap('i');
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), "probe: YES: a body 0.60 m wide"); })) << "to B: " << d.hud();
  const ViewReport report = d.finish();
  ASSERT_EQ(report.probes.size(), 2u);
  EXPECT_LT(glm::distance(report.probes[0].from, {10, 0, 0}), 0.01) << "the body's feet";
  EXPECT_LT(glm::distance(report.probes[1].from, report.probes[0].to), 1e-9);
  EXPECT_TRUE(report.probes[1].passable);
  EXPECT_GE(report.probes[1].way.size(), 2u);
  EXPECT_EQ(json_report(report)["probes"][1]["passable"], true);
}

TEST(Probing, SaysThatItsSearchHasEnded) {
  Tooled d;
  d.session.reset();
  const std::string program = d.folder.write("roam", "#!/bin/sh\nexec sleep 1000\n");
  std::filesystem::permissions(program, std::filesystem::perms::owner_all);
  d.options.program = program;
  d.begin();
  d.tap('t');
  d.click(-0.5, -0.9);
  d.tap('i');
  EXPECT_TRUE(contains(d.hud(), "probe: searching")) << d.hud();
  d.tap('x');
  EXPECT_TRUE(contains(d.hud(), "probe: searching")) << "beside a section it goes on: " << d.hud();
  d.tap('x');
  d.tap('t');
  EXPECT_FALSE(contains(d.hud(), "searching")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "The search for a way was stopped")) << d.hud();
  d.click(-0.2, -0.9);
  d.tap('i');
  d.tap('t');
  EXPECT_TRUE(contains(d.hud(), "Measuring has ended; the search for a way was stopped")) << d.hud();
  d.tap('t');
  d.click(0.1, -0.9);
  d.tap('i');
  d.click(0.4, -0.9);
  EXPECT_TRUE(contains(d.hud(), "The search for a way was stopped: this is another point")) << d.hud();
}

TEST(Probing, StandsInFrontOfAClickedWall) {
  Tooled d;
  d.tap('t');
  d.click(0, 0);
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), ", front, wall facing 270\u00b0 (W)"); })) << d.hud();
  d.tap('i');
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), "probe: YES: a body 0.60 m wide"); })) << d.hud();
  const ViewReport report = d.finish();
  ASSERT_EQ(report.probes.size(), 1u);
  EXPECT_NEAR(report.probes[0].to.x, 20.0 - 0.35, 1e-2);
  EXPECT_TRUE(contains(d.hud(), "at B: moved 0.35 m from the click: on the floor at ")) << d.hud();
}

TEST(Probing, ShowsTheWordsOfTheAnswerWhereABodyIsStopped) {
  // A wall across the room at x = 15, with a door 0.5 m wide.
  const std::string wall =
      "v 15 -2 0\nv 15 -0.25 0\nv 15 -0.25 3\nv 15 -2 3\nv 15 0.25 0\nv 15 2 0\nv 15 2 3\nv 15 0.25 3\n"
      "o wall\nf 9 10 11 12\nf 13 14 15 16\n";
  Tooled d(app::ViewOptions{}, false, room_obj() + wall);
  d.tap('t');
  d.click(0, -0.3);
  d.tap('i');
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), "probe: NO: a body 0.60 m wide"); })) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "stopped by: door 0.500 m wide")) << d.hud();
  EXPECT_TRUE(contains(d.hud(), "would pass: up to 0.499 m wide")) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "certainty")) << d.hud();
  d.run(0.1);
  EXPECT_TRUE(contains(d.hud() + "\n", "\ndoor 0.500 m wide\n")) << "at its place: " << d.hud();
  const ViewReport report = d.finish();
  ASSERT_EQ(report.probes.size(), 1u);
  const ProbedWay way = way_of(report.probes[0]);
  ASSERT_TRUE(way.open.size() >= 2 && way.barred.size() >= 2);
  EXPECT_NEAR(way.open.back().x, 15.0, 0.05) << "up to the door, and beyond it";
  EXPECT_EQ(way.open.back(), way.barred.front());
  EXPECT_EQ(way.barred.back(), report.probes[0].target);
}

TEST(Probing, SaysWhyThereIsNoWay) {
  Tooled d;
  d.tap('t');
  d.click(0, 0.9);  // the ceiling, from above which nobody comes
  d.tap('i');
  ASSERT_TRUE(d.until([&] { return contains(d.hud(), "probe: ") && !contains(d.hud(), "searching"); })) << d.hud();
  EXPECT_FALSE(contains(d.hud(), "YES")) << d.hud();
}

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

TEST(Pictures, AreDrawnThoughTheSessionEndsInTheSameFrame) {
  Tooled d;
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(d.folder.file(""));
  d.press('p');
  d.session->run("quit");
  EXPECT_FALSE(d.session->frame());
  EXPECT_NO_THROW(static_cast<void>(d.finish()));
  std::filesystem::current_path(before);
  EXPECT_TRUE(std::filesystem::exists(d.folder.file("roam-1.png")));
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
