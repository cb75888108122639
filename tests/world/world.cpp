// The world against brute force: whatever it says is free is free, and whatever it hits is there.

#include "roam/world.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/vector_relational.hpp>

#include "clutter.h"
#include "judged_queries.h"
#include "oracle.h"
#include "roam/error.h"
#include "test_seed.h"

namespace {

using clutter::Random;
using judged::farthest_lossless;
using judged::farthest_off;
using judged::judge_gap;
using judged::nearest_allowed;
using roam::Body;
using roam::Box;
using roam::Mesh;
using roam::Triangle;
using roam::Vec3;
using roam::World;

struct SweepCase {
  const char* name;
  clutter::Recipe scene;
  bool lossless = false;
};

/// The axis' least distance to all triangles over [0, t] of a motion.
long double least_distance(const Mesh& mesh, const Body& body, const Vec3& from, const Vec3& motion, double t) {
  long double least = std::numeric_limits<long double>::infinity();
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    least = std::min(least, oracle::least_distance(body, from, motion, t, mesh.triangle(i)));
  }
  return least;
}

class WorldAgainstBruteForce : public testing::TestWithParam<SweepCase> {};

TEST_P(WorldAgainstBruteForce, SweepsAreNeverLateAndNeverEarlyByMoreThanTheGrid) {
  const clutter::Recipe& c = GetParam().scene;
  Random random(test_seed(7));
  const Mesh mesh = clutter::make(random, c);
  const World world = World::build({&mesh, 1}, {.threads = 0, .lossless = GetParam().lossless, .progress = {}});
  const double farthest = GetParam().lossless ? farthest_lossless : farthest_off;
  int hits = 0, misses = 0, embedded = 0;
  for (int q = 0; q < 1500; ++q) {
    const Body body{random.between(0.0, 0.05) * c.half, q % 2 == 0 ? 0.0 : random.between(0.0, 0.1) * c.half};
    const Vec3 from = c.centre + random.in_box(1.2 * c.half);
    const Vec3 motion = random.direction() * (c.half * std::pow(10.0, random.between(-4.0, 0.5)));
    const auto s = world.sweep(body, from, motion);
    if (s.hit && s.time == 0.0) {
      ++embedded;
      const long double d = least_distance(mesh, body, from, motion, 0.0);
      ASSERT_LE(d, body.radius + farthest) << "query " << q;
      ASSERT_LE(s.distance, double(d) - body.radius + nearest_allowed);
      continue;
    }
    ASSERT_GE(least_distance(mesh, body, from, motion, s.time), body.radius - nearest_allowed) << "query " << q;
    if (!s.hit) {
      ++misses;
      continue;
    }
    ++hits;
    const Triangle touched = mesh.triangle(static_cast<std::size_t>(s.triangle));
    ASSERT_LE(oracle::distance_on_the_way(body, from, motion, s.time, touched), body.radius + farthest)
        << "query " << q << " time " << s.time;
    ASSERT_GE(s.distance, 0.0);
    ASSERT_NEAR(std::sqrt(s.normal.x * s.normal.x + s.normal.y * s.normal.y + s.normal.z * s.normal.z), 1.0, 1e-12);
    ASSERT_LE(oracle::distance(Body{0.0, 0.0}, s.point, touched), farthest);
  }
  EXPECT_GT(hits, 50);
  EXPECT_GT(misses, 50);
  EXPECT_GT(embedded, 5);
}

