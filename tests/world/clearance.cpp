// Clearances beside dense rough walls, where thousands of triangles are about equally near and only a few are looked at
// exactly: judged by brute force over all of them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "clutter.h"
#include "counted_allocations.h"
#include "oracle.h"
#include "roam/world.h"
#include "sanitizer.h"

namespace {

using clutter::Random;
using roam::Body;
using roam::Mesh;
using roam::Vec3;
using roam::World;

/// What Space promises (m): no more than the true gap, but for this, and no less than it by more than that.
constexpr double above = 1e-6;
constexpr double below_all = 2e-3;
constexpr double below_lossless = 1e-5;

Vec3 cross(const Vec3& a, const Vec3& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
Vec3 unit_of(const Vec3& v) { return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z); }

/// A square wall through `centre`, turned at random.
struct Wall {
  Vec3 centre, normal, along, up;
  Mesh mesh;

  Wall(Random& random, const Vec3& middle, int cells, double width, double roughness)
      : centre(middle), normal(random.direction()), along(unit_of(cross(normal, random.direction()))) {
    up = cross(normal, along);
    for (int j = 0; j <= cells; ++j) {
      for (int i = 0; i <= cells; ++i) {
        mesh.vertices.push_back(centre + along * (width * (double(i) / cells - 0.5)) +
                                up * (width * (double(j) / cells - 0.5)) +
                                normal * random.between(-roughness, roughness));
      }
    }
    for (int j = 0; j < cells; ++j) {
      for (int i = 0; i < cells; ++i) {
        const auto at = [&](int x, int y) { return static_cast<std::uint32_t>(y * (cells + 1) + x); };
        mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
        mesh.triangles.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
      }
    }
  }
};

double true_gap(const Mesh& mesh, const Body& body, const Vec3& from, const Vec3& motion) {
  long double least = 1e9L;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const roam::Triangle t = mesh.triangle(i);
    // What is certainly farther than the least so far needs no closer look.
    long double apart = 0.0L;
    for (int k = 0; k < 3; ++k) {
      const double h = k == 2 ? body.half_height : 0.0;
      const double lower = std::min(from[k], from[k] + motion[k]) - h,
                   upper = std::max(from[k], from[k] + motion[k]) + h;
      const double a = std::min({t[0][k], t[1][k], t[2][k]}), b = std::max({t[0][k], t[1][k], t[2][k]});
      apart = std::max<long double>(apart, std::max(a - upper, lower - b));
    }
    if (apart <= least) least = std::min(least, oracle::least_distance(body, from, motion, 1.0, t));
  }
  return double(least - (long double)(body.radius));
}

