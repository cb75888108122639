// What a world keeps of the meshes that it is built from, and what it refuses.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <limits>

#include "clutter.h"
#include "fallible_calls.h"
#include "roam/error.h"
#include "roam/world.h"

namespace {

using roam::Body;
using roam::BuildOptions;
using roam::Mesh;
using roam::Vec3;
using roam::World;

/// A square floor of n * n * 2 triangles of side `cell`, its lower corner at `corner`.
Mesh floor_mesh(int n, double cell, const Vec3& corner) {
  Mesh mesh;
  mesh.name = "floor";
  for (int y = 0; y <= n; ++y) {
    for (int x = 0; x <= n; ++x) mesh.vertices.push_back(corner + Vec3(x * cell, y * cell, 0.0));
  }
  const auto at = [n](int x, int y) { return static_cast<std::uint32_t>(y * (n + 1) + x); };
  for (int y = 0; y < n; ++y) {
    for (int x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
      mesh.triangles.push_back({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

World build(const Mesh& mesh, const BuildOptions& options = {}) { return World::build({&mesh, 1}, options); }

template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const roam::Error& e) {
    return e.what();
  }
  return "";
}

TEST(WorldBuild, HoldsEveryTriangleOnce) {
  clutter::Random random(3);
  Mesh mesh = clutter::make(random, {5000, 100.0, 1e-3, 100.0, {10.0, 20.0, 30.0}});
  const Mesh fine = floor_mesh(130, 0.05, {0.0, 0.0, 0.0});  // two tiles' worth in one cell
  const Mesh meshes[] = {mesh, fine, Mesh{}, mesh};
  const World world = World::build(meshes);
  const std::size_t count = 2 * mesh.triangles.size() + fine.triangles.size();
  ASSERT_EQ(world.stats().triangles, count);
  EXPECT_EQ(world.stats().objects, 4U);
  EXPECT_GT(world.stats().tiles, 2U);
  std::vector<roam::Contact> all(count + 1);
  ASSERT_EQ(world.contacts({}, {10.0, 20.0, 30.0}, Vec3(0.0), 1000.0, all), count);
  std::vector<bool> seen(count);
  for (std::size_t i = 0; i < count; ++i) {
    ASSERT_LT(all[i].triangle, count);
    ASSERT_FALSE(seen[all[i].triangle]);
    seen[all[i].triangle] = true;
  }
}

TEST(WorldBuild, KnowsTheObjectOfATriangle) {
  const Mesh meshes[] = {floor_mesh(2, 1.0, {0.0, 0.0, 0.0}), Mesh{"nothing", {}, {}},
                         floor_mesh(3, 1.0, {0.0, 0.0, -5.0})};
  const World world = World::build(meshes);
  EXPECT_EQ(world.object(0).id, 0U);
  EXPECT_EQ(world.object(7).id, 0U);
  EXPECT_EQ(world.object(8).id, 2U);
  EXPECT_EQ(world.object_name(8), "floor");
  const auto s = world.sweep({.radius = 0.2}, {2.3, 2.4, -0.0}, {0.0, 0.0, -10.0});
  ASSERT_TRUE(s.hit);
  EXPECT_EQ(world.object(s.triangle).id, 2U);
  EXPECT_NEAR(s.time, 0.48, 2e-4);
  EXPECT_EQ(s.feature, roam::Feature::face);
}

TEST(WorldBuild, KnowsNoObjectOfWhatIsNoTriangle) {
  roam::Mesh mesh{.name = "roof", .vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {{0, 1, 2}, {2, 1, 0}}};
  const World world = World::build({&mesh, 1});
  const roam::Impact miss = world.ray({0.2, 0.2, 1.0}, {0.0, 0.0, 1.0});
  ASSERT_FALSE(miss.hit);
  EXPECT_EQ(miss.triangle, roam::no_triangle);
  EXPECT_EQ(world.clearance({.radius = 0.1}, {0.0, 0.0, 9.0}, 1.0).triangle, roam::no_triangle);
  EXPECT_EQ(world.object_name(1), "roof");
  for (const roam::TriangleId none : {roam::TriangleId{2}, roam::no_triangle}) {
    EXPECT_EQ(world.object_name(none), "");
    EXPECT_EQ(World().object_name(none), "");
    EXPECT_EQ(world.object(none).id, roam::no_object);
  }
  EXPECT_EQ(World::build({&mesh, 1}, {.lossless = true}).object_name(0), "roof");
  EXPECT_EQ(World().object_name(0), "");
  EXPECT_EQ(World().object(0).id, roam::no_object);
}

TEST(WorldBuild, TakesFewBytes) {
  const World world = build(floor_mesh(500, 0.2, {0.0, 0.0, 0.0}));
  EXPECT_LE(double(world.stats().bytes) / double(world.stats().triangles), 12.0);
}

TEST(WorldBuild, CountsTheBytesOfObjects) {
  const Mesh floor = floor_mesh(100, 0.2, {0.0, 0.0, 0.0});
  std::vector<Mesh> rows(100);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    rows[i].vertices = floor.vertices;
    const auto from = floor.triangles.begin() + static_cast<std::ptrdiff_t>(200 * i);
    rows[i].triangles.assign(from, from + 200);
  }
  // Each object adds the number of its first triangle, and its user data.
  EXPECT_EQ(World::build(rows).stats().bytes, build(floor).stats().bytes + 99 * 2 * sizeof(std::uint64_t));
}

TEST(WorldBuild, FillsLeavesWithVertices) {
  // No triangle shares a vertex, so a leaf holds five.
  const Mesh floor = floor_mesh(100, 0.2, {0.0, 0.0, 0.0});
  Mesh apart;
  for (const auto& corners : floor.triangles) {
    const auto first = static_cast<std::uint32_t>(apart.vertices.size());
    const Vec3 lift(0.0, 0.0, 0.01 * (first % 2));
    for (const std::uint32_t v : corners) apart.vertices.push_back(floor.vertices[v] + lift);
    apart.triangles.push_back({first, first + 1, first + 2});
  }
  const World world = build(apart);
  EXPECT_LE(double(world.stats().bytes) / double(world.stats().triangles), 1.05 * 128.0 / 5.0);
}

TEST(WorldBuild, MovesNoVertexByAMillimetre) {
  clutter::Random random(4);
  for (const double large : {1.0, 1e3, 1e4}) {
    const World world = build(clutter::make(random, {2000, 500.0, 1e-4, large, Vec3(0.0)}));
    EXPECT_LT(world.stats().largest_error, 1e-3) << large;
    EXPECT_GT(world.stats().largest_error, 0.0) << large;
  }
  const World exact = build(clutter::make(random, {2000, 500.0, 1e-4, 1e4, Vec3(0.0)}),
                            {.threads = 0, .lossless = true, .progress = {}});
  EXPECT_LT(exact.stats().largest_error, 4e-6);
}

TEST(WorldBuild, GivesTheSameBitsForAnyNumberOfThreads) {
  clutter::Random random(5);
  const Mesh mesh = clutter::make(random, {60000, 100.0, 0.01, 20.0, {10.0, 20.0, 30.0}});
  const World one = build(mesh, {.threads = 1, .lossless = false, .progress = {}});
  for (const int threads : {2, 5}) {
    const World other = build(mesh, {.threads = threads, .lossless = false, .progress = {}});
    EXPECT_EQ(one.stats().bytes, other.stats().bytes);
    EXPECT_EQ(one.stats().tiles, other.stats().tiles);
    for (int q = 0; q < 3000; ++q) {
      const Vec3 from = random.in_box(110.0), motion = 10.0 * random.direction();
      const auto a = one.sweep({.radius = 0.1}, from, motion), b = other.sweep({.radius = 0.1}, from, motion);
      ASSERT_EQ(a.hit, b.hit);
      ASSERT_EQ(a.time, b.time);
      ASSERT_EQ(a.triangle, b.triangle);
      ASSERT_EQ(a.point, b.point);
      ASSERT_EQ(a.distance, b.distance);
    }
  }
}

TEST(WorldBuild, TellsItsProgressAndStopsWhenAsked) {
  const Mesh mesh = floor_mesh(300, 0.5, {0.0, 0.0, 0.0});
  std::vector<double> told;
  (void)build(mesh, {.threads = 0, .lossless = false, .progress = [&](double f) {
                       told.push_back(f);
                       return true;
                     }});
  ASSERT_GT(told.size(), 3U);
  EXPECT_GE(told.front(), 0.0);
  EXPECT_TRUE(std::is_sorted(told.begin(), told.end()));
  EXPECT_EQ(told.back(), 1.0);
  const BuildOptions stop{.threads = 0, .lossless = false, .progress = [](double f) { return f < 0.5; }};
  EXPECT_THROW((void)build(mesh, stop), roam::Cancelled);
}

// Instrumented builds have an operator new of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST(WorldBuild, ThrowsWhereverAnAllocationFails) {
  clutter::Random random(8);
  const Mesh mesh = clutter::make(random, {2000, 40.0, 0.01, 20.0, Vec3(0.0)});
  for (const int threads : {1, 2}) {
    const auto make = [&] { return build(mesh, {.threads = threads, .lossless = false, .progress = {}}); };
    // Nothing may hide that memory ran out, unless the world is whole all the same.
    fail_calls({{"build", [&] {
                   const World world = make();
                   EXPECT_GT(world.stats().tiles, 1U);
                   return std::string(Bits() << world.stats().triangles << world.stats().bytes);
                 }}});
  }
}
#endif

TEST(WorldBuild, RefusesWhatItCannotHold) {
  Mesh mesh = floor_mesh(1, 1.0, {0.0, 0.0, 0.0});
  mesh.triangles[1][2] = 7;
  EXPECT_EQ(refusal([&] { (void)build(mesh); }),
            "cannot build a world: triangle 1 of mesh 0 (\"floor\") uses vertex 7, but the mesh has 4 vertices");
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 2e9}) {
    mesh = floor_mesh(1, 1.0, {0.0, 0.0, 0.0});
    mesh.vertices[1].y = bad;
    EXPECT_NE(refusal([&] { (void)build(mesh); }).find("vertex 1 of mesh 0 (\"floor\")"), std::string::npos) << bad;
  }
  EXPECT_EQ(refusal([] { (void)World::build({}, {.threads = -5}); }),
            "cannot build a world: the number of threads is -5; it must be at least 1, or 0 for one per core");
}

