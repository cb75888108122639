// Openings before a flying body, away from the origin, along pitched ways in any direction.
#include "roam/opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Opening;

const Vec3 place(50.0, -30.0, 7.0);
constexpr double pitches[] = {-35.0, 0.0, 35.0};

/// Degrees about the vertical, by which scenes and ways are turned.
constexpr double turns[] = {0.0, 30.0, 200.0};

Vec3 turned(const Vec3& v, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
}

Vec3 pitched(double degrees, double turn) {
  const double a = degrees * std::numbers::pi / 180.0;
  return turned({std::cos(a), 0.0, std::sin(a)}, turn);
}

/// A body that has flown into the gap between two boxes, 2 m ahead of `place`, with a wall behind it and one beyond.
struct Stopped {
  Stopped(const Mesh& gap, double turn) : mesh(gap) {
    for (const double x : {-4.0, 4.0}) add_wall(mesh, x, -9.0, x, 9.0, -9.0, 9.0);
    for (Vec3& v : mesh.vertices) v = turned(v, turn) + place;
    walk.emplace(mesh, ball(0.3), Mode::fly, place);
    walk->go(turned({1.4, 0.0, 0.0}, turn), 3.0);
    EXPECT_TRUE(walk->walker.report().blocked);
  }
  Mesh mesh;
  std::optional<Walk> walk;
};

TEST(FlownOpening, IsAsWideAlongEachPitch) {
  Mesh posts;
  add_box(posts, {2.0, -4.0, -4.0}, {2.2, -0.15, 4.0});
  add_box(posts, {2.0, 0.25, -4.0}, {2.2, 4.0, 4.0});
  for (const double turn : turns) {
    const Stopped stopped(posts, turn);
    for (const double pitch : pitches) {
      const auto opening = measure_opening(stopped.walk->walker, pitched(pitch, turn));
      ASSERT_TRUE(opening) << turn << " " << pitch;
      EXPECT_EQ(opening->kind, Opening::Kind::door);
      EXPECT_NEAR(opening->width, 0.4, 2e-3);
      EXPECT_NEAR(std::abs(turned(opening->direction, -turn).y), 1.0, 1e-3);
      const Vec3 point = turned(opening->point - place, -turn);
      EXPECT_NEAR(point.x, 2.0, 2e-3);
      EXPECT_NEAR(point.y, 0.05, 2e-3);
    }
  }
}

TEST(FlownOpening, IsAsHighAsSeenAlongThePitch) {
  Mesh slabs;
  add_box(slabs, {2.0, -4.0, -4.0}, {2.2, 4.0, -0.15});
  add_box(slabs, {2.0, -4.0, 0.25}, {2.2, 4.0, 4.0});
  for (const double turn : turns) {
    const Stopped stopped(slabs, turn);
    for (const double pitch : pitches) {
      const Vec3 ahead = pitched(pitch, turn);
      const auto opening = measure_opening(stopped.walk->walker, ahead);
      ASSERT_TRUE(opening) << turn << " " << pitch;
      EXPECT_EQ(opening->kind, Opening::Kind::lintel);
      EXPECT_NEAR(opening->width, 0.4 * pitched(pitch, 0.0).x, 2e-3);
      EXPECT_NEAR(glm::length(opening->direction), 1.0, 1e-12);
      EXPECT_NEAR(glm::dot(opening->direction, ahead), 0.0, 1e-12);
      EXPECT_NEAR(opening->point.z, place.z + 0.05, 2e-3);
    }
  }
}

}  // namespace
