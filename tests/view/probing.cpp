// Probing between measured points.
#include <glm/geometric.hpp>

#include "view_tooled.h"

namespace {

using namespace roam;
using namespace roam::app;
using view_stores::Tooled;

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

}  // namespace
