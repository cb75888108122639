// The foot that carries a body over cracks, at any speed.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <numbers>

#include "motion/carrying.h"
#include "motion/state.h"
#include "roam/error.h"
#include "support_scenes.h"

namespace {

using namespace scenes;

TEST(Support, CarriesASlimBodyOverASplitAtAnySpeed) {
  for (const double width : {0.62, 0.8, 1.25}) {
    const Mesh m = split(width);
    for (const double more : {0.002, 0.02, 0.4}) {
      for (const double speed : speeds) {
        for (const double dt : steps) {
          Walk w(m, person(0.5 * width + more), Mode::walk, {-0.7, 0.1, 0.95});
          const Crossing c = cross(w, {speed, 0.0, 0.0}, dt, width + 0.5);
          EXPECT_TRUE(c.across) << width << " " << more << " " << speed << " " << dt;
          EXPECT_GT(c.lowest, -near_ground);
          EXPECT_LT(c.highest, near_ground);
          EXPECT_EQ(w.count(EventKind::airborne), 0);
        }
      }
    }
  }
}

TEST(Support, LetsABodyFallWhereTheDiscIsTooSmallAtAnySpeed) {
  for (const double width : {0.8, 1.0, 1.25}) {
    const Mesh m = split(width);
    for (const double less : {0.002, 0.02}) {
      for (const double speed : speeds) {
        for (const double dt : steps) {
          Walk w(m, person(0.5 * width - less), Mode::walk, {-0.7, 0.1, 0.95});
          EXPECT_TRUE(cross(w, {speed, 0.0, 0.0}, dt, width + 0.5).fell)
              << width << " " << less << " " << speed << " " << dt;
          EXPECT_EQ(w.count(EventKind::bridged), 0);
        }
      }
    }
  }
}

TEST(Support, IsLookedForBelowAnEdgeThatIsLeftAtAnySpeed) {
  Mesh m;
  add_floor(m, -1.0, -1.0, 1.0, 1.0, 0.0);
  add_floor(m, -1e4, -1e4, 1e4, 1e4, -100.0);
  for (const double speed : {1e4, 3e4, 1e5, 1e7}) {
    for (const double dt : {1.0 / 30.0, 1.0 / 60.0}) {
      Walk w(m, person(0.5), Mode::walk, {0.0, 0.0, 0.91});
      for (int i = 0; i < 3; ++i) w.step({speed, 0.0, 0.0}, dt);
      EXPECT_LT(w.feet(), -0.5) << speed << " " << dt;
      EXPECT_FALSE(w.walker.held());
    }
  }
}

TEST(Support, OfLessThanTheBodyIsThatOfTheBody) {
  // The crack is too narrow for the body to fall in and too wide for its rims to carry it: without a foot it is caught.
  const Mesh m = split(0.58);
  for (const double speed : speeds) {
    Walk without(m, person(0.0), Mode::walk, {-1.0, 0.1, 0.95});
    const double sunk = cross(without, {speed, 0.0, 0.0}, frame, 1.5).lowest;
    if (speed < 10.0) {  // else no step ends over the crack
      EXPECT_LT(sunk, -0.05) << speed;
    }
    for (const double foot : {0.1, 0.295, 0.3}) {
      Walk w(m, person(foot), Mode::walk, {-1.0, 0.1, 0.95});
      const Crossing c = cross(w, {speed, 0.0, 0.0}, frame, 1.5);
      EXPECT_TRUE(c.across) << foot << " " << speed;
      EXPECT_GT(c.lowest, -near_ground);
    }
  }
}

TEST(Support, CarriesInEveryDirection) {
  for (const double degrees : {17.0, 45.0, 90.0, 211.0}) {
    Mesh m = split(1.25);
    turn(m, degrees);
    const double a = degrees * std::numbers::pi / 180.0;
    const Vec3 across(std::cos(a), std::sin(a), 0.0), along(-std::sin(a), std::cos(a), 0.0);
    for (const double oblique : {0.0, 0.7, 2.0}) {
      Walk w(m, person(0.645), Mode::walk, -0.7 * across + Vec3(0.0, 0.0, 0.95));
      for (int i = 0; i < 300 && glm::dot(w.walker.position(), across) < 1.8; ++i) {
        w.step(1.4 * across + oblique * along);
        ASSERT_GT(w.feet(), -near_ground) << degrees << " " << oblique;
      }
      EXPECT_GE(glm::dot(w.walker.position(), across), 1.8);
    }
  }
}

TEST(Support, FindsAHigherOrLowerFarSide) {
  for (const double rise : {-0.2, -0.1, 0.1, 0.2}) {
    for (const double speed : speeds) {
      const Mesh m = split(1.25, 50.0, rise);
      Walk w(m, person(0.645), Mode::walk, {-0.7, 0.1, 0.95});
      const Crossing c = cross(w, {speed, 0.0, 0.0}, frame, 2.5);
      EXPECT_TRUE(c.across) << rise << " " << speed;
      w.go({0.0, 0.0, 0.0}, 0.2);
      EXPECT_NEAR(w.feet(), rise, near_ground) << rise << " " << speed;
      EXPECT_FALSE(w.walker.report().bridging);
    }
  }
}

// What is stored moves floors by up to half a millimetre, and tilts the plane that is seen. A far side that is exactly
// as high or low as carries does, wherever the grid of storing lies.
TEST(Support, FindsAFarSideAtTheEndOfTheBand) {
  for (const double rise : {-0.25, 0.25}) {
    for (const double width : {0.8, 1.25}) {
      for (int i = 0; i < 20; ++i) {
        Mesh m = split(width, 4.0, rise);
        for (Vec3& v : m.vertices) v += Vec3(0.0, 0.0, 0.0137 * i);
        Walk w(m, person(0.5 * width + 0.02), Mode::walk, {-0.7, 0.1 * i, 0.95 + 0.0137 * i});
        const Crossing c = cross(w, {1.4, 0.0, 0.0}, frame, width + 1.0);
        EXPECT_TRUE(c.across && !c.fell) << rise << " " << width << " " << i;
      }
    }
  }
}

TEST(Support, IsNotCarriedByAFarSideBeyondTheBand) {
  for (const double rise : {-0.26, 0.26}) {
    const Mesh m = split(1.25, 50.0, rise);
    Walk w(m, person(0.645), Mode::walk, {-0.7, 0.1, 0.95});
    EXPECT_TRUE(cross(w, {1.4, 0.0, 0.0}, frame, 2.5).fell) << rise;
  }
}

TEST(Support, GoesOnInThePlaneOfARamp) {
  for (const double degrees : {-20.0, 20.0}) {
    for (const double turned : {0.0, 35.0, 90.0}) {  // down the ramp, obliquely, along its contour
      Mesh m = split(1.25);
      turn(m, turned);
      tilt(m, degrees);
      const double a = turned * std::numbers::pi / 180.0, rise = std::tan(degrees * std::numbers::pi / 180.0);
      const Vec3 across(std::cos(a), std::sin(a), 0.0);
      const Vec3 start = -1.0 * across;
      Walk w(m, person(0.645), Mode::walk, {start.x, start.y, rise * start.x + 1.1});
      w.go(Vec3(0.0), 0.3);
      for (int i = 0; i < 300 && glm::dot(w.walker.position(), across) < 2.3; ++i) {
        w.step(1.4 * across);
        const Vec3 feet = w.walker.feet();
        // A ball on a ramp touches it beside its lowest point.
        const double lifted = 0.3 * (std::sqrt(1.0 + rise * rise) - 1.0);
        ASSERT_NEAR(feet.z, rise * feet.x + lifted, 0.02) << degrees << " " << turned << " at " << i;
      }
      EXPECT_GE(glm::dot(w.walker.position(), across), 2.3);
      EXPECT_GT(w.count(EventKind::bridged), 0);
    }
  }
}

// A round body on a slope touches it beside its axis. The floor below the axis is farther than a step of 0.
TEST(Support, SeesTheFloorOfASteepSlopeWithoutAStep) {
  Mesh m = floor_mesh();
  tilt(m, 44.0);
  WalkerSettings settings = person(0.4);
  settings.step = 0.0;
  Walk w(m, settings, Mode::walk, {0.0, 0.0, 1.2});
  w.go(Vec3(0.0), 0.5);
  ASSERT_TRUE(w.walker.grounded());
  ASSERT_TRUE(w.walker.state().floor());
  EXPECT_NEAR(w.walker.state().floor()->normal.z, std::cos(44.0 * std::numbers::pi / 180.0), 1e-3);
}

TEST(Support, WalksOverSlats) {
  Mesh m;
  add_floor(m, -20.0, -10.0, 0.0, 10.0, 0.0);
  for (int i = 0; i < 20; ++i) add_box(m, {0.7 + 0.75 * i, -10.0, -0.05}, {0.75 + 0.75 * i, 10.0, 0.0});
  for (const double speed : speeds) {
    Walk w(m, person(0.37, 0.25), Mode::walk, {-1.0, 0.0, 0.95});
    const Crossing c = cross(w, {speed, 0.0, 0.0}, frame, 14.0);
    EXPECT_TRUE(c.across) << speed;
    EXPECT_GT(c.lowest, -near_ground);
  }
}

Mesh stairs(double riser, double tread) {
  Mesh m;
  add_floor(m, -10.0, -5.0, 0.0, 5.0, 0.0);
  for (int i = 1; i <= 8; ++i) {
    const double x = tread * (i - 1);
    add_wall(m, x, -5.0, x, 5.0, riser * (i - 1), riser * i);
    add_floor(m, x, -5.0, x + tread, 5.0, riser * i);
  }
  add_floor(m, 8 * tread, -5.0, 8 * tread + 0.8, 5.0, 8 * riser);
  add_floor(m, 8 * tread + 2.0, -5.0, 8 * tread + 10.0, 5.0, 8 * riser);  // a split of 1.2 m on the landing
  return m;
}

TEST(Support, ClimbsStairsAsWithoutAndCrossesASplitAboveThem) {
  const Mesh m = stairs(0.17, 0.29);
  Walk with(m, person(0.62), Mode::walk, {-1.0, 0.0, 0.95}), without(m, person(0.0), Mode::walk, {-1.0, 0.0, 0.95});
  for (int i = 0; i < 500 && with.walker.position().x < 2.5; ++i) {
    with.step({1.0, 0.0, 0.0});
    without.step({1.0, 0.0, 0.0});
    ASSERT_EQ(with.walker.position(), without.walker.position()) << i;
  }
  EXPECT_EQ(with.count(EventKind::bridged), 0);
  EXPECT_TRUE(cross(with, {1.0, 0.0, 0.0}, frame, 5.5).across);
  EXPECT_NEAR(with.feet(), 8 * 0.17, near_ground);
  // And down again.
  for (int i = 0; i < 800 && with.walker.position().x > -1.0; ++i) with.step({-1.0, 0.0, 0.0});
  EXPECT_NEAR(with.feet(), 0.0, near_ground);
  EXPECT_EQ(with.count(EventKind::fell), 0);
  EXPECT_EQ(with.count(EventKind::airborne), 0);
}

TEST(Support, StandsOnABlockInTheSplit) {
  for (const double top : {-0.2, 0.0, 0.15}) {
    Mesh m = split(1.6);
    add_box(m, {0.55, -10.0, -50.0}, {1.05, 10.0, top});
    for (const double speed : speeds) {
      Walk w(m, person(0.32), Mode::walk, {-0.7, 0.0, 0.95});
      EXPECT_TRUE(cross(w, {speed, 0.0, 0.0}, frame, 2.5).across) << top << " " << speed;
    }
    Walk w(m, person(0.32), Mode::walk, {-0.7, 0.0, 0.95});
    EXPECT_TRUE(cross(w, {1.4, 0.0, 0.0}, frame, 0.8).across);
    EXPECT_NEAR(w.feet(), top, near_ground);
    EXPECT_FALSE(w.walker.report().bridging);
  }
}

TEST(Support, CrossesCrossingsAndTJointsByTheirOwnMeasure) {
  Mesh cross_of;  // two splits of 0.5 m: the largest disc between the four corners has a radius of 0.354 m
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      add_floor(cross_of, x > 0 ? 0.25 : -10.0, y > 0 ? 0.25 : -10.0, x > 0 ? 10.0 : -0.25, y > 0 ? 10.0 : -0.25, 0.0);
    }
  }
  for (const double foot : {0.345, 0.360}) {
    for (const double speed : speeds) {
      Walk w(cross_of, person(foot, 0.2), Mode::walk, {-1.0, -0.02, 0.95});
      const Crossing c = cross(w, {speed, 0.02 * speed, 0.0}, frame, 1.0);
      EXPECT_EQ(c.across, foot > 0.354) << foot << " " << speed;
    }
  }
}

