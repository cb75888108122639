// Where along a way something lies.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "ways/trials/on_way.h"

namespace {

using roam::Mode;
using roam::Vec3;
using roam::ways::nearest_on;
using roam::ways::OnWay;

TEST(OnWay, IsTheNearestPlaceOfAllPieces) {
  const std::vector<Vec3> way{{0.0, 0.0, 0.0}, {4.0, 0.0, 0.0}, {4.0, 4.0, 0.0}};
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    const OnWay on = nearest_on(way, {4.5, 1.0, 0.0}, mode);
    EXPECT_DOUBLE_EQ(on.along, 5.0);
    EXPECT_DOUBLE_EQ(on.apart, 0.5);
    EXPECT_EQ(on.place, Vec3(4.0, 1.0, 0.0));
    EXPECT_EQ(on.heading, Vec3(0.0, 1.0, 0.0));
  }
  EXPECT_DOUBLE_EQ(nearest_on(way, {-3.0, -4.0, 0.0}, Mode::fly).apart, 5.0);
  EXPECT_DOUBLE_EQ(nearest_on(way, {4.0, 9.0, 0.0}, Mode::fly).along, 8.0);
}

TEST(OnWay, CountsNoHeightOnFootWithinAStorey) {
  // Up a ramp, and back over it a storey higher.
  const std::vector<Vec3> way{{0.0, 0.0, 0.0}, {4.0, 0.0, 3.0}, {4.0, 1.0, 6.0}, {0.0, 1.0, 6.0}};
  const OnWay lintel = nearest_on(way, {2.0, 0.0, 1.5 + 1.9}, Mode::walk);
  EXPECT_NEAR(lintel.apart, 0.0, 1e-12);
  EXPECT_NEAR(lintel.along, 2.5, 1e-12);
  EXPECT_NEAR(lintel.place.z, 1.5, 1e-12);
  EXPECT_GT(nearest_on(way, {2.0, 0.0, 3.4}, Mode::fly).apart, 1.0);
  // Nearer from above to the lower part, but it stands on the upper one.
  EXPECT_NEAR(nearest_on(way, {1.0, 0.45, 6.5}, Mode::walk).place.z, 6.0, 1e-12);
}

TEST(OnWay, TakesWaysThatLeadNowhere) {
  EXPECT_TRUE(std::isinf(nearest_on({}, Vec3(1.0), Mode::fly).apart));
  const std::vector<Vec3> one{{1.0, 2.0, 3.0}}, still{{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}};
  for (const auto& way : {one, still}) {
    const OnWay on = nearest_on(way, {1.0, 2.0, 5.0}, Mode::fly);
    EXPECT_EQ(on.along, 0.0);
    EXPECT_EQ(on.apart, 2.0);
    EXPECT_EQ(on.heading, Vec3(0.0));
  }
}

}  // namespace