TEST_P(WorldAgainstBruteForce, ClearanceIsALowerBoundAndTight) {
  const clutter::Recipe& c = GetParam().scene;
  Random random(test_seed(8));
  const Mesh mesh = clutter::make(random, c);
  const World world = World::build({&mesh, 1}, {.threads = 0, .lossless = GetParam().lossless, .progress = {}});
  const double farthest = GetParam().lossless ? farthest_lossless : farthest_off;
  for (int q = 0; q < 600; ++q) {
    const Body body{random.between(0.0, 0.02) * c.half, q % 2 == 0 ? 0.0 : random.between(0.0, 0.1) * c.half};
    const Vec3 from = c.centre + random.in_box(1.5 * c.half);
    const Vec3 motion = q % 3 == 0 ? Vec3(0.0) : random.direction() * (0.3 * c.half * random.unit());
    const double reach = std::min(World::reach_limit, random.between(0.01, 1.0) * c.half);
    const auto near = world.clearance(body, from, motion, reach);
    const double gap = double(least_distance(mesh, body, from, motion, 1.0) - (long double)(body.radius));
    if (gap > -body.radius) {
      ASSERT_LE(near.distance, std::max(gap, 0.0) + nearest_allowed) << "query " << q;
    }
    judge_gap(world.gap_bound(body, from, motion, reach), gap, body, reach);
    ASSERT_FALSE(HasFatalFailure()) << "query " << q;
    if (!near.found) {
      ASSERT_GE(gap, reach - farthest) << "query " << q;
      ASSERT_EQ(near.distance, reach);
    } else if (gap > farthest - body.radius) {  // the axis meets no stored triangle: depth is distance
      ASSERT_GE(near.distance, gap - farthest) << "query " << q;
    }
  }
}

TEST_P(WorldAgainstBruteForce, ContactsAreAllTrianglesWithinReach) {
  const clutter::Recipe& c = GetParam().scene;
  Random random(test_seed(9));
  const Mesh mesh = clutter::make(random, c);
  const World world = World::build({&mesh, 1}, {.threads = 0, .lossless = GetParam().lossless, .progress = {}});
  const double farthest = GetParam().lossless ? farthest_lossless : farthest_off;
  std::vector<roam::Contact> contacts(mesh.triangles.size() + 1);
  for (int q = 0; q < 100; ++q) {
    const Body body{random.between(0.0, 0.02) * c.half, q % 2 == 0 ? 0.0 : random.between(0.0, 0.1) * c.half};
    const Vec3 from = c.centre + random.in_box(c.half);
    const Vec3 motion = q % 3 == 0 ? Vec3(0.0) : random.direction() * (0.3 * c.half * random.unit());
    const double reach = random.between(0.01, 0.2) * c.half;
    const std::size_t count = world.contacts(body, from, motion, reach, contacts);
    std::vector<bool> found(mesh.triangles.size());
    for (std::size_t i = 0; i < count; ++i) {
      const auto t = static_cast<std::size_t>(contacts[i].triangle);
      ASSERT_FALSE(found[t]) << "a triangle twice";
      found[t] = true;
      if (i > 0) {
        ASSERT_LE(contacts[i - 1].distance, contacts[i].distance);
      }
      ASSERT_LE(oracle::least_distance(body, from, motion, 1.0, mesh.triangle(t)), body.radius + reach + farthest);
    }
    for (std::size_t t = 0; t < found.size(); ++t) {
      if (found[t]) continue;
      ASSERT_GE(oracle::least_distance(body, from, motion, 1.0, mesh.triangle(t)),
                body.radius + reach - nearest_allowed)
          << "query " << q << " triangle " << t;
    }
    const std::size_t few = std::min<std::size_t>(count, 3);
    std::array<roam::Contact, 3> nearest;
    ASSERT_EQ(world.contacts(body, from, motion, reach, nearest), few);
    for (std::size_t i = 0; i < few; ++i) ASSERT_EQ(nearest[i].distance, contacts[i].distance);
  }
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, WorldAgainstBruteForce,
    testing::Values(SweepCase{"AtTheOrigin", {600, 5.0, 0.05, 3.0, Vec3(0.0)}},
                    SweepCase{"InThePapersGallery", {600, 5.0, 0.05, 3.0, {-13739.0, 253.0, 182.0}}},
                    SweepCase{"At1e5", {600, 20.0, 0.01, 10.0, {1e5, -1e5, 40.0}}},
                    SweepCase{"At6400km", {600, 5.0, 0.05, 3.0, {4.1e6, 4.8e6, 6.4e6}}},
                    SweepCase{"AllSizes", {900, 3000.0, 1e-4, 1e4, {300.0, 20.0, -7.0}}},
                    SweepCase{"Huge", {400, 40.0, 20.0, 1e4, {300.0, 20.0, -7.0}}},
                    SweepCase{"Tiny", {500, 0.01, 1e-5, 5e-3, {1.0, 2.0, 3.0}}},
                    SweepCase{"Lossless", {600, 5.0, 0.05, 3.0, {10.0, 20.0, 30.0}}, true},
                    SweepCase{"LosslessAt6400km", {600, 5.0, 0.05, 3.0, {4.1e6, 4.8e6, 6.4e6}}, true},
                    SweepCase{"LosslessAllSizes", {900, 3000.0, 1e-4, 1e4, {300.0, 20.0, -7.0}}, true}),
    [](const auto& param) { return param.param.name; });

