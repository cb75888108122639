// A patchwork of many small worlds answers as one world of all of it does, and as brute force says; so does the
// unknown.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numeric>
#include <tuple>
#include <vector>

#include "clutter.h"
#include "counted_allocations.h"
#include "oracle.h"
#include "roam/patchwork.h"
#include "sanitizer.h"
#include "walker_scenes.h"

namespace {

using roam::Body;
using roam::Box;
using roam::Contact;
using roam::Mesh;
using roam::PatchId;
using roam::Patchwork;
using roam::Vec3;
using roam::World;

/// A mesh cut into one patch for each cell of a cubic grid that holds the first corner of a triangle.
struct Pieces {
  Mesh whole;
  std::vector<Mesh> parts;
  std::vector<std::vector<std::size_t>> source;  ///< of each part's triangles in the whole

  Pieces(const Mesh& mesh, double cell) : whole(mesh) {
    std::map<std::tuple<long, long, long>, std::size_t> cells;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
      const roam::Triangle corner = mesh.triangle(t);
      const std::tuple key(std::lround(corner[0].x / cell), std::lround(corner[0].y / cell),
                           std::lround(corner[0].z / cell));
      const auto [at, fresh] = cells.emplace(key, parts.size());
      if (fresh) {
        parts.emplace_back().name = mesh.name;
        source.emplace_back();
      }
      scenes::add_triangle(parts[at->second], corner[0], corner[1], corner[2]);
      source[at->second].push_back(t);
    }
  }

  [[nodiscard]] Box box(std::size_t part) const {
    Box b;
    for (const Vec3& v : parts[part].vertices) b.include(v);
    return b;
  }
  [[nodiscard]] std::size_t source_of(roam::TriangleId id) const {
    return source[static_cast<std::size_t>(Patchwork::patch(id)) - 1][Patchwork::triangle_in_patch(id)];
  }
  void expect_all(Patchwork& space) const {
    for (std::size_t i = 0; i < parts.size(); ++i) (void)space.expect(box(i));
  }
  void deliver(Patchwork& space, std::size_t part, bool lossless = false) const {
    space.deliver(PatchId{part + 1}, scenes::build(parts[part], lossless));
  }
};

double true_distance(const Mesh& mesh, const Body& body, const Vec3& from, const Vec3& motion, double until) {
  long double least = 1e30L;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    least = std::min(least, oracle::least_distance(body, from, motion, until, mesh.triangle(t)));
  }
  return static_cast<double>(least);
}

/// What space.h promises of a sweep, judged by brute force.
void judge_sweep(const Mesh& mesh, const Body& body, const Vec3& from, const Vec3& motion, const roam::Impact& s) {
  const double on_the_way = true_distance(mesh, body, from, motion, s.time);
  if (s.hit && s.time == 0.0) {
    EXPECT_LE(on_the_way, body.radius + 2e-3);
    return;
  }
  EXPECT_GE(on_the_way, body.radius - 1e-6);
  if (!s.hit) return;
  long double there = 1e30L;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    there = std::min(there, oracle::distance_on_the_way(body, from, motion, s.time, mesh.triangle(t)));
  }
  EXPECT_LE(there, body.radius + 2e-3L);
}

bool same(const roam::Proximity& a, const roam::Proximity& b) {
  return a.point == b.point && a.normal == b.normal && a.feature == b.feature && a.distance == b.distance;
}

bool same(const Contact& a, const Contact& b) {
  return same(static_cast<const roam::Proximity&>(a), b) && a.triangle == b.triangle && a.unknown == b.unknown;
}