TEST(World, IsFreeWhenEmpty) {
  const World world, built = World::build({});
  for (const World* w : {&world, &built}) {
    EXPECT_TRUE(w->bounds().empty());
    EXPECT_FALSE(w->sweep({}, {0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}).hit);
    EXPECT_FALSE(w->clearance({}, {0.0, 0.0, 0.0}, 5.0).found);
    EXPECT_EQ(w->clearance({}, {0.0, 0.0, 0.0}, 5.0).distance, 5.0);
    EXPECT_EQ(w->stats().triangles, 0U);
  }
}

TEST(World, RefusesQueriesThatMeanNothing) {
  const World world = build(floor_mesh(1, 1.0, {0.0, 0.0, 0.0}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const Vec3 o(0.0), x(1.0, 0.0, 0.0);
  EXPECT_THROW((void)world.sweep({.radius = -1.0}, o, x), roam::Error);
  EXPECT_THROW((void)world.sweep({.radius = nan}, o, x), roam::Error);
  EXPECT_THROW((void)world.sweep({.radius = 1001.0}, o, x), roam::Error);
  EXPECT_THROW((void)world.sweep({.radius = 1.0, .half_height = -1.0}, o, x), roam::Error);
  EXPECT_THROW((void)world.sweep({}, {nan, 0.0, 0.0}, x), roam::Error);
  EXPECT_THROW((void)world.sweep({}, o, {0.0, inf, 0.0}), roam::Error);
  EXPECT_THROW((void)world.clearance({}, o, -1.0), roam::Error);
  EXPECT_THROW((void)world.clearance({}, o, nan), roam::Error);
}

TEST(World, SweepsMotionsOfAnyLength) {
  const double far = 1e5;
  Mesh wall = floor_mesh(4, 10.0, {0.0, 0.0, 0.0});
  for (Vec3& v : wall.vertices) v = {far, v.x - 20.0, v.y - 20.0};
  const World world = build(wall);
  const auto s = world.sweep({.radius = 0.5}, {-3.0, 1.0, 1.0}, {far + 10.0, 0.0, 0.0});
  ASSERT_TRUE(s.hit);
  EXPECT_NEAR(s.time * (far + 10.0), far + 3.0 - 0.5, 2e-3);
  EXPECT_LE(s.time * (far + 10.0), far + 3.0 - 0.5);
  EXPECT_FALSE(world.sweep({.radius = 0.5}, {-3.0, 1.0, 21.0}, {far + 10.0, 0.0, 0.0}).hit);
  EXPECT_FALSE(world.sweep({.radius = 0.5}, {9e8, 1.0, 21.0}, {1.0, 0.0, 0.0}).hit) << "a start far outside";
  const auto short_step = world.sweep({.radius = 0.5}, {far - 0.502, 1.0, 1.0}, {1e-9, 0.0, 0.0});
  EXPECT_FALSE(short_step.hit);
}

TEST(World, RaysSlipThroughNoCrack) {
  clutter::Random random(6);
  const World world = build(floor_mesh(100, 0.7, {0.1, 0.2, 0.3}));
  for (int q = 0; q < 20000; ++q) {
    // Aimed at shared edges and corners.
    const Vec3 at{0.1 + 0.7 * std::floor(random.between(1.0, 99.0)),
                  0.2 + 0.35 * std::floor(random.between(2.0, 190.0)), 0.3};
    Vec3 way = random.direction();
    if (std::abs(way.z) < 0.05) continue;
    const auto s = world.ray(at - 2.0 * way, 4.0 * way);
    ASSERT_TRUE(s.hit);
    ASSERT_NEAR(s.point.z, 0.3, 2e-3);
  }
}

TEST(World, NamesTheDeepestTriangleOfAnEmbeddedBody) {
  const Mesh meshes[] = {floor_mesh(4, 1.0, {0.0, 0.0, 0.0}), floor_mesh(4, 1.0, {0.0, 0.0, 0.3})};
  const World world = World::build(meshes);
  const auto s = world.sweep({.radius = 0.5}, {2.0, 2.0, 0.4}, {1.0, 0.0, 0.0});
  ASSERT_TRUE(s.hit);
  EXPECT_EQ(s.time, 0.0);
  EXPECT_EQ(world.object(s.triangle).id, 1U);
  EXPECT_NEAR(s.distance, -0.4, 2e-3);
  EXPECT_NEAR(s.normal.z, 1.0, 1e-9);
}

}  // namespace