TEST(Support, CrossesAManholeThatIsSmallerThanTheDisc) {
  Mesh m;  // a square hole of 0.8 m
  add_floor(m, -10.0, -10.0, -0.4, 10.0, 0.0);
  add_floor(m, 0.4, -10.0, 10.0, 10.0, 0.0);
  add_floor(m, -0.4, -10.0, 0.4, -0.4, 0.0);
  add_floor(m, -0.4, 0.4, 0.4, 10.0, 0.0);
  for (const double foot : {0.395, 0.405}) {
    for (const double speed : speeds) {
      for (const double dt : steps) {
        Walk w(m, person(foot), Mode::walk, {-1.0, 0.02, 0.95});
        const Crossing c = cross(w, {speed, 0.0, 0.0}, dt, 1.0);
        EXPECT_EQ(c.across, foot > 0.4) << foot << " " << speed << " " << dt;
        EXPECT_EQ(c.fell, foot < 0.4) << foot << " " << speed << " " << dt;
      }
    }
  }
}

TEST(Support, StandsStillTurnsRoundAndCrouchesOverACrack) {
  Mesh m = split(1.25);
  add_box(m, {-0.2, -10.0, 1.3}, {1.45, 10.0, 1.6});  // a beam over the crack
  Walk w(m, person(0.645), Mode::walk, {-1.0, 0.0, 0.95});
  EXPECT_TRUE(cross(w, {1.0, 0.0, 0.0}, frame, 0.6).across);
  EXPECT_TRUE(w.walker.report().bridging);
  EXPECT_TRUE(w.walker.crouched());
  const Vec3 rest = w.walker.position();
  w.go(Vec3(0.0), 5.0);
  EXPECT_EQ(w.walker.position(), rest);
  w.go({0.0, 1.0, 0.0}, 1.0);
  EXPECT_TRUE(w.walker.report().bridging);
  for (int i = 0; i < 200 && w.walker.position().x > -1.0; ++i) w.step({-1.0, 0.0, 0.0});
  EXPECT_NEAR(w.feet(), 0.0, near_ground);
  EXPECT_FALSE(w.walker.report().bridging);
  EXPECT_FALSE(w.walker.crouched());
  EXPECT_EQ(w.count(EventKind::bridged), 1);
  EXPECT_EQ(w.count(EventKind::airborne), 0);
}

