// A body and what is not known yet: it waits, it goes on by itself, and it is never caught or let through.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>
#include <thread>

#include "roam/patchwork.h"
#include "roam/route.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Box;
using roam::PatchId;
using roam::Patchwork;

constexpr double reach_of_skin = 0.01;  // metres: skin, margin and storing

/// Two rooms without a wall between them, each 10 m by 10 m by 3 m, side by side along x.
struct TwoRooms {
  Patchwork space;
  PatchId near = space.expect(box(0.0)), far = space.expect(box(10.0));

  static Box box(double x) { return {{x, -5.0, 0.0}, {x + 10.0, 5.0, 3.0}}; }
  static World room(double x) {
    Mesh m;
    m.name = "floor";
    add_floor(m, x, -5.0, x + 10.0, 5.0, 0.0);
    return build(m);
  }
  TwoRooms() {
    space.deliver(near, room(0.0));
    space.update();
  }
  void update(const Walker& w) { space.update(w.body(), w.position()); }
};

TEST(WalkerUnknown, WaitsBeforeItAsBeforeAWallAndGoesOnWhenItIsThere) {
  for (const Mode mode : {Mode::fly, Mode::walk}) {
    TwoRooms rooms;
    Walker w(rooms.space, {}, mode, {5.0, 0.0, 1.0});
    EXPECT_FALSE(w.report().met_unknown);
    for (int i = 0; i < 240; ++i) w.step({{3.0, 0.0, 0.0}}, frame);
    EXPECT_TRUE(w.report().met_unknown);
    EXPECT_TRUE(w.report().has(EventKind::met_unknown));
    EXPECT_TRUE(w.report().blocked);
    EXPECT_FALSE(w.held());
    ASSERT_FALSE(w.report().contacts.empty());
    EXPECT_TRUE(w.report().contacts.back().unknown);
    EXPECT_EQ(rooms.space.object_name(w.report().contacts.back().triangle), "not loaded yet");
    EXPECT_NEAR(w.position().x, 10.0 - 0.3, reach_of_skin);
    EXPECT_LT(w.position().x, 10.0 - 0.3);
    rooms.space.deliver(rooms.far, TwoRooms::room(10.0));
    rooms.update(w);
    for (int i = 0; i < 60; ++i) {
      w.step({{3.0, 0.0, 0.0}}, frame);
      EXPECT_FALSE(w.report().met_unknown);
    }
    EXPECT_NEAR(w.position().x, 12.7, 0.02);
  }
}

TEST(WalkerUnknown, AStrideThatIsTakenBackHasMetNothing) {
  Patchwork space;
  Mesh m;
  add_floor(m, -5.0, -5.0, 0.0, 5.0, 0.0);
  add_floor(m, -5.0, -5.0, 8.0, 5.0, -2.5);
  space.deliver(space.expect({{-5.0, -5.0, -3.0}, {8.0, 5.0, 0.0}}), build(m));
  // Beyond the edge, so low that a long stride reaches it and a body that rolls off the edge falls below it.
  (void)space.expect({{0.65, -5.0, 1.32}, {1.15, 5.0, 3.0}});
  space.update();
  for (int i = 0; i < 10; ++i) {
    Walker w(space, {}, Mode::walk, {-0.7 + 0.02 * i, 0.0, 0.95});
    for (int step = 0; step < 20; ++step) {
      const auto& report = w.step({{3.0, 0.0, 0.0}}, 0.1);
      const bool touched =
          std::any_of(report.contacts.begin(), report.contacts.end(), [](const auto& c) { return c.unknown; });
      EXPECT_EQ(report.met_unknown, touched) << i << ", step " << step;
    }
    EXPECT_NEAR(w.feet().z, -2.5, reach_of_skin) << "it fell past it";
  }
}

TEST(WalkerUnknown, SlidesAlongItAndSaysSo) {
  TwoRooms rooms;
  Walker w(rooms.space, {}, Mode::walk, {9.0, 0.0, 1.0});
  for (int i = 0; i < 60; ++i) w.step({{2.0, 1.0, 0.0}}, frame);
  EXPECT_TRUE(w.report().met_unknown);
  EXPECT_FALSE(w.report().blocked);
  EXPECT_NEAR(w.position().y, 1.0, 0.05);
}

TEST(WalkerUnknown, WhatFailedStaysSolid) {
  TwoRooms rooms;
  rooms.space.fail(rooms.far, "the tile is missing");
  Walker w(rooms.space, {}, Mode::walk, {9.0, 0.0, 1.0});
  for (int i = 0; i < 60; ++i) {
    rooms.update(w);
    w.step({{3.0, 0.0, 0.0}}, frame);
  }
  EXPECT_TRUE(w.report().met_unknown);
  EXPECT_EQ(rooms.space.object_name(w.report().contacts.back().triangle), "the tile is missing");
}

