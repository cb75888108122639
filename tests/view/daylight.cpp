// How much sky the eye sees, which chooses the light.
#include "view/daylight.h"

#include <gtest/gtest.h>

#include "roam/world.h"
#include "walker_scenes.h"

namespace {

using namespace roam;
using namespace roam::app;

/// Ground, and a roof over x < 0.
World yard() {
  Mesh mesh;
  scenes::add_floor(mesh, -30, -30, 30, 30, 0);
  scenes::add_floor(mesh, -30, -30, 0, 30, 3);
  return scenes::build(mesh);
}

TEST(Daylight, IsTheShareOfTheSkyThatIsOpen) {
  const World world = yard();
  EXPECT_EQ(open_sky(world, {-15, 0, 1.6}), 0.0);
  EXPECT_EQ(open_sky(world, {15, 0, 1.6}), 1.0);
  const double below_the_edge = open_sky(world, {0.1, 0, 1.6});
  EXPECT_GT(below_the_edge, 0.4);
  EXPECT_LT(below_the_edge, 0.8);
  EXPECT_EQ(open_sky(World(), {0, 0, 0}), 1.0);
}

TEST(Daylight, ChangesAtOnceTheFirstTimeAndThenSmoothly) {
  Daylight light;
  EXPECT_EQ(light.follow(0.0, 0.0), 0.0);
  double last = 0.0;
  for (int i = 0; i < 240; ++i) {
    const double now = light.follow(1.0, 1.0 / 60.0);
    EXPECT_GT(now, last);
    EXPECT_LT(now - last, 0.05);
    last = now;
  }
  EXPECT_GT(last, 0.99);
}

}  // namespace
