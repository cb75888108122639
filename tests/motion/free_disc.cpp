// Room for a support disc in the floor: a hole of known size, level and tilted, at any place of the disc's axis.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/carrying.h"
#include "walker_scenes.h"

namespace {

using namespace scenes;
using roam::Carrying;

/// A plane that rises along x, with a rectangular hole about the origin: `wide` metres along x, `deep` along y.
Mesh floor_with_hole(double degrees, double wide, double deep) {
  Mesh mesh;
  const double rise = std::tan(degrees * std::numbers::pi / 180.0);
  const auto part = [&](double x0, double y0, double x1, double y1) {
    // Narrow strips: the floor nearest to a place is then not the whole floor.
    for (int i = 0; i < 12; ++i) {
      const double a = x0 + (x1 - x0) * i / 12, b = x0 + (x1 - x0) * (i + 1) / 12;
      add_quad(mesh, {a, y0, a * rise}, {b, y0, b * rise}, {b, y1, b * rise}, {a, y1, a * rise});
    }
  };
  part(-6.0, -6.0, -0.5 * wide, 6.0);
  part(0.5 * wide, -6.0, 6.0, 6.0);
  part(-0.5 * wide, -6.0, 0.5 * wide, -0.5 * deep);
  part(-0.5 * wide, 0.5 * deep, 0.5 * wide, 6.0);
  return mesh;
}

TEST(FreeDisc, IsFoundInAHoleThatItFitsIntoAndInNoSmallerOne) {
  Random random(17);
  int free = 0, none = 0;
  for (const double degrees : {0.0, 20.0, 45.0, 60.0, 75.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const roam::FloorPlane plane{{0.0, 0.0, 0.0}, {-std::sin(angle), 0.0, std::cos(angle)}};
    for (int i = 0; i < 40; ++i) {
      const double wide = random.between(0.3, 1.4), deep = random.between(0.3, 1.4), least = std::min(wide, deep);
      const roam::World world = build(floor_with_hole(degrees, wide, deep), true);
      // Storage and the search are each off by less than 2 mm. The axis is inside the hole.
      for (const double radius : {0.5 * least - 0.004, 0.5 * least + 0.004}) {
        const Vec3 axis(random.between(-0.4, 0.4) * wide, random.between(-0.4, 0.4) * deep, 0.0);
        // The middle of the disc keeps away from the rims by its radius; the axis is in the disc.
        const double x = std::clamp(axis.x, radius - 0.5 * wide, 0.5 * wide - radius);
        const double y = std::clamp(axis.y, radius - 0.5 * deep, 0.5 * deep - radius);
        const bool fits = radius < 0.5 * least;
        if (fits && std::abs(std::hypot(axis.x - x, axis.y - y) - radius) < 0.01) continue;
        const bool expected = fits && std::hypot(axis.x - x, axis.y - y) < radius;
        const Carrying floor = roam::carrying(world, plane, {radius, 85.0, 0.3}, axis);
        EXPECT_EQ(floor, expected ? Carrying::no : Carrying::yes)
            << degrees << " degrees, hole of " << wide << " x " << deep << ", radius " << radius << ", axis " << axis.x
            << ' ' << axis.y;
        ++(expected ? free : none);
      }
    }
  }
  EXPECT_GT(free, 50);
  EXPECT_GT(none, 50);
}

TEST(FreeDisc, IsFoundNowhereInWholeFloorHoweverSteep) {
  Random random(18);
  for (const double degrees : {0.0, 30.0, 60.0, 75.0, 84.0}) {
    const double angle = degrees * std::numbers::pi / 180.0;
    const roam::World world = build(floor_with_hole(degrees, 0.3, 0.3), true);
    for (int i = 0; i < 200; ++i) {
      const double radius = random.between(0.2, 0.9), turn = random.between(0.0, 2.0 * std::numbers::pi);
      const Vec3 axis(2.0 * std::cos(turn), 2.0 * std::sin(turn), 0.0);
      const double lean = degrees == 0.0 ? 0.0 : angle + random.between(-0.03, 0.03);
      const roam::FloorPlane plane{{axis.x, axis.y, axis.x * std::tan(angle)}, {-std::sin(lean), 0.0, std::cos(lean)}};
      EXPECT_EQ(roam::carrying(world, plane, {radius, 85.0, 0.3}, axis), Carrying::yes)
          << degrees << " degrees, radius " << radius << ", axis " << axis.x << ' ' << axis.y;
    }
  }
}

}  // namespace