TEST(PatchworkQueries, AnswerAsOneWorldDoes) {
  clutter::Random random(41);
  for (const Vec3 centre : {Vec3(0.0), Vec3(6.4e6, -6.4e6, 2e3)}) {
    for (const bool lossless : {false, true}) {
      const Pieces pieces(clutter::make(random, {900, 6.0, 0.05, 2.0, centre}), 1.7);
      ASSERT_GT(pieces.parts.size(), 100u);
      const World world = scenes::build(pieces.whole, lossless);
      Patchwork space;
      pieces.expect_all(space);
      for (std::size_t i = 0; i < pieces.parts.size(); ++i) pieces.deliver(space, i, lossless);
      space.update();
      const double stored = lossless ? 2e-5 : 2e-3;
      int hits = 0, same_triangle = 0;
      std::vector<Contact> all(2000), some(2000);
      for (int q = 0; q < 400; ++q) {
        const Body body{random.between(0.0, 0.4), q % 2 == 0 ? 0.0 : 0.5};
        const Vec3 from = centre + random.in_box(7.0);
        const Vec3 motion = q % 7 == 0 ? Vec3(0.0) : random.between(0.1, 8.0) * random.direction();
        const auto s = space.sweep(body, from, motion), w = world.sweep(body, from, motion);
        if (q < 60) judge_sweep(pieces.whole, body, from, motion, s);
        hits += s.hit && w.hit;
        same_triangle += s.hit && w.hit && pieces.source_of(s.triangle) == w.triangle;
        const double length = std::sqrt(motion.x * motion.x + motion.y * motion.y + motion.z * motion.z);
        if (s.hit && w.hit && w.time > 0.0 && s.time > 0.0) {
          // A hit at time t is of a body that is that far from it, and it comes nearer at least this fast.
          const double speed = std::max(1e-3, -(w.normal.x * motion.x + w.normal.y * motion.y + w.normal.z * motion.z));
          const double tolerance = speed > 0.5 * length ? 4.0 * stored + 1e-6 : length;
          EXPECT_NEAR(s.time * length, w.time * length, tolerance);
        }

        const double reach = random.between(0.0, 1.0);
        const auto near = space.clearance(body, from, motion, reach),
                   of_world = world.clearance(body, from, motion, reach);
        EXPECT_LE(of_world.distance, near.distance + stored);
        EXPECT_GE(of_world.distance, near.distance - stored - 2e-3);  // a world need not look for the nearest of all
        const std::size_t n = space.contacts(body, from, motion, reach, all);
        const std::size_t m = world.contacts(body, from, motion, reach, some);
        ASSERT_LT(n, all.size());
        std::map<std::size_t, double> found;
        for (std::size_t i = 0; i < n; ++i) {
          EXPECT_TRUE(found.emplace(pieces.source_of(all[i].triangle), all[i].distance).second) << "twice";
          if (i > 0) {
            EXPECT_TRUE(std::tie(all[i - 1].distance, all[i - 1].triangle) <
                        std::tie(all[i].distance, all[i].triangle));
          }
        }
        for (std::size_t i = 0; i < m; ++i) {
          const auto it = found.find(some[i].triangle);
          if (it == found.end()) {
            EXPECT_GT(some[i].distance, reach - stored);
          } else {
            EXPECT_NEAR(it->second, some[i].distance, stored);
          }
        }
        if (n > 0 && motion == Vec3(0.0)) {
          EXPECT_TRUE(same(near, all[0]) && near.triangle == all[0].triangle);
        }
        // A shorter list holds the nearest of the longer one.
        for (const std::size_t room : {std::size_t{1}, n / 2, n, n + 1}) {
          const std::size_t written = space.contacts(body, from, motion, reach, {some.data(), room});
          ASSERT_EQ(written, std::min(room, n));
          for (std::size_t i = 0; i < written; ++i) ASSERT_TRUE(same(some[i], all[i]));
        }
      }
      EXPECT_GT(hits, 100);
      EXPECT_GT(same_triangle, hits * 9 / 10);
    }
  }
}

TEST(PatchworkQueries, StandLongMotions) {
  clutter::Random random(42);
  const double half = 4e5;
  const Vec3 flat(1.0, 1.0, 0.005);  // a landscape
  Mesh landscape = clutter::make(random, {1500, half, 5e3, 6e4, Vec3(0.0)});
  for (Vec3& v : landscape.vertices) v *= flat;
  const Pieces pieces(landscape, 4e4);
  Patchwork space;
  pieces.expect_all(space);
  for (std::size_t i = 0; i < pieces.parts.size(); ++i) pieces.deliver(space, i);
  space.update();
  int hits = 0;
  std::vector<Contact> contacts(1000);
  for (int q = 0; q < 150; ++q) {
    const Body body{random.between(0.0, 900.0), q % 2 == 0 ? 0.0 : 300.0};
    const Vec3 from = flat * random.in_box(half);
    const Vec3 motion = flat * std::pow(10.0, random.between(3.0, 6.0)) * random.direction();
    const auto s = space.sweep(body, from, motion);
    hits += s.hit && s.time > 0.0;
    judge_sweep(pieces.whole, body, from, motion, s);
    const auto c = space.clearance(body, from, motion, 900.0);
    const double truth = std::min(900.0, true_distance(pieces.whole, body, from, motion, 1.0) - body.radius);
    // An axis that pierces a triangle has distance 0 for the oracle, but a depth for a space.
    if (truth > -body.radius + 1e-6) {
      EXPECT_NEAR(c.distance, truth, 2.1e-3);
    }
    EXPECT_LE(c.distance, truth + 1e-6);
    const std::size_t n = space.contacts(body, from, motion, 900.0, contacts);
    EXPECT_EQ(n > 0, c.found);
    if (n > 0) {
      EXPECT_NEAR(contacts[0].distance, c.distance, 1e-3);
    }
  }
  EXPECT_GT(hits, 20);
}

