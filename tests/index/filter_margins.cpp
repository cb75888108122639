// The single-precision filter loses nothing where only its own margins protect it: vertices on the grid, so that no
// quantization error hides a slip, and bodies that graze by a micrometre.

#include <gtest/gtest.h>

#include <cmath>

#include "clutter.h"
#include "graze.h"
#include "oracle.h"
#include "roam/world.h"

namespace {

using clutter::cross;
using clutter::length;
using roam::Body;
using roam::Mesh;
using roam::Triangle;
using roam::Vec3;
using roam::World;

/// Metres: just more than World may let a body sink.
constexpr double depth = 1.2e-6;
constexpr double nearest_allowed = 1e-6;
constexpr int grazes = 20000;

/// Triangles a few metres wide on a grid of 2^-10 m, within 60 m.
Mesh on_grid(clutter::Random& random, int count) {
  Mesh mesh = clutter::make(random, {count, 28.0, 0.5, 14.0, Vec3(0.0)});
  for (Vec3& v : mesh.vertices) {
    for (int k = 0; k < 3; ++k) v[k] = std::round(v[k] * 1024.0) / 1024.0;
  }
  return mesh;
}

/// The same, each triangle in a plane of constant x, y or z: its boxes are as thin as it is.
Mesh on_planes(clutter::Random& random, int count) {
  Mesh mesh = on_grid(random, count);
  for (const auto& t : mesh.triangles) {
    const int k = static_cast<int>(random.engine() % 3);
    mesh.vertices[t[1]][k] = mesh.vertices[t[2]][k] = mesh.vertices[t[0]][k];
  }
  return mesh;
}

void graze_all(clutter::Random& random, const Mesh& mesh) {
  const World world = World::build({&mesh, 1});
  ASSERT_LT(world.stats().largest_error, 1e-12) << "quantization would hide what is tested";
  int tested = 0;
  for (int q = 0; q < grazes; ++q) {
    const Triangle t = mesh.triangle(random.engine() % mesh.triangles.size());
    if (!(length(cross(t[1] - t[0], t[2] - t[0])) > 1e-3)) continue;
    const Body body{std::pow(10.0, random.between(-1.3, 2.3)), q % 2 == 0 ? 0.0 : random.between(0.1, 1.0)};
    const clutter::Graze g = clutter::graze(random, t, body, depth, std::pow(10.0, random.between(-2.0, 1.75)));
    const long double d = oracle::distance_on_the_way(g.body, g.from, g.motion, g.time, t);
    if (d > g.body.radius - nearest_allowed) continue;  // rounding of the construction took it away
    ++tested;
    const auto s = world.sweep(g.body, g.from, g.motion);
    ASSERT_TRUE(s.hit) << q;
    ASSERT_LE(s.time, g.time) << q;
    if (s.time > 0.0) {
      ASSERT_GE(oracle::distance_on_the_way(g.body, g.from, g.motion, s.time, t), g.body.radius - nearest_allowed) << q;
    }
    const auto near = world.clearance(g.body, g.from + g.time * g.motion, 0.0);
    ASSERT_TRUE(near.found) << q;
    ASSERT_LE(world.gap_bound(g.body, g.from, g.motion, 1.0), 0.0) << q;
    ASSERT_LE(world.gap_bound(g.body, g.from, g.motion, 1e-4), 0.0) << q;
  }
  EXPECT_GT(tested, grazes / 4);
}

/// Rays through corners, edges and faces: through the closed triangle, but for roundings of doubles.
void pierce_all(clutter::Random& random, const Mesh& mesh, const Vec3& place) {
  Mesh there = mesh;
  for (Vec3& v : there.vertices) v += place;
  const World world = World::build({&there, 1});
  ASSERT_LT(world.stats().largest_error, 1e-11) << "quantization would hide what is tested";
  for (int q = 0; q < 4 * grazes; ++q) {
    const Triangle t = there.triangle(random.engine() % there.triangles.size());
    const double u = q % 3 == 0 ? 0.0 : random.unit(), v = q % 3 == 2 ? random.unit() * (1.0 - u) : 0.0;
    const Vec3 point = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    Vec3 way = random.direction() * std::pow(10.0, random.between(-3.0, 1.75));
    if (q % 5 == 0) way[q % 3] = 0.0;
    if (q % 7 == 0) way = t[2] - t[1] + 1e-3 * way;  // hardly across
    const double time = random.between(0.01, 0.99);
    const auto s = world.ray(point - time * way, way);
    ASSERT_TRUE(s.hit) << q;
    ASSERT_LE(s.time, time + 1e-9 / length(way)) << q;
  }
}

TEST(FilterMargins, LoseNoTriangleThatARayPierces) {
  clutter::Random random(24);
  pierce_all(random, on_grid(random, 400), Vec3(0.0));
  pierce_all(random, on_planes(random, 400), Vec3(-13739.0, 253.0, 182.0));
  for (int i = 0; i < 20; ++i) pierce_all(random, on_planes(random, 12), Vec3(0.0));
}

TEST(FilterMargins, LoseNoGrazeOfAMicrometre) {
  clutter::Random random(21);
  graze_all(random, on_grid(random, 400));
}

TEST(FilterMargins, LoseNoGrazeOfAThinBox) {
  clutter::Random random(22);
  graze_all(random, on_planes(random, 400));
}

TEST(FilterMargins, LoseNoGrazeOfALonelyTriangle) {
  clutter::Random random(23);
  for (int i = 0; i < 40; ++i) graze_all(random, on_planes(random, 12));
}

}  // namespace