TEST(WalkerUnknown, HoldsABodyThatIsInItAndLetsItGoByItself) {
  for (const Mode mode : {Mode::fly, Mode::walk}) {
    TwoRooms rooms;
    Walker w(rooms.space, {}, mode, {15.0, 0.0, 1.0});
    for (int i = 0; i < 10; ++i) {
      rooms.update(w);
      w.step({{3.0, 0.0, 0.0}}, frame);
      EXPECT_TRUE(w.held());
      EXPECT_TRUE(w.report().held && w.report().met_unknown);
      EXPECT_EQ(w.report().axis_clearance, 0.0);
      EXPECT_EQ(w.position(), Vec3(15.0, 0.0, 1.0));
    }
    rooms.space.deliver(rooms.far, TwoRooms::room(10.0));
    rooms.update(w);
    for (int i = 0; i < 60; ++i) w.step({{3.0, 0.0, 0.0}}, frame);
    EXPECT_FALSE(w.held() || w.report().met_unknown);
    EXPECT_NEAR(w.position().x, 18.0, 0.02);
    EXPECT_EQ(w.grounded(), mode == Mode::walk);
  }
}

TEST(WalkerUnknown, ABodyLetGoInAWallIsFreedAsIfItHadBeenPutThere) {
  Patchwork space;
  const PatchId patch = space.expect({{-5.0, -5.0, -1.0}, {5.0, 5.0, 4.0}});
  space.update();
  Walker w(space, {}, Mode::walk, {0.15, 0.0, 0.95});
  EXPECT_TRUE(w.held());
  Mesh m;
  add_floor(m, -5.0, -5.0, 5.0, 5.0, 0.0);
  add_wall(m, 0.0, -5.0, 0.0, 5.0, 0.0, 3.0);
  space.deliver(patch, build(m));
  space.update(w.body(), w.position());
  w.step({}, frame);
  EXPECT_FALSE(w.held());
  EXPECT_TRUE(w.report().has(EventKind::freed));
  EXPECT_NEAR(w.position().x, 0.3, reach_of_skin);
}

TEST(WalkerUnknown, ABodyLetGoUnderALowCeilingCrouches) {
  Patchwork space;
  const PatchId patch = space.expect({{-5.0, -5.0, -1.0}, {5.0, 5.0, 4.0}});
  space.update();
  Walker w(space, {}, Mode::walk, {0.0, 0.0, 0.92});
  Mesh m;
  add_floor(m, -5.0, -5.0, 5.0, 5.0, 0.0);
  add_floor(m, -5.0, -5.0, 5.0, 5.0, 1.3);
  space.deliver(patch, build(m));
  space.update(w.body(), w.position());
  w.step({}, frame);
  EXPECT_FALSE(w.held());
  EXPECT_TRUE(w.crouched());
}

TEST(WalkerUnknown, ABodyLetGoOverNothingIsPutBackToWhereItWasLetGo) {
  TwoRooms rooms;
  Walker w(rooms.space, {}, Mode::walk, {15.0, 0.0, 1.0});
  rooms.space.deliver(rooms.far, World());
  rooms.update(w);
  bool back = false;
  for (int i = 0; i < 600 && !back; ++i) back = w.step({}, frame).held;
  EXPECT_TRUE(back);
  EXPECT_EQ(w.position(), Vec3(15.0, 0.0, 1.0));
  EXPECT_EQ(w.report().height, 1.8);
}

TEST(WalkerUnknown, WhoIsHeldOverNothingFallsWhenGroundComes) {
  TwoRooms rooms;
  rooms.space.deliver(rooms.far, World());
  rooms.space.update();
  Walker w(rooms.space, {}, Mode::walk, {15.0, 0.0, 1.0});
  for (int i = 0; i < 300; ++i) w.step({}, frame);
  ASSERT_TRUE(w.held());
  const PatchId late = rooms.space.expect({{10.0, -5.0, -1.0}, {20.0, 5.0, 0.5}});
  Mesh m;
  add_floor(m, 10.0, -5.0, 20.0, 5.0, 0.0);
  rooms.space.deliver(late, build(m));
  rooms.update(w);
  for (int i = 0; i < 60; ++i) w.step({}, frame);
  EXPECT_FALSE(w.held());
  EXPECT_TRUE(w.grounded());
}