TEST(Support, JumpsFromACrackAndOntoIt) {
  const Mesh m = split(1.25);
  for (const double dt : steps) {
    Walk w(m, person(0.645), Mode::walk, {-1.0, 0.0, 0.95});
    EXPECT_TRUE(cross(w, {1.0, 0.0, 0.0}, dt, 0.6).across);
    double highest = 0.0;
    w.step(Vec3(0.0), dt, true);
    for (double t = 0.0; t < 1.5; t += dt) {
      w.step(Vec3(0.0), dt);
      highest = std::max(highest, w.feet());
      ASSERT_GT(w.feet(), -near_ground);
    }
    EXPECT_GT(highest, 0.4);
    EXPECT_TRUE(w.walker.report().bridging);
    EXPECT_GT(w.count(EventKind::landed), 0);
    EXPECT_EQ(w.count(EventKind::fell), 0);
    // From the floor, and down over the middle of the crack.
    Walk onto(m, person(0.645), Mode::walk, {-0.3, 0.0, 0.95});
    onto.step({1.4, 0.0, 0.0}, dt, true);
    for (double t = 0.0; t < 1.0; t += dt) onto.step({t < 0.6 ? 1.4 : 0.0, 0.0, 0.0}, dt);
    EXPECT_TRUE(onto.walker.report().bridging) << dt;
    EXPECT_NEAR(onto.feet(), 0.0, near_ground);
  }
}

