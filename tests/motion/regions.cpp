// A body that has another size in some regions: where it changes, where it must not, and that it never violates.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "roam/error.h"
#include "roam/route.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::SizeRegion;

constexpr std::array speeds{0.4, 1.4, 7.0, 50.0};
constexpr std::array steps{1.0 / 240.0, 1.0 / 60.0, 1.0 / 25.0};

/// A wall at x = 1 to 1.2 with a doorway about y = 0.
Mesh doorway(double width) {
  Mesh m = floor_mesh();
  const double half = 0.5 * width;
  add_box(m, {1.0, -5.0, -0.1}, {1.2, -half, 2.5});
  add_box(m, {1.0, half, -0.1}, {1.2, 5.0, 2.5});
  return m;
}

WalkerSettings person(double radius, double support_radius = 0.0) {
  WalkerSettings s;
  s.radius = radius;
  s.support_radius = support_radius;
  return s;
}

SizeRegion around_door(double radius, double support_radius = 0.0) {
  return {{Vec3(0.4, -0.6, -0.5), Vec3(1.8, 0.6, 3.0)}, radius, support_radius, "door"};
}

/// A walk in regions of which every step is judged, and whose eye must not jump.
struct Roam {
  World world;
  Judge judge;
  Walker walker;
  std::array<int, 32> events{};
  double worst_eye = 0.0;  ///< what the eye rose or sank beside its lowest point, metres

  Roam(const Mesh& scene, const WalkerSettings& settings, Mode mode, const Vec3& start,
       std::span<const SizeRegion> regions)
      : world(build(scene)), judge(scene), walker(world, settings, mode, start) {
    walker.set_regions(regions);
  }

  const StepReport& step(const Vec3& velocity, double dt = frame) {
    const bool crouched = walker.crouched();
    const double eye = walker.eye().z - walker.feet().z;
    const StepReport& r = walker.step({velocity}, dt);
    EXPECT_GE(margin(judge, r), 0.0);
    if (crouched == walker.crouched()) {
      worst_eye = std::max(worst_eye, std::abs(walker.eye().z - walker.feet().z - eye));
    }
    for (const roam::Event& e : r.events) ++events[static_cast<std::size_t>(e.kind)];
    return r;
  }
  [[nodiscard]] int count(EventKind kind) const { return events[static_cast<std::size_t>(kind)]; }
};

TEST(Regions, LetABodyThroughADoorThatOnlyASmallerOnePassesAtAnySpeed) {
  const Mesh m = doorway(0.6);
  const SizeRegion door = around_door(0.28);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double speed : speeds) {
      for (const double dt : steps) {
        Roam r(m, person(0.4), mode, {-2.0, 0.05, 0.95}, {&door, 1});
        for (int i = 0; i < 5000 && r.walker.position().x < 3.0; ++i) {
          const Vec3 way = Vec3(4.0, 0.0, r.walker.position().z) - r.walker.position();
          r.step(way * (speed / glm::length(way)), dt);
        }
        EXPECT_GE(r.walker.position().x, 3.0) << speed << " " << dt;
        EXPECT_EQ(r.count(EventKind::narrowed), 1) << speed << " " << dt;
        EXPECT_EQ(r.walker.body().radius, 0.4);
        EXPECT_EQ(r.count(EventKind::widened), 1);
        EXPECT_LT(r.worst_eye, 1e-12);
      }
    }
    Roam r(m, person(0.4), mode, {-2.0, 0.05, 0.95}, {});
    for (int i = 0; i < 300; ++i) r.step({1.4, 0.0, 0.0});
    EXPECT_LT(r.walker.position().x, 1.0);
  }
}

TEST(Regions, AreLeftFiveCentimetresOutside) {
  const Mesh m = floor_mesh();
  const SizeRegion region{{Vec3(-1.0, -5.0, -1.0), Vec3(1.0, 5.0, 3.0)}, 0.2, 0.0, ""};
  Roam r(m, person(0.3), Mode::walk, {-2.0, 0.0, 0.95}, {&region, 1});
  bool before = false;
  for (int i = 0; i < 2000 && r.walker.position().x < 2.0; ++i) {
    r.step({0.1, 0.0, 0.0}, 0.1);
    const double x = r.walker.position().x;
    if (x < -1.01 || x > 1.07) {
      EXPECT_EQ(r.walker.body().radius, 0.3) << x;
    }
    if (x > -0.98 && x < 1.04) {
      EXPECT_EQ(r.walker.body().radius, 0.2) << x;
    }
    before = before || x > 1.0;
  }
  EXPECT_TRUE(before);
  // To and fro over the border: one change.
  Roam fro(m, person(0.3), Mode::walk, {-1.03, 0.0, 0.95}, {&region, 1});
  for (int i = 0; i < 100; ++i) fro.step({i % 20 < 10 ? 0.2 : -0.2, 0.0, 0.0}, 0.03);
  EXPECT_EQ(fro.count(EventKind::narrowed), 1);
  EXPECT_EQ(fro.count(EventKind::widened), 0);
}

