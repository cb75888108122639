// Many threads bring patches while one moves in them. Says most under the thread sanitizer.

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <thread>
#include <vector>

#include "roam/patchwork.h"
#include "walker_scenes.h"

namespace {

using roam::Box;
using roam::Mesh;
using roam::PatchId;
using roam::Patchwork;
using roam::Vec3;

constexpr int side = 12, threads = 4;

Box tile(int i) {
  const Vec3 at(i % side, i / side, 0.0);
  return {at, at + Vec3(1.0, 1.0, 0.5)};
}

roam::World floor_of(int i, double z) {
  Mesh m;
  m.name = std::to_string(i);
  const Box b = tile(i);
  scenes::add_floor(m, b.lower.x, b.lower.y, b.upper.x, b.upper.y, z);
  return scenes::build(m);
}

TEST(PatchworkThreads, BringPatchesWhileABodyMovesInThem) {
  Patchwork space;
  std::atomic<int> busy{threads};
  const auto load = [&](int thread) {
    for (int i = thread; i < side * side; i += threads) {
      const PatchId coarse = space.expect(tile(i));
      const PatchId fine = space.expect(tile(i), coarse);
      if (i % 5 == 0) space.fail(coarse, "try again");
      space.deliver(coarse, floor_of(i, 0.2));
      if (i % 3 == 0) space.fail(fine, "try again");
      EXPECT_THROW(space.deliver(coarse, roam::World()), roam::Error);
      space.deliver(fine, floor_of(i, 0.1));
    }
    --busy;
  };
  std::vector<std::thread> loaders;
  for (int i = 0; i < threads; ++i) loaders.emplace_back(load, i);
  std::thread watcher([&] {
    while (busy > 0) EXPECT_LE(space.stats().patches, std::uint64_t{side * side});
  });

  roam::Walker walker(space, roam::WalkerSettings::sphere(0.2), roam::Mode::fly, {6.0, 6.0, 2.0});
  scenes::Random random(61);
  long moved = 0;
  for (int step = 0; busy > 0 || step < 2000; ++step) {
    space.update(walker.body(), walker.position());
    const Vec3 to(random.between(0.0, side), random.between(0.0, side), random.between(-1.0, 2.0));
    const auto& r = walker.step({3.0 * (to - walker.position())}, 1.0 / 60.0);
    moved += r.to != r.from;
    // Queries may run at the same time as each other.
    std::thread other([&] { (void)space.clearance({0.3, 0.0}, to, 1.0); });
    (void)space.clearance({0.3, 0.0}, to, 1.0);
    other.join();
  }
  for (std::thread& t : loaders) t.join();
  watcher.join();
  space.update(walker.body(), {6.0, 6.0, 5.0});
  const auto stats = space.stats();
  EXPECT_EQ(stats.patches, std::uint64_t{side * side});
  EXPECT_EQ(stats.triangles, std::uint64_t{2 * side * side});
  EXPECT_EQ(stats.unknown + stats.failed + stats.coming + stats.waiting, 0u);
  EXPECT_GT(moved, 1000);
  for (int i = 0; i < side * side; ++i) {
    const auto s = space.sweep({0.1, 0.0}, tile(i).center() + Vec3(0.0, 0.0, 2.0), {0.0, 0.0, -3.0});
    ASSERT_TRUE(s.hit);
    EXPECT_NEAR(s.point.z, 0.1, 2e-3);
    EXPECT_EQ(space.object_name(s.triangle), std::to_string(i));
  }
}

}  // namespace