TEST(PatchworkQueries, DoNotDependOnTheOrderInWhichPatchesCome) {
  clutter::Random random(43);
  const Pieces pieces(clutter::make(random, {500, 6.0, 0.05, 2.0, Vec3(0.0)}), 2.0);
  const auto ask = [&](std::uint64_t seed) {
    scenes::Random order(seed);
    Patchwork space;
    pieces.expect_all(space);
    std::vector<std::size_t> parts(pieces.parts.size());
    std::iota(parts.begin(), parts.end(), std::size_t{0});
    for (std::size_t i = parts.size(); i > 1; --i) std::swap(parts[i - 1], parts[order.bits() % i]);
    for (const std::size_t i : parts) {
      if (i % 10 == 0) continue;  // stays unknown
      pieces.deliver(space, i);
      if (order.chance(0.2)) space.update();
    }
    space.update();
    clutter::Random queries(44);
    std::vector<double> answers;
    const auto add = [&answers](const roam::Proximity& p, roam::TriangleId id, bool unknown) {
      answers.insert(answers.end(), {p.point.x, p.point.y, p.point.z, p.normal.x, p.normal.y, p.normal.z, p.distance,
                                     double(p.feature), double(id), double(unknown)});
    };
    std::vector<Contact> contacts(20);
    for (int q = 0; q < 500; ++q) {
      const Body body{queries.between(0.0, 0.3), q % 2 == 0 ? 0.0 : 0.5};
      const Vec3 from = queries.in_box(7.0), motion = queries.between(0.1, 100.0) * queries.direction();
      const auto s = space.sweep(body, from, motion);
      answers.push_back(s.time);
      add({s.point, s.normal, s.feature, s.distance}, s.triangle, s.unknown);
      const auto c = space.clearance(body, from, motion, 0.5);
      add(c, c.triangle, c.unknown);
      for (std::size_t i = 0, n = space.contacts(body, from, motion, 0.5, contacts); i < n; ++i) {
        add(contacts[i], contacts[i].triangle, contacts[i].unknown);
      }
    }
    return answers;
  };
  const auto expected = ask(1);
  EXPECT_GT(expected.size(), 10000u);
  for (std::uint64_t seed = 2; seed < 8; ++seed) EXPECT_EQ(ask(seed), expected);
}

TEST(PatchworkQueries, DoNotAllocate) {
  ROAM_NEEDS_PLAIN_MEMORY();
  clutter::Random random(45);
  const Pieces pieces(clutter::make(random, {2000, 10.0, 0.05, 2.0, Vec3(0.0)}), 2.0);
  Patchwork space;
  pieces.expect_all(space);
  for (std::size_t i = 0; i < pieces.parts.size(); ++i) {
    if (i % 5 != 0) pieces.deliver(space, i);
  }
  space.update();
  std::vector<Contact> contacts(64);
  const long before = allocations;
  std::size_t found = 0, unknown = 0;
  for (int q = 0; q < 2000; ++q) {
    const Body body{random.between(0.0, 0.3), q % 2 == 0 ? 0.0 : 0.5};
    const Vec3 from = random.in_box(10.0), motion = random.between(1.0, 200.0) * random.direction();
    found += space.sweep(body, from, motion).hit ? 1U : 0U;
    found += space.contacts(body, from, motion, 0.5, contacts);
    const auto c = space.clearance(body, from, 1.0);
    found += c.found ? 1U : 0U;
    unknown += c.unknown ? 1U : 0U;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(found, 2000u);
  EXPECT_GT(unknown, 100u);
}

}  // namespace