TEST(Regions, AreEnteredByTheCentreAndByTheFeet) {
  const Mesh m = floor_mesh();
  for (const double z : {0.0, 0.95}) {
    const SizeRegion flat{{Vec3(-1.0, -0.5, z - 0.1), Vec3(1.0, 0.5, z + 0.1)}, 0.2, 0.0, "flat"};
    for (const Mode mode : {Mode::walk, Mode::fly}) {
      Roam r(m, person(0.3), mode, {-2.0, 0.0, 0.95}, {&flat, 1});
      for (int i = 0; i < 400; ++i) {
        r.step({0.01 / frame, 0.0, 0.0});
        const double x = r.walker.position().x;
        if (std::abs(std::abs(x) - 1.0) > 0.1) {
          ASSERT_EQ(r.walker.body().radius, std::abs(x) < 1.0 ? 0.2 : 0.3) << to_string(mode) << " at " << x;
        }
      }
    }
  }
}

TEST(Regions, ThatEndTooEarlyLeaveTheBodySmallUntilItFits) {
  Mesh m = floor_mesh();  // a passage 0.6 m wide and 4 m long, of which the region is the beginning
  add_box(m, {1.0, -5.0, -0.1}, {5.0, -0.3, 2.5});
  add_box(m, {1.0, 0.3, -0.1}, {5.0, 5.0, 2.5});
  const SizeRegion region = around_door(0.25);
  for (const double speed : speeds) {
    Roam r(m, person(0.4), Mode::walk, {-1.0, 0.0, 0.95}, {&region, 1});
    for (int i = 0; i < 1500 && r.walker.position().x < 8.0; ++i) {
      r.step({speed, 0.0, 0.0});
      const double x = r.walker.position().x;
      if (x > 1.0 && x < 5.0) {
        ASSERT_EQ(r.walker.body().radius, 0.25);
      }
    }
    EXPECT_EQ(r.walker.body().radius, 0.4) << speed;
  }
}

TEST(Regions, OverlapToTheSmallestBodyAndTheLargestDisc) {
  const Mesh m = floor_mesh();
  const std::array<SizeRegion, 3> regions{SizeRegion{{Vec3(-2.0), Vec3(2.0)}, 0.25, 0.6, ""},
                                          SizeRegion{{Vec3(-1.0), Vec3(3.0)}, 0.2, 0.4, ""},
                                          SizeRegion{{Vec3(2.5), Vec3(9.0)}, 0.35, 0.9, ""}};
  const World world = build(m);
  Walker w(world, person(0.3), Mode::walk, {-4.0, 0.0, 0.95});
  w.set_regions(regions);
  const auto at = [&](double x) {
    w.place({x, 0.0, 0.95});
    return std::pair(w.settings().radius, w.settings().support_radius);
  };
  EXPECT_EQ(at(-4.0), std::pair(0.3, 0.0));
  EXPECT_EQ(at(-1.5), std::pair(0.25, 0.6));
  EXPECT_EQ(at(0.0), std::pair(0.2, 0.6));
  EXPECT_EQ(at(2.2), std::pair(0.2, 0.4));
}

TEST(Regions, MayHoldALargerBodyThatIsHadWhereItFits) {
  const Mesh m = floor_mesh();
  const SizeRegion hall{{Vec3(0.0, -5.0, -1.0), Vec3(4.0, 5.0, 3.0)}, 0.5, 0.0, "hall"};
  Roam r(m, person(0.3), Mode::walk, {-2.0, 0.0, 0.95}, {&hall, 1});
  for (int i = 0; i < 150; ++i) r.step({1.4, 0.0, 0.0});
  EXPECT_EQ(r.walker.body().radius, 0.5);
  for (int i = 0; i < 200; ++i) r.step({1.4, 0.0, 0.0});
  EXPECT_EQ(r.walker.body().radius, 0.3);
}