TEST(Support, LandsOnACrackThatItNeverSawTheFloorOf) {
  Mesh m = split(1.25);
  add_box(m, {-3.0, -1.0, 0.0}, {0.05, 1.0, 2.0});  // to jump down from, over the crack
  for (const double dt : steps) {
    Walk w(m, person(0.645), Mode::walk, {-0.5, 0.0, 2.95});
    for (double t = 0.0; t < 2.0; t += dt) w.step({w.feet() > 1.0 ? 1.0 : 0.0, 0.0, 0.0}, dt);
    EXPECT_NEAR(w.feet(), 0.0, near_ground) << dt;
    EXPECT_GT(w.walker.position().x, 0.3);
    EXPECT_TRUE(w.walker.report().bridging);
  }
  for (const double height : {0.0, 7.0}) {
    Mesh at = split(1.25);
    shift(at, {0.0, 0.0, height});
    Walk put(at, person(0.645), Mode::walk, {0.6, 0.0, height + 0.91});
    EXPECT_TRUE(put.walker.report().bridging) << height;
    EXPECT_NEAR(put.feet(), height, near_ground) << height;
  }
}

TEST(Support, StepsOverARoughFloorWithACrack) {
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    Random random(1000003 * seed);
    Mesh m = rough_tiling(80, seed);
    // Bumps of up to 3 cm, and a split of 1 m between x = 0 and 1.
    Mesh cut;
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      roam::Triangle t = m.triangle(i);
      const double left = std::max({t[0].x, t[1].x, t[2].x});
      for (Vec3& v : t) {
        v.z = 0.015 * (std::sin(9.0 * v.x + static_cast<double>(seed)) + std::cos(11.0 * v.y));
        if (left > 1e-6) v.x += 1.0;
      }
      add_triangle(cut, t[0], t[1], t[2]);
    }
    for (const double speed : speeds) {
      Walk w(cut, person(0.52), Mode::walk, {-2.0, random.between(-2.0, 2.0), 1.0});
      const Crossing c = cross(w, {speed, 0.0, 0.0}, frame, 3.0);
      EXPECT_TRUE(c.across) << seed << " " << speed;
      EXPECT_GT(c.lowest, -0.12) << seed << " " << speed;
    }
  }
}

TEST(Support, IsNotLookedForBelowABodyWithoutADisc) {
  Mesh m = split(0.58);
  for (Vec3& vertex : m.vertices) vertex.z += 10.0;
  const World world = build(m);
  const roam::Walker walker(world, {}, Mode::fly, {0.0, 0.0, 11.0});
  EXPECT_EQ(roam::carrying(walker, 0.6), roam::Carrying::no);
}

TEST(Support, IsRefusedOutOfRange) {
  for (const double foot : {-0.1, 250.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(roam::check(person(foot)), roam::Error) << foot;
  }
  EXPECT_NO_THROW(roam::check(person(250.0)));
}

}  // namespace
