// Boxes hold what lies in them.
#include <gtest/gtest.h>

#include <limits>

#include "roam/math.h"

namespace {

using roam::Box;
using roam::Vec3;

TEST(Box, HoldsItsBorderAndWhatIsInside) {
  const Box box{Vec3(-1.0, 2.0, 3.0), Vec3(1.0, 4.0, 3.0)};
  EXPECT_TRUE(box.holds({0.0, 3.0, 3.0}));
  EXPECT_TRUE(box.holds(box.lower));
  EXPECT_TRUE(box.holds(box.upper));
  for (int k = 0; k < 3; ++k) {
    Vec3 p = box.center();
    p[k] = box.upper[k] + 1e-9;
    EXPECT_FALSE(box.holds(p));
    p[k] = box.lower[k] - 1e-9;
    EXPECT_FALSE(box.holds(p));
    p[k] = std::numeric_limits<double>::quiet_NaN();
    EXPECT_FALSE(box.holds(p));
  }
  EXPECT_FALSE(Box().holds(Vec3(0.0)));
}

TEST(Box, GrowsOnBothSides) {
  const Box box{Vec3(-1.0, 2.0, 3.0), Vec3(1.0, 4.0, 3.0)};
  const Box grown = box.grown(Vec3(1.0, 0.5, 0.0));
  EXPECT_EQ(grown.lower, Vec3(-2.0, 1.5, 3.0));
  EXPECT_EQ(grown.upper, Vec3(2.0, 4.5, 3.0));
  EXPECT_EQ(box.grown(0.25).lower, Vec3(-1.25, 1.75, 2.75));
  EXPECT_TRUE(Box().grown(1.0).empty());
}

}  // namespace
