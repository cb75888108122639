// What a flying body does not fit through, far from the origin and along a pitched way.
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

Vec3 pitched(double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  return {std::cos(a), 0.0, std::sin(a)};
}

/// A body that has flown into the gap between two boxes, 2 m ahead of `place`, with a wall behind it and one beyond.
struct Stopped {
  explicit Stopped(Mesh gap) {
    for (const double x : {-4.0, 4.0}) add_wall(gap, x, -9.0, x, 9.0, -9.0, 9.0);
    shift(gap, place);
    walk.emplace(gap, ball(0.3), Mode::fly, place);
    walk->go({1.4, 0.0, 0.0}, 3.0);
    EXPECT_TRUE(walk->walker.report().blocked);
  }
  std::optional<Walk> walk;
};

TEST(FlownOpening, IsAsWideAlongEachPitch) {
  Mesh posts;
  add_box(posts, {2.0, -4.0, -4.0}, {2.2, -0.15, 4.0});
  add_box(posts, {2.0, 0.25, -4.0}, {2.2, 4.0, 4.0});
  const Stopped stopped(posts);
  for (const double pitch : pitches) {
    const auto opening = measure_opening(stopped.walk->walker, pitched(pitch));
    ASSERT_TRUE(opening) << pitch;
    EXPECT_EQ(opening->kind, Opening::Kind::door);
    EXPECT_NEAR(opening->width, 0.4, 2e-3);
    EXPECT_NEAR(std::abs(opening->direction.y), 1.0, 1e-3);
    EXPECT_NEAR(opening->point.x, place.x + 2.0, 2e-3);
    EXPECT_NEAR(opening->point.y, place.y + 0.05, 2e-3);
  }
}

TEST(FlownOpening, IsAsHighAsSeenAlongThePitch) {
  Mesh slabs;
  add_box(slabs, {2.0, -4.0, -4.0}, {2.2, 4.0, -0.15});
  add_box(slabs, {2.0, -4.0, 0.25}, {2.2, 4.0, 4.0});
  const Stopped stopped(slabs);
  for (const double pitch : pitches) {
    const auto opening = measure_opening(stopped.walk->walker, pitched(pitch));
    ASSERT_TRUE(opening) << pitch;
    EXPECT_EQ(opening->kind, Opening::Kind::lintel);
    EXPECT_NEAR(opening->width, 0.4 * pitched(pitch).x, 2e-3);
    EXPECT_NEAR(glm::length(opening->direction), 1.0, 1e-12);
    EXPECT_NEAR(glm::dot(opening->direction, pitched(pitch)), 0.0, 1e-12);
    EXPECT_NEAR(opening->point.z, place.z + 0.05, 2e-3);
  }
}

}  // namespace
