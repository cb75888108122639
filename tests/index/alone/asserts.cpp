// The core's asserts hold, and are there: no other build of ./check has them.
#include <gtest/gtest.h>

#include <cmath>

#include "index/traverse.h"
#include "roam/walker.h"
#include "roam/world.h"

#ifdef NDEBUG
#error "this test is of a core with asserts"
#endif

namespace {

using roam::Vec3;

/// A hall of 40 m with a rough floor and pillars.
roam::World hall() {
  roam::Mesh mesh{"hall", {}, {}};
  constexpr std::uint32_t cells = 80;
  for (std::uint32_t y = 0; y <= cells; ++y) {
    for (std::uint32_t x = 0; x <= cells; ++x) {
      const bool pillar = x % 9 == 4 && y % 7 == 3;
      mesh.vertices.push_back({0.5 * x, 0.5 * y, pillar ? 3.0 : 0.1 * std::sin(0.7 * x) * std::cos(0.9 * y)});
    }
  }
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      const std::uint32_t a = y * (cells + 1) + x, b = a + 1, c = a + cells + 1, d = c + 1;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, d}, {a, d, c}});
    }
  }
  return roam::World::build({&mesh, 1});
}

TEST(Asserts, HoldWhileABodyWalksAndFlies) {
  const roam::World world = hall();
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly}) {
    roam::Walker walker(world, {}, mode, {20.0, 20.0, 2.0});
    for (int i = 0; i < 600; ++i) {
      const double angle = 0.05 * i;
      walker.step({.velocity = 3.0 * Vec3(std::cos(angle), std::sin(angle), 0.1)}, 1.0 / 60.0);
    }
    EXPECT_GT(walker.report().axis_clearance, 0.0);
  }
  int hits = 0;
  for (int i = 0; i < 300; ++i) {
    const Vec3 from(0.13 * i, 39.0 - 0.12 * i, 4.0 + 0.01 * i);
    hits += world.sweep({.radius = i % 3 == 0 ? 0.0 : 0.4}, from, {0.1 * i, 3.0, -9.0}).hit ? 1 : 0;
    hits += world.clearance({.radius = 0.3, .half_height = 0.5}, from, 5.0).found ? 1 : 0;
  }
  EXPECT_GT(hits, 300);
}

TEST(AssertsDeathTest, AreThere) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  const roam::index::Index nothing;
  // A ray does not begin at roots that were gathered.
  EXPECT_DEATH(
      {
        (void)roam::index::first_impact(nothing, std::span<const roam::index::Root>(), {{.radius = 0.0}, Vec3(0.0), Vec3(1.0)});
      },
      "ssertion.*is_thin");
}

}  // namespace