TEST(Regions, LeaveAClimberOnARampWhereItIs) {
  for (const double degrees : {10.0, 30.0, 44.0}) {
    const double rise = std::tan(degrees * std::numbers::pi / 180.0);
    Mesh m;
    add_quad(m, {-10.0, -10.0, -10.0 * rise}, {10.0, -10.0, 10.0 * rise}, {10.0, 10.0, 10.0 * rise},
             {-10.0, 10.0, -10.0 * rise});
    const SizeRegion region{{Vec3(-1.0, -5.0, -9.0), Vec3(1.0, 5.0, 9.0)}, 0.15, 0.0, ""};
    Roam r(m, person(0.3), Mode::walk, {-3.0, 0.0, -3.0 * rise + 1.1}, {&region, 1});
    for (int i = 0; i < 600 && r.walker.position().x < 3.0; ++i) {
      const double eye = r.walker.eye().z - rise * r.walker.position().x;
      r.step({1.0, 0.0, 0.0});
      // What a ball of 0.15 m more gains over the axis, and its skin, is all that the eye may move.
      const double most = 0.15 * (std::sqrt(1.0 + rise * rise) - 1.0) + 2.0 * r.walker.skin();
      ASSERT_LT(std::abs(r.walker.eye().z - rise * r.walker.position().x - eye), most + 1e-9) << degrees;
    }
    EXPECT_EQ(r.walker.body().radius, 0.3) << degrees;
    EXPECT_EQ(r.count(EventKind::narrowed), 1);
    EXPECT_EQ(r.count(EventKind::widened), 1);
    EXPECT_EQ(r.count(EventKind::airborne), 0);
  }
}

TEST(Regions, MakeASphereASmallerSphereOnTheSameFoot) {
  const Mesh m = doorway(0.6);
  const SizeRegion door = around_door(0.28);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Roam r(m, WalkerSettings::sphere(0.4), mode, {-2.0, 0.02, 0.45}, {&door, 1});
    double feet = 0.0;
    for (int i = 0; i < 600 && r.walker.position().x < 3.0; ++i) {
      const double before = r.walker.feet().z;
      const StepReport& step = r.step({1.4, -0.2 * r.walker.position().y, 0.0});
      if (step.has(EventKind::narrowed) || step.has(EventKind::widened)) {
        feet = std::max(feet, std::abs(r.walker.feet().z - before));
      }
      EXPECT_EQ(r.walker.body().half_height, 0.0);
      EXPECT_EQ(step.height, 2.0 * step.radius);
    }
    EXPECT_GE(r.walker.position().x, 3.0);
    EXPECT_EQ(r.walker.body().radius, 0.4);
    EXPECT_LT(feet, 1e-3);
    EXPECT_LT(r.worst_eye, 1e-12);
  }
}

TEST(Regions, WaitForACrouchedBodyToStand) {
  Mesh m = low_passage(1.2);
  const SizeRegion region{{Vec3(0.0, -5.0, -1.0), Vec3(2.0, 5.0, 3.0)}, 0.3, 0.0, ""};
  WalkerSettings broad = person(0.6);
  broad.crouch_height = 0.9;  // that is 1.2 m with a radius of 0.6
  Roam r(m, broad, Mode::walk, {-2.0, 0.0, 0.95}, {&region, 1});
  for (int i = 0; i < 600 && r.walker.position().x < 7.0; ++i) r.step({1.4, 0.0, 0.0});
  EXPECT_GE(r.walker.position().x, 7.0);
  EXPECT_EQ(r.walker.body().radius, 0.6);
  EXPECT_FALSE(r.walker.crouched());
}

TEST(Regions, BringADiscAndKeepItOverACrack) {
  Mesh m;
  add_floor(m, -20.0, -10.0, 0.0, 10.0, 0.0);
  add_floor(m, 1.0, -10.0, 20.0, 10.0, 0.0);
  const SizeRegion crack{{Vec3(-0.5, -10.0, -1.0), Vec3(0.4, 10.0, 3.0)}, 0.3, 0.52, "split"};
  for (const double speed : speeds) {
    Roam r(m, person(0.3), Mode::walk, {-2.0, 0.0, 0.95}, {&crack, 1});
    for (int i = 0; i < 1000 && r.walker.position().x < 2.0; ++i) r.step({speed, 0.0, 0.0});
    EXPECT_GE(r.walker.position().x, 2.0) << speed;
    EXPECT_GT(r.count(EventKind::bridged), 0);
    EXPECT_EQ(r.walker.settings().support_radius, 0.0);
  }
}

TEST(Regions, FreeABodyThatWasHeldWithoutThem) {
  Mesh m = floor_mesh();
  for (const double y : {-0.25, 0.25}) add_wall(m, -8.0, y, 8.0, y, -0.5, 4.0);
  const SizeRegion all{{Vec3(-9.0), Vec3(9.0)}, 0.2, 0.0, "slot"};
  WalkerSettings broad = person(0.5);
  Roam r(m, broad, Mode::walk, {0.0, 0.0, 0.95}, {&all, 1});
  EXPECT_TRUE(r.walker.held());
  for (int i = 0; i < 30; ++i) r.step({1.0, 0.0, 0.0});
  EXPECT_FALSE(r.walker.held());
  EXPECT_EQ(r.walker.body().radius, 0.2);
  EXPECT_NEAR(r.walker.feet().z, 0.0, near_ground);
}

