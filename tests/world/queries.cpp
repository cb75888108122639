// Queries in scenes that are hard on the traversal, without allocation, and from many threads at once.

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "clutter.h"
#include "counted_allocations.h"
#include "oracle.h"
#include "roam/world.h"
#include "sanitizer.h"

namespace {

using roam::Mesh;
using roam::Vec3;
using roam::World;

/// A sphere of quads seen from inside: every place of it is equally near the middle.
Mesh dome(int n, double radius) {
  Mesh mesh;
  const auto direction = [](double u, double v) {  // rational: a cube's face pushed out to the sphere
    const double s = std::sqrt(1.0 + u * u + v * v);
    return Vec3(1.0, u, v) / s;
  };
  for (int face = 0; face < 6; ++face) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int j = 0; j <= n; ++j) {
      for (int i = 0; i <= n; ++i) {
        Vec3 d = direction(2.0 * i / n - 1.0, 2.0 * j / n - 1.0);
        if (face % 2 == 1) d.x = -d.x;
        const Vec3 turned = face / 2 == 0 ? d : face / 2 == 1 ? Vec3(d.y, d.x, d.z) : Vec3(d.y, d.z, d.x);
        mesh.vertices.push_back(radius * turned);
      }
    }
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int x, int y) { return first + static_cast<std::uint32_t>(y * (n + 1) + x); };
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
  return mesh;
}

/// Separate small triangles on a sphere: as many leaves as a tile can have, all equally near.
Mesh shell_of_specks(clutter::Random& random, int count, double radius) {
  Mesh mesh;
  for (int i = 0; i < count; ++i) {
    const Vec3 at = radius * random.direction();
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int c = 0; c < 3; ++c) mesh.vertices.push_back(at + random.in_box(0.05));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// From the middle of the mesh everything is `least` to `most` away.
void ask_from_the_middle(const Mesh& mesh, double least, double most) {
  const World world = World::build({&mesh, 1});
  const double r = 0.1 * least;
  for (const Vec3 motion : {Vec3(0.0), Vec3(0.01, 0.02, -0.01)}) {
    const auto near = world.clearance({.radius = r}, Vec3(0.0), motion, 2.0 * most);
    ASSERT_TRUE(near.found);
    EXPECT_GE(near.distance, least - r - 0.05);
    EXPECT_LE(near.distance, most - r);
    std::vector<roam::Contact> all(mesh.triangles.size() + 1);
    EXPECT_EQ(world.contacts({.radius = r}, Vec3(0.0), motion, 2.0 * most, all), mesh.triangles.size());
  }
  const auto out = world.sweep({.radius = r}, Vec3(0.0), {2.0 * most, 0.1, 0.1});
  EXPECT_TRUE(mesh.triangles.size() < 100000 || out.hit);
  EXPECT_TRUE(world.sweep({.radius = most}, Vec3(0.0), {0.0, 0.0, 0.0}).hit);
}

TEST(WorldQueries, StandHalfAMillionEquallyNearTriangles) { ask_from_the_middle(dome(200, 1.2), 1.19, 1.201); }

TEST(WorldQueries, StandALargeDome) { ask_from_the_middle(dome(200, 60.0), 59.9, 60.01); }

TEST(WorldQueries, StandAShellOfSpecks) {
  clutter::Random random(31);
  ask_from_the_middle(shell_of_specks(random, 16384, 9.5), 9.4, 9.6);
  ask_from_the_middle(shell_of_specks(random, 60000, 30.0), 29.9, 30.1);
}

TEST(WorldQueries, AreNotStoppedEarlyBySpecks) {
  clutter::Random random(32);
  for (const double size : {1e-6, 3e-5, 6e-5, 1e-4, 2e-4, 1e-3}) {
    for (int i = 0; i < 300; ++i) {
      Mesh mesh;
      const Vec3 at = random.in_box(3.0);
      for (int c = 0; c < 3; ++c) mesh.vertices.push_back(at + size * random.in_box(1.0));
      // Another far off makes the leaf's box wide, so that the box does not decide.
      for (int c = 0; c < 3; ++c) mesh.vertices.push_back(at + random.direction());
      mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
      const World world = World::build({&mesh, 1});
      const roam::Body body{0.3, i % 2 == 0 ? 0.0 : 0.5};
      const Vec3 way = random.direction(), from = at - 2.0 * way + 0.2 * random.direction();
      const auto s = world.sweep(body, from, 3.0 * way);
      if (!s.hit) continue;
      long double nearest = 1e9L;
      for (const std::size_t t : {0U, 1U}) {
        const auto d = oracle::distance_on_the_way<oracle::Quad>(body, from, 3.0 * way, s.time, mesh.triangle(t));
        nearest = std::min(nearest, static_cast<long double>(d));
      }
      ASSERT_LE(nearest, body.radius + 2e-3) << "size " << size << " case " << i;
      ASSERT_GE(nearest, body.radius - 1e-6) << "size " << size << " case " << i;
    }
  }
}

TEST(WorldQueries, KeepTheLosslessPromiseInWideSparseScenes) {
  clutter::Random random(33);
  for (const auto& [size, half] : {std::pair{1e3, 1.2e5}, std::pair{9e3, 2e6}}) {
    const Mesh mesh = clutter::make(random, {1500, half, 0.5 * size, size, Vec3(0.0)});
    const World world = World::build({&mesh, 1}, {.threads = 0, .lossless = true, .progress = {}});
    EXPECT_LT(world.stats().largest_error, 4e-6);
    const World stored = World::build({&mesh, 1});
    EXPECT_LT(stored.stats().largest_error, 1e-3);
  }
}

/// The six sides of a cube.
Mesh cube(const Vec3& middle, double half) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) {
    mesh.vertices.push_back(middle + half * Vec3(i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 1.0 : -1.0));
  }
  for (const std::uint32_t k : {1U, 2U, 4U}) {
    const std::uint32_t u = k == 1 ? 2 : 1, v = k == 4 ? 2 : 4;
    for (const std::uint32_t a : {0U, k}) {
      mesh.triangles.push_back({a, a + u, a + u + v});
      mesh.triangles.push_back({a, a + v, a + u + v});
    }
  }
  return mesh;
}