TEST(WalkerUnknown, ARouteIsHeldByWhatNobodyUpdatesAndGoesOnWhereItUpdatesItself) {
  const std::vector<Vec3> path{{5.0, 0.0, 1.0}, {15.0, 0.0, 1.0}};
  for (const bool live : {false, true}) {
    TwoRooms rooms;
    Walker w(rooms.space, {}, Mode::walk, path[0]);
    rooms.space.deliver(rooms.far, TwoRooms::room(10.0));
    const roam::RouteResult r = live ? roam::follow(w, rooms.space, path) : roam::follow(w, path);
    EXPECT_EQ(r.outcome, live ? roam::Outcome::reached : roam::Outcome::held);
  }
}

TEST(WalkerUnknown, ARouteWaitsForWhatComesLaterAndNotForEverForWhatDoesNot) {
  const std::vector<Vec3> path{{5.0, 0.0, 1.0}, {15.0, 0.0, 1.0}};
  for (const bool comes : {true, false}) {
    TwoRooms rooms;
    Walker w(rooms.space, {}, Mode::walk, path[0]);
    std::jthread loader([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(200));
      if (comes) rooms.space.deliver(rooms.far, TwoRooms::room(10.0));
    });
    const roam::RouteResult r = roam::follow(w, rooms.space, path, {.wait = comes ? 60.0 : 0.05});
    EXPECT_EQ(r.outcome, comes ? roam::Outcome::reached : roam::Outcome::held);
    EXPECT_TRUE(comes || r.end.x > 9.5) << r.end.x;
  }
}

TEST(WalkerUnknown, ARouteThatBeginsInItWaitsThereToo) {
  TwoRooms rooms;
  Walker w(rooms.space, {}, Mode::walk, {5.0, 0.0, 1.0});
  std::jthread loader([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    rooms.space.deliver(rooms.far, TwoRooms::room(10.0));
  });
  const std::vector<Vec3> path{{15.0, 0.0, 1.0}, {5.0, 0.0, 1.0}};
  EXPECT_EQ(roam::follow(w, rooms.space, path, {.wait = 60.0}).outcome, roam::Outcome::reached);
}

TEST(WalkerUnknown, ARouteUpdatesNoSpaceButTheWalkersOwn) {
  TwoRooms rooms, other;
  Walker w(rooms.space, {}, Mode::walk, {5.0, 0.0, 1.0});
  const std::vector<Vec3> path{{5.0, 0.0, 1.0}, {6.0, 0.0, 1.0}};
  EXPECT_THROW((void)roam::follow(w, other.space, path), roam::Error);
  EXPECT_THROW((void)roam::follow(w, rooms.space, path, {.wait = -1.0}), roam::Error);
  EXPECT_THROW((void)roam::follow(w, rooms.space, {}), roam::Error);
}

TEST(WalkerUnknown, StandsOnItWaitingAndComesDownWhenTheGroundIsThere) {
  TwoRooms rooms;
  Walker w(rooms.space, {}, Mode::walk, {15.0, 0.0, 4.0});
  for (int i = 0; i < 10; ++i) w.step({}, frame);
  EXPECT_TRUE(w.grounded());
  EXPECT_TRUE(w.report().met_unknown);
  EXPECT_NEAR(w.feet().z, 3.0, reach_of_skin);
  rooms.space.deliver(rooms.far, TwoRooms::room(10.0));
  rooms.update(w);
  for (int i = 0; i < 90; ++i) w.step({}, frame);
  EXPECT_TRUE(w.grounded());
  EXPECT_FALSE(w.report().met_unknown);
  EXPECT_NEAR(w.feet().z, 0.0, reach_of_skin);
}

TEST(WalkerUnknown, ABodyAtRestWhereSomethingNewIsExpectedIsHeldAndSaysNoClearance) {
  TwoRooms rooms;
  Walker w(rooms.space, {}, Mode::walk, {5.0, 0.0, 1.0});
  w.step({}, frame);
  EXPECT_GT(w.report().axis_clearance, 0.0);
  const PatchId late = rooms.space.expect({{4.0, -1.0, -1.0}, {6.0, 1.0, 3.0}});
  rooms.update(w);
  w.step({}, frame);
  EXPECT_TRUE(w.held() && w.report().met_unknown);
  EXPECT_EQ(w.report().axis_clearance, 0.0);
  rooms.space.deliver(late, World());
  rooms.update(w);
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_FALSE(w.held());
  EXPECT_NEAR(w.position().x, 6.0, 0.02);
}