/// Where two tiles are about equally near, what one of them leaves out may decide. Motions are short: before longer
/// ones no boxes are asked in whole numbers.
TEST(World, GapsAreLowerBoundsWhereTilesAreAboutEquallyNear) {
  Random random(10);
  for (int scene = 0; scene < 10; ++scene) {
    const clutter::Recipe recipe{100, 1000.0, 0.5, 100.0, {300.0, 20.0, -7.0}};
    const Mesh mesh = clutter::make(random, recipe);
    const World world = World::build({&mesh, 1});
    ASSERT_GT(world.stats().tiles, 4U);
    for (int q = 0; q < 500; ++q) {
      const Body body{random.between(0.0, 2.0), q % 2 == 0 ? 0.0 : random.between(0.0, 2.0)};
      const Vec3 from = recipe.centre + random.in_box(1.2 * recipe.half);
      const Vec3 motion = q % 3 == 0 ? Vec3(0.0) : random.between(0.0, 4.0) * random.direction();
      const double reach = std::min(World::reach_limit, random.between(0.3, 1.0) * recipe.half);
      const double gap = double(least_distance(mesh, body, from, motion, 1.0) - (long double)(body.radius));
      judge_gap(world.gap_bound(body, from, motion, reach), gap, body, reach);
      ASSERT_FALSE(HasFatalFailure()) << "scene " << scene << " query " << q;
    }
  }
}

/// Few tiles are visited in any order, so none of them may keep another from being asked.
TEST(World, SweepsAreNeverLateWhereSeveralTilesAreMet) {
  Random random(11);
  const Mesh mesh = clutter::make(random, {70000, 20.0, 0.01, 5.0, {300.0, 20.0, -7.0}});
  const World world = World::build({&mesh, 1});
  ASSERT_GT(world.stats().tiles, 4U);
  std::vector<Box> boxes(mesh.triangles.size());
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (const Vec3& corner : mesh.triangle(i)) boxes[i].include(corner);
  }
  int met = 0;
  for (int q = 0; q < 10000; ++q) {
    const Body body{random.between(0.0, 0.1), 0.0};
    const Vec3 from = Vec3(300.0, 20.0, -7.0) + random.in_box(19.0);
    const Vec3 motion = random.between(0.5, 4.0) * random.direction();
    const auto s = world.sweep(body, from, motion);
    if (s.hit && s.time == 0.0) continue;
    met += s.hit ? 1 : 0;
    Box way;
    way.include(from);
    way.include(from + s.time * motion);
    way = way.grown(body.radius);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      const Box& box = boxes[i];
      if (glm::any(glm::lessThan(way.upper, box.lower)) || glm::any(glm::lessThan(box.upper, way.lower))) continue;
      ASSERT_GE(oracle::least_distance(body, from, motion, s.time, mesh.triangle(i)), body.radius - nearest_allowed)
          << "query " << q;
    }
  }
  EXPECT_GT(met, 2000);
}

}  // namespace
