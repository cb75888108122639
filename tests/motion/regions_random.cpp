// Bodies of changing size, with and without a foot, at random in clutter: never a violation, the same bits, no memory.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <numbers>
#include <vector>

#include "counted_allocations.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::SizeRegion;

/// Clutter on a rough floor with gaps, and regions strewn over it.
struct Wild {
  Mesh mesh;
  std::vector<SizeRegion> regions;

  explicit Wild(std::uint64_t seed) {
    Random random(1000003 * seed);
    const Mesh tiles = rough_tiling(24, seed);
    for (std::size_t i = 0; i < tiles.triangles.size(); ++i) {
      roam::Triangle t = tiles.triangle(i);
      if (random.chance(0.01)) continue;
      for (Vec3& v : t) v.z = 0.05 * (std::sin(1.3 * v.x) + std::cos(1.7 * v.y));
      add_triangle(mesh, t[0], t[1], t[2]);
    }
    for (int i = 0; i < 25; ++i) {
      const Vec3 lo(random.between(-9.0, 9.0), random.between(-9.0, 9.0), random.chance(0.6) ? -0.1 : 1.3);
      if (std::abs(lo.x) < 2.0 && std::abs(lo.y) < 2.0) continue;
      add_box(mesh, lo, lo + Vec3(random.between(0.1, 2.0), random.between(0.1, 2.0), random.between(0.1, 1.5)));
    }
    for (int i = 0; i < 12; ++i) {
      const Vec3 lo(random.between(-9.0, 8.0), random.between(-9.0, 8.0), -1.0);
      regions.push_back({{lo, lo + Vec3(random.between(0.3, 4.0), random.between(0.3, 4.0), 4.0)},
                         random.between(0.1, 0.5),
                         random.chance(0.5) ? random.between(0.2, 0.8) : 0.0,
                         ""});
    }
  }
};

/// Walks at random and returns where it came.
std::vector<Vec3> wander(Walker& w, std::uint64_t seed, int count, const Judge* judge, int* changes = nullptr) {
  Random random(1000003 * seed);
  std::vector<Vec3> way;
  way.reserve(static_cast<std::size_t>(count));
  Vec3 v(0.0);
  double dt = frame;
  for (int i = 0; i < count; ++i) {
    if (i % 20 == 0) {
      const double a = random.between(0.0, 2.0 * std::numbers::pi), speed = std::pow(10.0, random.between(-0.4, 1.7));
      v = Vec3(speed * std::cos(a), speed * std::sin(a), speed * random.between(-0.2, 0.2));
      dt = random.between(1.0 / 240.0, 1.0 / 25.0);
    }
    const StepReport& r = w.step({v, random.chance(0.03), random.chance(0.03)}, dt);
    if (judge) {
      EXPECT_GE(margin(*judge, r), 0.0) << seed << " " << i;
    }
    if (changes) *changes += r.has(EventKind::narrowed) || r.has(EventKind::widened) ? 1 : 0;
    way.push_back(r.to);
    if (std::abs(r.to.x) > 9.0 || std::abs(r.to.y) > 9.0 || r.to.z < -3.0) {
      w.place({random.between(-1.5, 1.5), random.between(-1.5, 1.5), 1.1});
    }
  }
  return way;
}

TEST(Regions, NeverViolateInRandomClutter) {
  int changes = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    const Wild wild(seed);
    const World world = build(wild.mesh);
    const Judge judge(wild.mesh);
    WalkerSettings settings = seed % 3 == 0 ? WalkerSettings::sphere(0.4) : WalkerSettings{.radius = 0.35};
    if (seed % 2 == 0) settings.support_radius = 0.55;
    Walker w(world, settings, seed % 4 == 3 ? Mode::fly : Mode::walk, {0.0, 0.0, 1.1});
    w.set_regions(wild.regions);
    wander(w, seed, 300, &judge, &changes);
  }
  EXPECT_GT(changes, 200);
}

TEST(Regions, GiveTheSameBitsOnEveryRunAndAllocateNothing) {
  for (const std::uint64_t seed : {3U, 4U, 6U}) {
    const Wild wild(seed);
    const World world = build(wild.mesh);
    WalkerSettings settings{.radius = 0.35};
    settings.support_radius = 0.55;
    std::vector<Vec3> first;
    for (int run = 0; run < 2; ++run) {
      Walker w(world, settings, Mode::walk, {0.0, 0.0, 1.1});
      w.set_regions(wild.regions);
      const long before = allocations;
      const std::vector<Vec3> way = wander(w, seed, 400, nullptr);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
      EXPECT_EQ(allocations, before + 1);  // the list of places
#endif
      if (run == 0) first = way;
      EXPECT_EQ(way, first);
    }
  }
}

}  // namespace