/// All of the motion lies outside the box of the world, and as near to its sides as counts.
TEST(WorldQueries, MeetTheSidesOfAWorldFromOutside) {
  constexpr double half = 7.3, touch = 2e-6, clear = 5e-3;  // m: deeper than a body may sink; farther than a hit may be
  for (const double far : {0.0, 4321.1, 6.4e6}) {
    const Vec3 middle(far, -0.7 * far, 0.3 * far);
    const Mesh mesh = cube(middle, half);
    const World world = World::build({&mesh, 1});
    for (int side = 0; side < 6; ++side) {
      for (const double half_height : {0.0, 0.6}) {
        const roam::Body body{0.4, half_height};
        const int k = side / 2;
        const double sign = side % 2 == 0 ? 1.0 : -1.0;
        Vec3 out(0.0), along(0.0);
        out[k] = sign * (half + body.radius + (k == 2 ? half_height : 0.0));
        along[(k + 1) % 3] = 1.0;
        out -= along;
        Vec3 slip(0.0);
        slip[k] = sign;
        EXPECT_TRUE(world.sweep(body, middle + out - touch * slip, 2.0 * along).hit) << far << " side " << side;
        EXPECT_TRUE(world.sweep(body, middle + out + slip, along - (1.0 + touch) * slip).hit)
            << far << " side " << side;
        EXPECT_FALSE(world.sweep(body, middle + out + clear * slip, 2.0 * along).hit) << far << " side " << side;
        EXPECT_FALSE(world.sweep(body, middle + out + slip, along - (1.0 - clear) * slip).hit)
            << far << " side " << side;
      }
    }
  }
}

TEST(WorldQueries, DoNotAllocate) {
  ROAM_NEEDS_PLAIN_MEMORY();
  clutter::Random random(34);
  const Mesh mesh = clutter::make(random, {3000, 10.0, 0.05, 3.0, Vec3(0.0)});
  const World world = World::build({&mesh, 1});
  std::vector<roam::Contact> contacts(64);
  const long before = allocations;
  std::size_t found = 0;
  for (int q = 0; q < 2000; ++q) {
    const roam::Body body{random.between(0.0, 0.3), q % 2 == 0 ? 0.0 : 0.5};
    const Vec3 from = random.in_box(10.0), motion = 3.0 * random.direction();
    found += world.sweep(body, from, motion).hit ? 1U : 0U;
    found += world.contacts(body, from, motion, 0.5, contacts);
    found += world.clearance(body, from, 1.0).found ? 1U : 0U;
    found += world.ray(from, 100.0 * motion).hit ? 1U : 0U;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(found, 2000U);
}

TEST(WorldQueries, AnswerManyThreadsAtOnce) {
  clutter::Random random(35);
  const Mesh mesh = clutter::make(random, {3000, 10.0, 0.05, 3.0, Vec3(0.0)});
  const World world = World::build({&mesh, 1});
  const auto ask = [&world] {
    clutter::Random queries(36);
    std::vector<double> answers;
    for (int q = 0; q < 3000; ++q) {
      const Vec3 from = queries.in_box(10.0), motion = 3.0 * queries.direction();
      answers.push_back(world.sweep({.radius = 0.2}, from, motion).time);
      answers.push_back(world.clearance({.radius = 0.2}, from, motion, 1.0).distance);
    }
    return answers;
  };
  const auto expected = ask();
  std::vector<std::vector<double>> answers(4);
  std::vector<std::thread> threads;
  for (auto& a : answers) threads.emplace_back([&a, &ask] { a = ask(); });
  for (auto& t : threads) t.join();
  for (const auto& a : answers) EXPECT_EQ(a, expected);
}

}  // namespace
