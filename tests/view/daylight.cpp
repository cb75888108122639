// How much sky the eye sees, which chooses the light; and the sun's shadows of tiles.
#include "view/daylight.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "graphics/shading.h"
#include "roam/patchwork.h"
#include "roam/world.h"
#include "tileset_made.h"
#include "view_program.h"
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

TEST(Daylight, IsNotThatOfSpaceThatIsStillToCome) {
  const Vec3 eye(0.1, 0, 1.6);
  Patchwork part;
  part.deliver(part.expect({{-30, -30, 0}, {0, 30, 3}}), yard());
  part.expect({{0.5, -30, -1}, {30, 30, 40}});
  part.update({0.3, 0.0}, eye, Vec3(0.0));
  EXPECT_EQ(open_sky(part, {-15, 0, 1.6}), 0.0) << "what is to come lies beyond the roof";
  EXPECT_LT(open_sky(part, eye), open_sky(yard(), eye)) << "the sky over what is to come does not count";
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

TEST(Daylight, ThrowsTheShadowOfATileOnAnother) {
  View view("");
  const std::filesystem::path folder = view.folder.file("tiles");
  std::filesystem::create_directories(folder);
  const auto tile = [&](const char* file, float height, float side, double corner) {
    std::ofstream(folder / file, std::ios::binary)
        << test::made_tile("b3dm", test::MadeGrid(1, height, side).gltf().glb());
    return test::Json{{"boundingVolume", {{"box", {0.5 * side, -0.5 * side, height, 32, 0, 0, 0, 32, 0, 0, 0, 1}}}},
                      {"geometricError", 0.0},
                      {"content", {{"uri", file}}},
                      {"transform", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, corner, -corner, 0, 1}}};
  };
  const test::Json root{{"boundingVolume", {{"box", {32, -32, 6, 32, 0, 0, 0, 32, 0, 0, 0, 8}}}},
                        {"geometricError", 1e4},
                        {"refine", "ADD"},
                        {"children", {tile("floor.b3dm", 0.0f, 64.0f, 0.0), tile("board.b3dm", 12.0f, 4.0f, 30.0)}}};
  view.scene = folder / "tileset.json";
  std::ofstream(view.scene) << test::made_tileset(root);
  view.shot({"--mode", "fly", "--at", "32,-32,30,90,-89.9"});
  ASSERT_EQ(view.result.status, 0) << view.result.err;
  const Shot picture = view.picture();
  // The eye is 30 m above the floor, and +y is up in the picture.
  const auto floor_at = [&](double x, double y) {
    const double pixels = 100.0 / (30.0 * std::tan(32.5 / 180.0 * std::numbers::pi));
    const osg::Vec4 c = picture.at(static_cast<int>(160.0 + x * pixels), static_cast<int>(100.0 + y * pixels));
    return c.r() + c.g() + c.b();
  };
  const Vec3 sun = graphics::sun_direction();
  const double x = -12.0 * sun.x / sun.z, y = -12.0 * sun.y / sun.z;
  EXPECT_LT(floor_at(x, y), 0.85f * floor_at(-x, -y));
  EXPECT_NEAR(floor_at(x, -y), floor_at(-x, -y), 0.1f);
}

}  // namespace
