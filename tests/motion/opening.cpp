// Openings before a flying body, away from the origin, along pitched ways in any direction.
#include "roam/opening.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <optional>

#include "roam/instances.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Opening;
using roam::Pose;

const Vec3 place(50.0, -30.0, 7.0);
constexpr double pitches[] = {-35.0, 0.0, 35.0};

/// Radians about the vertical, by which scenes and ways are turned.
constexpr double headings[] = {0.0, 0.5, 3.5};

Vec3 turned(const Vec3& way, double heading) { return Pose{Vec3(0.0), heading}.to_scene(way); }

Vec3 pitched(double degrees, double heading) {
  const double a = degrees * std::numbers::pi / 180.0;
  return turned({std::cos(a), 0.0, std::sin(a)}, heading);
}

/// A body that has flown into the gap between two boxes, 2 m ahead of `place`, with a wall behind it and one beyond.
struct Stopped {
  Stopped(const Mesh& gap, double heading) : mesh(gap), pose{place, heading} {
    for (const double x : {-4.0, 4.0}) add_wall(mesh, x, -9.0, x, 9.0, -9.0, 9.0);
    for (Vec3& v : mesh.vertices) v = pose.to_scene(v);
    walk.emplace(mesh, ball(0.3), Mode::fly, place);
    walk->go(turned({1.4, 0.0, 0.0}, heading), 3.0);
    EXPECT_TRUE(walk->walker.report().blocked);
  }
  Mesh mesh;
  Pose pose;
  std::optional<Walk> walk;
};

TEST(FlownOpening, IsAsWideAlongEachPitch) {
  Mesh posts;
  add_box(posts, {2.0, -4.0, -4.0}, {2.2, -0.15, 4.0});
  add_box(posts, {2.0, 0.25, -4.0}, {2.2, 4.0, 4.0});
  for (const double heading : headings) {
    const Stopped stopped(posts, heading);
    for (const double pitch : pitches) {
      const auto opening = measure_opening(stopped.walk->walker, pitched(pitch, heading));
      ASSERT_TRUE(opening) << heading << " " << pitch;
      EXPECT_EQ(opening->kind, Opening::Kind::door);
      EXPECT_NEAR(opening->width, 0.4, 2e-3);
      EXPECT_NEAR(std::abs(turned(opening->direction, -heading).y), 1.0, 1e-3);
      const Vec3 point = stopped.pose.to_instance(opening->point);
      EXPECT_NEAR(point.x, 2.0, 2e-3);
      EXPECT_NEAR(point.y, 0.05, 2e-3);
    }
  }
}

TEST(FlownOpening, IsAsHighAsSeenAlongThePitch) {
  Mesh slabs;
  add_box(slabs, {2.0, -4.0, -4.0}, {2.2, 4.0, -0.15});
  add_box(slabs, {2.0, -4.0, 0.25}, {2.2, 4.0, 4.0});
  for (const double heading : headings) {
    const Stopped stopped(slabs, heading);
    for (const double pitch : pitches) {
      const Vec3 ahead = pitched(pitch, heading);
      const auto opening = measure_opening(stopped.walk->walker, ahead);
      ASSERT_TRUE(opening) << heading << " " << pitch;
      EXPECT_EQ(opening->kind, Opening::Kind::lintel);
      EXPECT_NEAR(opening->width, 0.4 * pitched(pitch, 0.0).x, 2e-3);
      EXPECT_NEAR(glm::length(opening->direction), 1.0, 1e-12);
      EXPECT_NEAR(glm::dot(opening->direction, ahead), 0.0, 1e-12);
      EXPECT_NEAR(opening->point.z, place.z + 0.05, 2e-3);
    }
  }
}

}  // namespace