TEST(WalkerUnknown, ACrouchedBodyThatWaitsStaysLow) {
  Patchwork space;
  space.deliver(space.expect({{-20.0, -10.0, -1.0}, {20.0, 10.0, 4.0}}), build(low_passage(1.2)));
  space.update();
  Walker w(space, {}, Mode::walk, {2.5, 0.0, 0.92});
  ASSERT_TRUE(w.crouched());
  const double low = w.report().height;
  (void)space.expect({{2.0, -1.0, -1.0}, {3.0, 1.0, 3.0}});
  space.update(w.body(), w.position());
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(w.step({}, frame).height, low) << i;
    EXPECT_TRUE(w.held() && w.report().met_unknown);
  }
}

TEST(WalkerUnknown, ABodyHeldByAWallLooksForAWayOutWhenTheSpaceChanges) {
  Patchwork space;
  const Box where{{-5.0, -5.0, -1.0}, {5.0, 5.0, 4.0}};
  const PatchId coarse = space.expect(where), fine = space.expect(where, coarse);
  Mesh m;
  add_floor(m, -5.0, -5.0, 5.0, 5.0, 0.0);
  const World floor = build(m);
  add_wall(m, 0.0, -5.0, 0.0, 5.0, 0.0, 3.0);
  space.deliver(coarse, build(m));
  space.update();
  Walker w(space, {}, Mode::walk, {0.0, 0.0, 0.95});
  w.step({}, frame);
  EXPECT_TRUE(w.held());
  EXPECT_FALSE(w.report().met_unknown);
  Mesh open;
  add_floor(open, -5.0, -5.0, 5.0, 5.0, 0.0);
  space.deliver(fine, build(open));
  EXPECT_TRUE(space.update(w.body(), w.position()));
  w.step({{1.0, 0.0, 0.0}}, 1.0);
  EXPECT_FALSE(w.held());
  EXPECT_NEAR(w.position().x, 1.0, 0.02);
}

TEST(WalkerUnknown, AGhostPassesItAndComesBackOutOfIt) {
  TwoRooms rooms;
  Walker w(rooms.space, {}, Mode::walk, {9.0, 0.0, 1.0});
  const Vec3 stood = w.position();
  w.set_mode(Mode::ghost);
  for (int i = 0; i < 60; ++i) w.step({{6.0, 0.0, 0.0}}, frame);
  EXPECT_NEAR(w.position().x, 15.0, 1e-9);
  w.set_mode(Mode::walk);
  EXPECT_TRUE(w.report().has(EventKind::returned));
  EXPECT_FALSE(w.held());
  EXPECT_NEAR(w.position().x, 9.6, 0.2);  // the last place on its way where it fitted
  EXPECT_NEAR(w.position().z, stood.z, reach_of_skin);
}

TEST(WalkerUnknown, ABodyPutBackToWhereAWallHasComeMeanwhileIsFreed) {
  TwoRooms rooms;
  rooms.space.deliver(rooms.far, World());
  rooms.space.update();
  Walker w(rooms.space, {}, Mode::walk, {9.0, 0.0, 1.0});
  Vec3 stood = w.position();
  for (int i = 0; i < 240 && (i == 0 || w.grounded()); ++i) {
    stood = w.position();
    w.step({{3.0, 0.0, 0.0}}, frame);
  }
  ASSERT_FALSE(w.grounded());
  Mesh wall;
  add_wall(wall, stood.x + 0.2, -5.0, stood.x + 0.2, 5.0, 1.0, 3.0);
  rooms.space.deliver(rooms.space.expect({{stood.x + 0.1, -5.0, 1.0}, {stood.x + 0.3, 5.0, 3.0}}), build(wall));
  for (int i = 0; i < 240 && !w.report().put_back; ++i) {
    if (w.position().z < -0.3) rooms.update(w);  // past it
    w.step({}, frame);
  }
  ASSERT_TRUE(w.report().put_back);
  EXPECT_TRUE(w.report().has(EventKind::freed));
  EXPECT_FALSE(w.held());
  EXPECT_GE(w.report().axis_clearance, w.settings().radius - 1e-6);
  EXPECT_NEAR(w.position().x, stood.x, 0.5);
}

TEST(WalkerUnknown, ASafePlaceThatIsNoLongerFreeIsNotCalledSo) {
  Patchwork space;
  Walker w(space, ball(0.3), Mode::fly, {0.0, 0.0, 0.0});
  w.set_mode(Mode::ghost);
  // All about is unknown now, the place that the ghost started from as well.
  (void)space.expect({{-50.0, -50.0, -50.0}, {50.0, 50.0, 50.0}});
  space.update(w.body(), w.position());
  w.step({{5.0, 0.0, 0.0}}, 1.0);
  w.set_mode(Mode::fly);
  EXPECT_TRUE(w.held());
  EXPECT_TRUE(w.report().met_unknown);
  EXPECT_EQ(w.report().axis_clearance, 0.0);
}

}  // namespace