TEST(Regions, AreRefusedByNumberAndReason) {
  const World world = build(floor_mesh());
  Walker w(world, person(0.3), Mode::walk, {0.0, 0.0, 0.95});
  const auto message = [&](const SizeRegion& bad) {
    const std::array<SizeRegion, 2> regions{around_door(0.2), bad};
    try {
      w.set_regions(regions);
    } catch (const roam::Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(message({roam::Box{}, 0.2, 0.0, "nowhere"}).find("region 2 (nowhere)"), std::string::npos);
  EXPECT_NE(message({{Vec3(0.0), Vec3(1.0)}, 0.0, 0.0, ""}).find("region 2: "), std::string::npos);
  EXPECT_NE(message({{Vec3(0.0), Vec3(1.0)}, 0.95, 0.0, ""}).find("height"), std::string::npos);
  EXPECT_NE(message({{Vec3(0.0), Vec3(1.0)}, 0.2, -1.0, ""}).find("support"), std::string::npos);
  EXPECT_TRUE(w.regions().empty());
  EXPECT_THROW((void)w.resize(1.0, 0.0), roam::Error);
  EXPECT_EQ(w.settings().radius, 0.3);
}

TEST(Resize, IsSmallerAtOnceAndLargerWhenItFits) {
  const Mesh m = doorway(0.7);
  Roam r(m, person(0.3), Mode::walk, {-1.0, 0.0, 0.95}, {});
  for (int i = 0; i < 90; ++i) r.step({1.4, 0.0, 0.0});
  EXPECT_NEAR(r.walker.position().x, 1.1, 0.05);
  EXPECT_TRUE(r.walker.resize(0.2, 0.0));
  EXPECT_TRUE(r.walker.report().has(EventKind::narrowed));
  EXPECT_GE(margin(r.judge, r.walker.report()), 0.0);
  EXPECT_EQ(r.walker.body().radius, 0.2);
  EXPECT_FALSE(r.walker.resize(0.4, 0.0));
  EXPECT_EQ(r.walker.body().radius, 0.2);
  for (int i = 0; i < 60; ++i) r.step({1.4, 0.0, 0.0});
  EXPECT_EQ(r.walker.body().radius, 0.4);
  EXPECT_EQ(r.count(EventKind::widened), 1);
  EXPECT_TRUE(r.walker.resize(0.45, 0.6));
  EXPECT_EQ(r.walker.settings().support_radius, 0.6);
  EXPECT_GE(margin(r.judge, r.walker.report()), 0.0);
}

TEST(Resize, HasTheClearanceOfItsPlaceAndNotOfTheWayThere) {
  Mesh m;
  add_wall(m, 0.0, -50.0, 0.0, 50.0, -50.0, 50.0);
  const World world = build(m);
  Walker walker(world, WalkerSettings::sphere(0.5), Mode::fly, {0.5011, 0.0, 0.0});
  walker.step({.velocity = {0.4, 0.0, 0.0}}, 1.0);
  ASSERT_NEAR(walker.report().axis_clearance, 0.5011, 1e-3);
  ASSERT_TRUE(walker.resize(0.1, 0.0));
  const StepReport& r = walker.report();
  const double gap = 0.8011;
  EXPECT_GE(r.axis_clearance - 0.1, 0.75 * gap - 2.0 * walker.skin() - 2e-3);
  EXPECT_LE(r.axis_clearance - 0.1, gap + 1e-6);
  EXPECT_NEAR(r.segments.back().axis_clearance, r.axis_clearance, 1e-5);
}

TEST(Resize, OfAGhostIsHadWhenItIsABodyAgain) {
  const Mesh m = floor_mesh();
  Roam r(m, WalkerSettings::sphere(0.3), Mode::walk, {0.0, 0.0, 0.35}, {});
  r.walker.set_mode(Mode::ghost);
  (void)r.walker.resize(0.2, 0.0);
  r.walker.step({{0.0, 0.0, 1.0}}, 1.0);
  r.walker.set_mode(Mode::fly);
  EXPECT_EQ(r.walker.body().radius, 0.2);
  EXPECT_GE(margin(r.judge, r.walker.report()), 0.0);
}

TEST(Regions, TellTheLeastGapOfARoute) {
  const World world = build(doorway(0.6));
  const SizeRegion door = around_door(0.28);
  Walker w(world, person(0.4), Mode::walk, {-2.0, 0.0, 0.95});
  w.set_regions({&door, 1});
  const std::array<Vec3, 2> way{Vec3(-2.0, 0.0, 0.95), Vec3(4.0, 0.0, 0.95)};
  const roam::RouteResult result = roam::follow(w, way);
  EXPECT_EQ(result.outcome, roam::Outcome::reached);
  EXPECT_NEAR(result.least_axis_clearance, 0.28, 0.02);
  EXPECT_GE(result.least_gap, -1e-6);
  EXPECT_LT(result.least_gap, 0.02);
}

}  // namespace