/// Bodies that stand beside the wall and move along it.
void ask_beside(Random& random, const Wall& wall, bool lossless, int queries) {
  const World world = World::build({&wall.mesh, 1}, {.threads = 0, .lossless = lossless, .progress = {}});
  const double error = world.stats().largest_error, below = lossless ? below_lossless : below_all;
  int found = 0, near = 0;
  for (int q = 0; q < queries; ++q) {
    const Body body{random.between(0.0, 0.4), q % 3 == 2 ? random.between(0.05, 0.9) : 0.0};
    const double away = body.radius + body.half_height * std::abs(wall.normal.z) +
                        (q % 4 == 0 ? random.between(-0.1, 1.2) : 0.05 * random.unit());
    const Vec3 from = wall.centre + wall.along * random.between(-1.0, 1.0) + wall.up * random.between(-1.0, 1.0) +
                      wall.normal * (q % 2 == 0 ? away : -away);
    Vec3 motion(0.0);
    if (q % 5 != 0) {
      const double turn = random.between(0.0, 6.3), length = std::pow(10.0, random.between(-3.0, 0.3));
      motion = length * (std::cos(turn) * wall.along + std::sin(turn) * wall.up);
      if (q % 5 == 1) motion += random.between(0.0, 0.3) * length * (q % 2 == 0 ? wall.normal : -wall.normal);
      if (q % 50 == 2) motion = 100.0 * motion / length;  // in pieces
    }
    const double reach = q % 7 == 0 ? random.between(0.0, 0.2) : 1.0;
    const roam::Clearance c = world.clearance(body, from, motion, reach);
    const double gap = true_gap(wall.mesh, body, from, motion);
    const double bound = world.gap_bound(body, from, motion, reach);
    if (gap > -body.radius) {
      ASSERT_LE(bound, gap + above) << q;
    }
    if (gap > below - body.radius) {
      ASSERT_GE(bound, std::min(reach, gap - std::abs(gap) / 8.0 - below)) << q;
    }
    if (bound > 0.0 && bound < reach) {
      ASSERT_LE(gap, bound * (8.0 / 7.0) + below) << q;
    }
    if (!c.found) {
      ASSERT_EQ(bound, reach) << q;
      ASSERT_EQ(c.distance, reach) << q;
      ASSERT_GE(gap, reach - above) << q;
      continue;
    }
    ++found;
    if (gap > -body.radius) {
      ASSERT_LE(c.distance, gap + above) << q;
    }
    if (gap <= below - body.radius) continue;  // the axis may meet a stored triangle: depth is not distance
    ASSERT_GE(c.distance, gap - below) << q;
    // What is near is told exactly, and never as a touch.
    if (gap > 0.0) {
      near += gap < 0.03 ? 1 : 0;
      ASSERT_GE(c.distance, gap * (15.0 / 16.0) - 2.0 * error - above) << q;
    }
    // The triangle that is named is about the nearest.
    const roam::Triangle named = wall.mesh.triangle(static_cast<std::size_t>(c.triangle));
    ASSERT_LE(double(oracle::least_distance(body, from, motion, 1.0, named)) - body.radius, gap + below + above) << q;
  }
  EXPECT_GT(found, queries / 2);
  EXPECT_GT(near, queries / 20);
}

TEST(Clearance, OfARoughWallIsCertifiedAndTight) {
  Random random(61);
  for (const double origin : {0.0, 13739.0, 1e5, 6.4e6}) {
    for (const double roughness : {0.0, 0.002, 0.025}) {
      SCOPED_TRACE(testing::Message() << "at " << origin << ", rough by " << roughness);
      const Vec3 middle(origin, -0.7 * origin, 0.3 * origin);
      ask_beside(random, Wall(random, middle, 60, 2.5, roughness), false, 150);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST(Clearance, OfALosslessWallIsCertifiedToTenMicrometres) {
  Random random(62);
  for (const double origin : {0.0, 6.4e6}) {
    SCOPED_TRACE(origin);
    ask_beside(random, Wall(random, Vec3(origin), 60, 2.5, 0.01), true, 150);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Clearance, OfAWallWithTrianglesOfManySizes) {
  Random random(63);
  for (int i = 0; i < 6; ++i) {
    Wall wall(random, Vec3(300.0, 20.0, -7.0), 30, 2.5, 0.02);
    // Large ones behind it, which are not nearest, and clutter, which may be.
    const Mesh more = clutter::make(random, {300, 3.0, 1e-3, 30.0, wall.centre});
    const auto first = static_cast<std::uint32_t>(wall.mesh.vertices.size());
    wall.mesh.vertices.insert(wall.mesh.vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& t : more.triangles) wall.mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
    ask_beside(random, wall, false, 150);
    if (testing::Test::HasFatalFailure()) return;
  }
}

TEST(Queries, DoNotAllocate) {
  ROAM_NEEDS_PLAIN_MEMORY();
  Random random(64);
  const Wall wall(random, Vec3(0.0), 60, 2.5, 0.02);
  const World world = World::build({&wall.mesh, 1});
  std::vector<roam::Contact> contacts(16);
  const long before = allocations;
  std::size_t met = 0, near = 0;
  for (int i = 0; i < 500; ++i) {
    const Body body{random.between(0.0, 0.3), i % 2 == 0 ? 0.0 : 0.5};
    const Vec3 from = random.in_box(1.0), motion = random.between(0.1, 100.0) * random.direction();
    met += world.sweep(body, from, motion).hit ? 1U : 0U;
    near += world.gap_bound(body, from, motion, 1.0) < 1.0 ? 1U : 0U;
    near += world.clearance(body, from, motion, 1.0).found ? 1U : 0U;
    near += world.contacts(body, from, motion, 0.5, contacts);
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(met, 100U);
  EXPECT_GT(near, 1000U);
}

}  // namespace
