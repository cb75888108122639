// Bodies that keep what lies around them from one question to the next are answered as well as those that do not:
// judged by brute force, and by what two of them are answered who should not differ.

#include <gtest/gtest.h>

#include <limits>

#include "counted_allocations.h"
#include "roam/generate.h"
#include "roam/world.h"
#include "sanitizer.h"
#include "vicinity_course.h"

namespace {

using clutter::Random;
using course::Course;
using course::gap_in;
using course::Judged;
using course::same;
using course::sweep_in;
using course::Tally;
using roam::Body;
using roam::Impact;
using roam::Mesh;
using roam::Space;
using roam::Vec3;
using roam::Vicinity;
using roam::World;

World build(std::span<const Mesh> meshes, bool lossless = false) {
  return World::build(meshes, {.threads = 0, .lossless = lossless, .progress = {}});
}
World build(const Mesh& mesh, bool lossless = false) { return build({&mesh, 1}, lossless); }

Mesh together(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& m : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), m.vertices.begin(), m.vertices.end());
    for (const auto& t : m.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

/// On foot and in the air through the mesh, every answer judged.
Tally judge(std::uint64_t seed, const Mesh& mesh, bool lossless, const Course& course) {
  const World world = build(mesh, lossless);
  Random random(seed);
  Tally all;
  for (const bool on_foot : {false, true}) {
    Judged asker(world, mesh, lossless);
    Course c = course;
    c.on_foot = on_foot;
    course::go(random, mesh, c, asker);
    const Tally& t = asker.tally;
    all.sweeps += t.sweeps, all.hits += t.hits, all.touching += t.touching, all.gaps += t.gaps, all.near += t.near;
    all.kept += t.kept, all.left += t.left, all.gathered += t.gathered, all.tiles += t.tiles, all.nodes += t.nodes;
  }
  // A course proves nothing unless it meets something, and goes by what is kept.
  EXPECT_GT(all.hits - all.touching, all.sweeps / 50);
  EXPECT_GT(all.near, all.gaps / 20);
  EXPECT_LT(all.gathered, all.asked() / 4);
  return all;
}

TEST(Vicinity, InClutterOfManySizes) {
  for (const double origin : {0.0, 6.4e6}) {
    SCOPED_TRACE(origin);
    Random random(1);
    const Mesh mesh = clutter::make(random, {3000, 6.0, 1e-3, 3.0, Vec3(origin, -0.7 * origin, 0.3 * origin)});
    const Tally t = judge(1, mesh, false, {.steps = 6000});
    EXPECT_GT(t.kept, t.asked() / 2);
    if (HasFatalFailure()) return;
  }
}

TEST(Vicinity, InLosslessClutter) {
  for (const double origin : {0.0, 6.4e6}) {
    SCOPED_TRACE(origin);
    Random random(2);
    const Mesh mesh = clutter::make(random, {3000, 6.0, 1e-3, 3.0, Vec3(origin, -0.7 * origin, 0.3 * origin)});
    const Tally t = judge(2, mesh, true, {.steps = 6000});
    EXPECT_GT(t.kept, t.asked() / 2);
    if (HasFatalFailure()) return;
  }
}

TEST(Vicinity, AmongTrianglesOfUpToTenKilometres) {
  for (const bool lossless : {false, true}) {
    Random random(3);
    const Mesh mesh = clutter::make(random, {3000, 3000.0, 1e-2, 1e4, {300.0, 20.0, -7.0}});
    const Tally t = judge(3, mesh, lossless, {.steps = 6000});
    EXPECT_GT(t.kept, t.asked() / 2);
    if (HasFatalFailure()) return;
  }
}

/// More of a tile meets the box than one node holds.
TEST(Vicinity, InDenseMeshes) {
  for (const double origin : {0.0, 6.4e6}) {
    SCOPED_TRACE(origin);
    Random random(4);
    const Mesh mesh = clutter::make(random, {60000, 3.0, 5e-3, 0.1, Vec3(origin, 0.3 * origin, -0.7 * origin)});
    const Tally t = judge(4, mesh, false, {.steps = 1500, .largest = 0.2});
    EXPECT_GT(t.kept, t.asked() / 2);
    EXPECT_GT(t.nodes, t.asked() / 2);
    if (HasFatalFailure()) return;
  }
}

/// So many tiles that nothing is kept, beside places where few are met.
TEST(Vicinity, AmongManyTiles) {
  Random random(5);
  const std::vector<Mesh> meshes{clutter::make(random, {150000, 1.5, 5e-3, 0.03, Vec3(0.0)}),
                                 clutter::make(random, {20, 5.0, 17.0, 5000.0, Vec3(0.0)}),
                                 clutter::make(random, {20000, 6.0, 0.01, 0.5, Vec3(0.0)})};
  const Tally t = judge(5, together(meshes), false, {.steps = 2000, .largest = 0.5});
  EXPECT_GT(t.kept, t.asked() / 20);
  EXPECT_GT(t.left, t.asked() / 20);
  EXPECT_GT(t.tiles, t.asked() / 20);
}

TEST(Vicinity, OnTerrain) {
  const Mesh mesh = together(roam::generate::collect(roam::generate::terrain({.triangles = 60'000, .size = 60.0})));
  const Tally t = judge(6, mesh, false, {.steps = 4000});
  EXPECT_GT(t.kept, t.asked() / 2);
}

TEST(Vicinity, InAGallery) {
  const Mesh mesh = together(roam::generate::collect(roam::generate::gallery({.triangles = 100'000, .seed = 1})));
  const Tally t = judge(7, mesh, false, {.steps = 4000});
  EXPECT_GT(t.kept, t.asked() / 2);
}

/// As it is asked with nothing kept: to the bit, for what is too far or too fast to be answered by what is kept.
TEST(Vicinity, AnswersAsWithoutWhereNothingIsKept) {
  Random random(8);
  const Mesh mesh = clutter::make(random, {3000, 6.0, 1e-3, 3.0, Vec3(0.0)});
  const World world = build(mesh);
  Vicinity vicinity;
  judged::NearJudge judge(mesh);
  long hits = 0;
  for (int i = 0; i < 3000; ++i) {
    SCOPED_TRACE(i);
    const Body body = course::some_body(random, 0.3);
    const Vec3 at = course::beside(random, mesh, body), way = random.direction();
    // Something is kept from here.
    judged::judge_sweep(sweep_in(world, vicinity, body, at, 0.05 * way), body, at, 0.05 * way, judged::farthest_off,
                        judge);
    const auto as_without = [&](const Body& b, const Vec3& from, const Vec3& motion, double reach) {
      const Impact s = sweep_in(world, vicinity, b, from, motion);
      ASSERT_TRUE(same(s, world.sweep(b, from, motion)));
      hits += s.hit ? 1 : 0;
      ASSERT_TRUE(same(gap_in(world, vicinity, b, from, motion, reach), world.gap_bound(b, from, motion, reach)));
    };
    ASSERT_NO_FATAL_FAILURE(as_without(body, at, random.between(5.0, 300.0) * way, 0.1));
    for (const Body& thin : {Body{0.0, 0.0}, Body{1e-6, 0.0}}) {
      const Vec3 near = course::beside(random, mesh, thin);
      ASSERT_NO_FATAL_FAILURE(as_without(thin, near, 0.15 * random.direction(), 0.1));
    }
    for (const double far : {1e3, 1e7, 1e15, 1e300}) {
      ASSERT_NO_FATAL_FAILURE(as_without(body, far * way, 0.1 * random.direction(), 0.1));
    }
    // Farther than it keeps: as certified.
    const double reach = i % 5 == 0 ? random.between(20.0, 1000.0) : random.between(0.25, 3.0);
    judged::judge_gap(gap_in(world, vicinity, body, at, Vec3(0.0), reach), body, at, Vec3(0.0), reach, judge);
    const Vec3 motion = random.between(0.2, 4.0) * random.direction();
    judged::judge_sweep(sweep_in(world, vicinity, body, at, motion), body, at, motion, judged::farthest_off, judge);
    judged::judge_gap(gap_in(world, vicinity, body, at, motion, 0.2), body, at, motion, 0.2, judge);
    const Body large{random.between(1.0, 1000.0), 0.0};
    judged::judge_sweep(sweep_in(world, vicinity, large, at, 0.1 * way), large, at, 0.1 * way, judged::farthest_off,
                        judge);
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(hits, 1000);
}

TEST(Vicinity, OfAnEmptyWorld) {
  const Mesh mesh;
  for (const World& world : {World(), World::build({}), build(mesh)}) {
    Vicinity vicinity;
    for (const Vec3& at : {Vec3(0.0), Vec3(1e7)}) {
      EXPECT_FALSE(sweep_in(world, vicinity, {0.3, 0.5}, at, {0.1, 0.0, 0.0}).hit);
      EXPECT_EQ(gap_in(world, vicinity, {0.3, 0.5}, at, {0.1, 0.0, 0.0}, 0.2), 0.2);
    }
  }
}

/// The world of a floor at this height, 10 m wide.
World floor_at(double height) {
  Mesh mesh;
  scenes::add_floor(mesh, -5.0, -5.0, 5.0, 5.0, height);
  return build(mesh);
}

/// How far a ball of 0.1 m comes to be above the floor, asked for in both ways.
double floor_below(const Space& space, Vicinity& vicinity, const Vec3& at) {
  const Impact s = sweep_in(space, vicinity, {0.1, 0.0}, at, {0.0, 0.0, -0.2});
  const double gap = gap_in(space, vicinity, {0.1, 0.0}, at, Vec3(0.0), 0.25);
  EXPECT_TRUE(s.hit);
  EXPECT_NEAR(gap, 0.2 * s.time, 0.03);
  return at.z - 0.1 - 0.2 * s.time;
}

TEST(Vicinity, NeverAnswersFromAnotherWorld) {
  const World low = floor_at(0.0), high = floor_at(0.1);
  Vicinity vicinity;
  for (int i = 0; i < 20; ++i) {
    const Vec3 at(0.001 * i, 0.0, 0.25);
    EXPECT_NEAR(floor_below(low, vicinity, at), 0.0, 3e-3);
    EXPECT_NEAR(floor_below(high, vicinity, at), 0.1, 3e-3);
    // One that was made since, and is gone before the next question.
    EXPECT_NEAR(floor_below(floor_at(0.05), vicinity, at), 0.05, 3e-3);
  }
}

TEST(Vicinity, FollowsAWorldThatAnotherIsAssignedTo) {
  World world = floor_at(0.0);
  Vicinity vicinity;
  const Vec3 at(0.0, 0.0, 0.25);
  for (int i = 0; i < 10; ++i) {
    const double height = 0.01 * i;
    world = floor_at(height);
    EXPECT_NEAR(floor_below(world, vicinity, at), height, 3e-3);
  }
  world = World();
  EXPECT_FALSE(sweep_in(world, vicinity, {0.1, 0.0}, at, {0.0, 0.0, -0.2}).hit);
  // A world that moves is the same one.
  world = floor_at(0.0);
  (void)floor_below(world, vicinity, at);
  Vicinity other = vicinity;
  const Impact before = sweep_in(world, vicinity, {0.1, 0.0}, at, {0.0, 0.0, -0.2});
  const World moved = std::move(world);
  EXPECT_TRUE(same(sweep_in(moved, other, {0.1, 0.0}, at, {0.0, 0.0, -0.2}), before));
}

/// Asks two at once, and wants the same bits.
struct Twins {
  const World& world;
  Vicinity *one, *other;
  long hits = 0;

  Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) {
    const Impact a = sweep_in(world, *one, body, from, motion), b = sweep_in(world, *other, body, from, motion);
    [&] { ASSERT_TRUE(same(a, b)); }();
    hits += a.hit ? 1 : 0;
    return a;
  }
  double gap_bound(const Body& body, const Vec3& from, const Vec3& motion, double reach) {
    const double a = gap_in(world, *one, body, from, motion, reach),
                 b = gap_in(world, *other, body, from, motion, reach);
    [&] { ASSERT_TRUE(same(a, b)); }();
    return a;
  }
};

/// Asks one.
struct Alone {
  const World& world;
  Vicinity& vicinity;

  Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) {
    return sweep_in(world, vicinity, body, from, motion);
  }
  double gap_bound(const Body& body, const Vec3& from, const Vec3& motion, double reach) {
    return gap_in(world, vicinity, body, from, motion, reach);
  }
};

TEST(Vicinity, ACopyGoesOnAsTheOriginalWould) {
  Random random(9);
  const Mesh mesh = clutter::make(random, {60000, 3.0, 5e-3, 0.1, Vec3(0.0)});
  const World world = build(mesh);
  Vicinity original;
  long hits = 0;
  for (int round = 0; round < 300; ++round) {
    SCOPED_TRACE(round);
    // Each copy is made in the middle of a walk, and all go on from there.
    Alone alone{world, original};
    const Random walk = random;
    const Course halfway{.steps = 25, .on_foot = round % 2 == 0, .largest = 0.2};
    Random begun = walk;
    course::go(begun, mesh, halfway, alone);
    Vicinity copy = original, assigned;
    assigned = original;
    Vicinity& same_one = original;
    original = same_one;
    Vicinity elsewhere = original;
    Random far(static_cast<std::uint64_t>(round));
    Alone wanders{world, elsewhere};
    course::go(far, mesh, halfway, wanders);  // which is nothing to the others
    const Course whole{.steps = 50, .on_foot = halfway.on_foot, .largest = 0.2};
    for (Vicinity* other : {&copy, &assigned}) {
      Vicinity control = original;
      Twins twins{world, &control, other};
      Random again = walk;
      course::go(again, mesh, whole, twins);
      hits += twins.hits;
    }
    Vicinity moved = std::move(copy);
    Vicinity control = assigned;
    Twins twins{world, &control, &moved};
    Random again = walk;
    course::go(again, mesh, whole, twins);
    random = again;
    ASSERT_FALSE(HasFatalFailure());
  }
  EXPECT_GT(hits, 1000);
}

TEST(Vicinity, ThatWasMovedFromIsAsGoodAsNone) {
  Random random(10);
  const Mesh mesh = clutter::make(random, {3000, 6.0, 1e-3, 3.0, Vec3(0.0)});
  const World world = build(mesh);
  Vicinity left, right = std::move(left);
  const Vicinity copy_of_none = left;  // NOLINT: what is asked here
  for (int i = 0; i < 2000; ++i) {
    const Body body = course::some_body(random, 0.3);
    const Vec3 at = course::beside(random, mesh, body), way = 0.1 * random.direction();
    Vicinity none = copy_of_none;
    for (Vicinity* v : {&left, &none}) {
      ASSERT_TRUE(same(sweep_in(world, *v, body, at, way), world.sweep(body, at, way)));
      ASSERT_TRUE(same(gap_in(world, *v, body, at, way, 0.1), world.gap_bound(body, at, way, 0.1)));
    }
  }
  EXPECT_THROW((void)sweep_in(world, left, {-1.0, 0.0}, Vec3(0.0), Vec3(0.0)), roam::Error);
  left = right;
  (void)sweep_in(world, left, {0.1, 0.0}, Vec3(0.0), {0.1, 0.0, 0.0});
  ASSERT_NE(left.state(), nullptr);
  EXPECT_TRUE(left.state()->complete);
}

TEST(Vicinity, DoesNotAllocate) {
  ROAM_NEEDS_PLAIN_MEMORY();
  Random random(11);
  const Mesh mesh = clutter::make(random, {60000, 3.0, 5e-3, 0.1, Vec3(0.0)});
  const World world = build(mesh), other = floor_at(0.0);
  struct Question {
    Body body;
    Vec3 from, motion;
  };
  struct Noted : Alone {
    std::vector<Question>& questions;
    Impact sweep(const Body& body, const Vec3& from, const Vec3& motion) {
      questions.push_back({body, from, motion});
      return Alone::sweep(body, from, motion);
    }
  };
  std::vector<Question> questions;
  Vicinity vicinity;
  Noted noted{{world, vicinity}, questions};
  course::go(random, mesh, {.steps = 2000, .on_foot = true, .largest = 0.2}, noted);
  const long before = allocations;
  long hits = 0, near = 0;
  for (const Question& q : questions) {
    hits += sweep_in(world, vicinity, q.body, q.from, q.motion).hit ? 1 : 0;
    near += gap_in(world, vicinity, q.body, q.from, q.motion, 0.25) < 0.25 ? 1 : 0;
    near += gap_in(world, vicinity, q.body, q.from, 10.0 * q.motion, 1.0) < 1.0 ? 1 : 0;
    hits += sweep_in(other, vicinity, q.body, q.from, q.motion).hit ? 1 : 0;
  }
  EXPECT_EQ(allocations, before);
  EXPECT_GT(hits, 500);
  EXPECT_GT(near, 2000);
}

TEST(Vicinity, IsRefusedWhatSpacesRefuse) {
  const World world = floor_at(0.0);
  Vicinity vicinity;
  const Vec3 at(0.0, 0.0, 0.25), way(0.01, 0.0, 0.0);
  EXPECT_NEAR(floor_below(world, vicinity, at), 0.0, 3e-3);
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  const auto refuses = [&](const Body& body, const Vec3& from, const Vec3& motion) {
    EXPECT_THROW((void)sweep_in(world, vicinity, body, from, motion), roam::Error);
    EXPECT_THROW((void)gap_in(world, vicinity, body, from, motion, 0.1), roam::Error);
  };
  for (const double bad : {nan, infinity, -1.0, 1001.0}) {
    refuses({bad, 0.0}, at, way);
    refuses({0.1, bad}, at, way);
    EXPECT_THROW((void)gap_in(world, vicinity, {0.1, 0.0}, at, way, bad), roam::Error);
  }
  for (const double bad : {nan, infinity, -infinity}) {
    refuses({0.1, 0.0}, {0.0, bad, 0.0}, way);
    refuses({0.1, 0.0}, at, {0.0, 0.0, bad});
  }
  refuses({0.1, 0.0}, at, {1.1e6, 0.0, 0.0});
  EXPECT_NEAR(floor_below(world, vicinity, at), 0.0, 3e-3);
}

}  // namespace
