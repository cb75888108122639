// Worlds that are posed in a space answer as brute force says of the posed triangles.

#include "roam/instances.h"

#include <gtest/gtest.h>
#include <malloc.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "counted_allocations.h"
#include "first_impacts.h"
#include "judged_queries.h"
#include "posed_scenes.h"
#include "roam/filtered.h"
#include "roam/patchwork.h"

namespace {

using posed::Scene;
using roam::Contact;
using roam::Impact;
using roam::Instances;
using roam::Mesh;
using roam::ObjectId;
using roam::Pose;
using roam::Query;
using roam::Vec3;
using roam::World;

constexpr double farthest = judged::farthest_lossless + 1e-6;

TEST(Instances, AnswerWhatBruteForceSaysOfThePosedTriangles) {
  for (const Vec3 centre : {Vec3(0.0), Vec3(6e5, -5.9e6, 800.0)}) {
    const auto scene = posed::clutter_scene(7, true, centre);
    const Mesh whole = scene->whole();
    judged::NearJudge judge(whole);
    long hits = 0, of_instances = 0;
    for (Query q : first_impacts::queries(8, 5.0, 1500)) {
      q.from += centre;
      if (glm::length(q.motion) > 10.0) q.motion *= 0.1;
      const Impact s = scene->space.sweep(q);
      judged::judge_sweep(s, q.body, q.from, q.motion, farthest, judge);
      judged::judge_gap(scene->space.gap_bound(q, 1.0), q.body, q.from, q.motion, 1.0, judge);
      ASSERT_FALSE(HasFatalFailure()) << "from " << q.from.x << ' ' << q.from.y << ' ' << q.from.z;
      hits += s.hit ? 1 : 0;
      of_instances += s.hit && scene->space.has(s.object) ? 1 : 0;
      const double truth = judge.over(q.body, q.from, q.motion, q.body.radius + 2.0) - q.body.radius;
      const roam::Clearance near = scene->space.clearance(q, 1.0);
      ASSERT_LE(near.distance, std::max(truth, 0.0) + 1e-6);
      if (truth > 0.0 && truth < 1.0) {
        ASSERT_GE(near.distance, truth - farthest);
      }
    }
    EXPECT_GT(hits, 300);
    EXPECT_GT(of_instances, 100);
  }
}

TEST(Instances, AnswerAsOneWorldOfAllOfIt) {
  const auto scene = posed::clutter_scene(9, true);
  const World one = scenes::build(scene->whole(), true);
  std::array<Contact, 400> a, b;
  for (const Query& q : first_impacts::queries(10, 5.0, 400)) {
    const std::size_t n = scene->space.contacts(q, 0.7, a);
    ASSERT_EQ(one.contacts(q, 0.7, b), n);
    for (std::size_t i = 0; i < n; ++i) {
      ASSERT_NEAR(a[i].distance, b[i].distance, 3e-5);
    }
    const Impact s = scene->space.sweep(q), t = one.sweep(q);
    const double length = glm::length(q.motion);
    if (s.hit && t.hit && s.time > 0.0) {
      ASSERT_NEAR(s.time * length, t.time * length, judged::along(q.motion, t) + 1e-4);
      if (s.object != t.object && std::abs(s.time - t.time) < 1e-9) {
        ASSERT_NEAR(glm::length(s.point - t.point), 0.0, 1e-2);
      }
    }
  }
}

/// Triangles as large as a hand at least, of which storing changes no slope, and none within a degree of 45.
Mesh plain_clutter(clutter::Random& random, int count, double half) {
  Mesh m;
  while (m.triangles.size() < static_cast<std::size_t>(count)) {
    const Vec3 at = random.in_box(half), a = at + random.in_box(0.7), b = at + random.in_box(0.7);
    const Vec3 normal = glm::cross(a - at, b - at);
    const double area = glm::length(normal);
    const bool clear = std::abs(std::abs(normal.z) - area * std::sqrt(0.5)) > 0.02 * area;
    if (area > 0.1 && clear) scenes::add_triangle(m, at, a, b);
  }
  return m;
}

TEST(Instances, SeeFloorAsOneWorldOfAllOfIt) {
  clutter::Random random(15);
  Scene scene(plain_clutter(random, 60, 4.0));
  for (int i = 0; i < 6; ++i) scene.add(plain_clutter(random, 30, 1.5), posed::some_pose(random, 3.0));
  const World one = scenes::build(scene.whole(), true);
  long found = 0;
  for (const Query& q : first_impacts::queries(16, 4.0, 1500)) {
    for (const double band : {std::numeric_limits<double>::infinity(), 0.01 + q.body.radius + q.body.half_height}) {
      const roam::Floor floor{45.0, band, q.from, {0.3, -0.5, 1.0}};
      const roam::Clearance x = scene.space.floor_clearance(q.body, q.from, 0.5, floor);
      const roam::Clearance y = one.floor_clearance(q.body, q.from, 0.5, floor);
      ASSERT_EQ(x.found, y.found);
      ASSERT_NEAR(x.distance, y.distance, 1e-4);
      found += x.found && x.distance > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(found, 300);
}

TEST(Instances, CompleteFirstImpacts) {
  for (const bool lossless : {false, true}) {
    const auto scene = posed::clutter_scene(11, lossless);
    const first_impacts::Tally tally = first_impacts::compare(scene->space, first_impacts::queries(12, 5.0, 2000));
    EXPECT_GT(tally.hits, 500);
    EXPECT_GT(tally.at_start, 100);
  }
}

/// A unit square at x = 0 that faces +x, from y = 0 to 1 and z = 0 to 2: a door with its hinge at the origin.
Mesh door() {
  Mesh m;
  scenes::add_wall(m, 0.0, 0.0, 0.0, 1.0, 0.0, 2.0);
  return m;
}

TEST(Instances, NameWhatIsMet) {
  Mesh floor;
  floor.name = "floor";
  floor.user_data = 70;
  scenes::add_floor(floor, -9.0, -9.0, 9.0, 9.0, 0.0);
  Scene scene(floor);
  const ObjectId a = scene.add(door(), {{2.0, 0.0, 0.0}}, "door", 7);
  const ObjectId b = scene.add(door(), {{4.0, 0.0, 0.0}}, "second door", 8);
  EXPECT_NE(a, b);
  const Impact first = scene.space.ray({0.0, 0.5, 1.0}, {8.0, 0.0, 0.0});
  EXPECT_EQ(first.object, a);
  EXPECT_NEAR(8.0 * first.time, 2.0, 1e-4);
  EXPECT_NEAR(std::abs(first.normal.x), 1.0, 1e-9);
  EXPECT_EQ(scene.space.object_name(first.triangle), "door");
  const roam::Object met = scene.space.object(first.triangle);
  EXPECT_EQ(met.id, a);
  EXPECT_EQ(met.user_data, 7U);
  EXPECT_LT(Instances::source_triangle(first.triangle), 2U);
  const Impact down = scene.space.ray({0.0, 0.5, 1.0}, {0.0, 0.0, -8.0});
  EXPECT_EQ(down.object, 0U);
  EXPECT_EQ(scene.space.object(down.triangle).user_data, 70U);
  EXPECT_EQ(Instances::source_triangle(down.triangle), down.triangle);
  EXPECT_EQ(scene.space.object(roam::no_triangle).id, roam::no_object);
  EXPECT_EQ(scene.space.object(first.triangle + 2).id, roam::no_object);  // the door has two triangles

  scene.space.remove(a);
  EXPECT_EQ(scene.space.object(first.triangle).id, roam::no_object);
  EXPECT_EQ(scene.space.ray({0.0, 0.5, 1.0}, {8.0, 0.0, 0.0}).object, b);
  EXPECT_EQ(scene.space.instances(), std::vector<ObjectId>{b});
  EXPECT_EQ(scene.space.clearance({.radius = 0.1}, {3.5, 0.5, 1.0}, 1.0).object, b);
}

TEST(Instances, TurnCounterclockwise) {
  Scene scene{Mesh{}};
  const ObjectId id = scene.add(door(), {{2.0, 0.0, 0.0}, 0.5 * std::numbers::pi});
  // It stands from (2, 0) to (1, 0) now.
  const Impact s = scene.space.ray({1.5, -3.0, 1.0}, {0.0, 6.0, 0.0});
  ASSERT_TRUE(s.hit);
  EXPECT_NEAR(s.time, 0.5, 1e-4);
  EXPECT_FALSE(scene.space.ray({2.5, -3.0, 1.0}, {0.0, 6.0, 0.0}).hit);
  const roam::Velocity velocity{{1.0, 0.0, 0.0}, 2.0};
  EXPECT_NEAR(glm::length(velocity.at(scene.space.pose(id), {1.0, 0.0, 1.0}) - Vec3(1.0, -2.0, 0.0)), 0.0, 1e-12);
}

TEST(Instances, SayWhenTheyChange) {
  Scene scene(door());
  std::vector<std::uint64_t> revisions{*scene.space.facts().revision};
  const auto changed = [&] {
    revisions.push_back(*scene.space.facts().revision);
    return revisions.back() != revisions[revisions.size() - 2];
  };
  const ObjectId id = scene.add(door(), {});
  EXPECT_TRUE(changed());
  scene.space.set_pose(id, {{1.0, 0.0, 0.0}});
  EXPECT_TRUE(changed());
  scene.space.set_pose(id, {{1.0, 0.0, 0.0}});
  EXPECT_FALSE(changed());
  scene.space.set_velocity(id, {{1.0, 0.0, 0.0}});
  EXPECT_FALSE(changed());
  scene.space.remove(id);
  EXPECT_TRUE(changed());
}

TEST(Instances, GrowTheBounds) {
  Scene scene(door());
  const ObjectId id = scene.add(door(), {{100.0, 0.0, 0.0}});
  EXPECT_GE(scene.space.bounds().upper.x, 100.0);
  scene.space.remove(id);
  EXPECT_LT(scene.space.bounds().upper.x, 1.0);
}

TEST(Instances, RefuseWhatCannotBe) {
  Scene scene(door());
  const double none = std::numeric_limits<double>::quiet_NaN();
  const ObjectId id = scene.add(door(), {});
  EXPECT_THROW(scene.space.add(nullptr, {}), roam::Error);
  EXPECT_THROW(scene.add(door(), {{none, 0.0, 0.0}}), roam::Error);
  EXPECT_THROW(scene.add(door(), {{0.0, 2e9, 0.0}}), roam::Error);
  EXPECT_THROW(scene.space.set_pose(id, {{}, none}), roam::Error);
  EXPECT_THROW(scene.space.set_velocity(id, {{none, 0.0, 0.0}}), roam::Error);
  EXPECT_THROW(scene.space.remove(0), roam::Error);
  EXPECT_THROW(scene.space.remove(id + 1), roam::Error);
  EXPECT_THROW((void)scene.space.pose(roam::no_object), roam::Error);
  EXPECT_FALSE(scene.space.has(roam::no_object));
  // One fine triangle beside wide ones: the tile is stored coarsely.
  clutter::Random random(17);
  const Mesh wide = clutter::make(random, {.count = 300, .half = 2e4, .small = 10.0, .large = 2e4});
  EXPECT_THROW(scene.space.add(posed::shared(wide, false), {}), roam::Error);
}

TEST(Instances, StandInWhatIsNotKnownYet) {
  roam::Patchwork patchwork;
  const roam::PatchId patch = patchwork.expect({{5.0, -1.0, -1.0}, {6.0, 1.0, 1.0}});
  Instances space(patchwork);
  const ObjectId id = space.add(posed::shared(door()), {{2.0, -0.5, -1.0}}, "door");
  EXPECT_TRUE(space.update({.radius = 0.1}, Vec3(0.0), Vec3(0.0)));
  EXPECT_EQ(space.ray(Vec3(0.0), {9.0, 0.0, 0.0}).object, id);
  const Impact unknown = space.ray({3.0, 0.0, 0.0}, {9.0, 0.0, 0.0});
  EXPECT_TRUE(unknown.unknown);
  EXPECT_EQ(space.object_name(unknown.triangle), "not loaded yet");
  patchwork.fail(patch, "lost");
  space.update({.radius = 0.1}, Vec3(0.0), Vec3(0.0));
  EXPECT_EQ(space.object_name(unknown.triangle), "lost");
  roam::Filtered some(space);
  EXPECT_THROW(Instances{static_cast<const roam::Space&>(some)}, roam::Error);
}

TEST(Instances, AllocateNothingInQueries) {
  const auto scene = posed::clutter_scene(13, false);
  roam::Filtered some(scene->space);
  some.ignore(scene->ids[0]);
  std::array<Contact, 16> contacts;
  const std::vector<Query> queries = first_impacts::queries(14, 5.0, 200);
  const long before = allocations;
  for (const roam::Space* space :
       {static_cast<const roam::Space*>(&scene->space), static_cast<const roam::Space*>(&some)}) {
    for (const Query& q : queries) {
      (void)space->sweep(q);
      (void)space->gap_bound(q, 1.0);
      (void)space->clearance(q, 1.0);
      (void)space->contacts(q, 1.0, contacts);
      (void)space->floor_clearance(q.body, q.from, 1.0, {});
    }
  }
  EXPECT_EQ(allocations, before);
}

TEST(Instances, GiveBackWhatRemovedOnesTook) {
  Mesh floor;
  scenes::add_floor(floor, -100.0, -100.0, 100.0, 100.0, 0.0);
  Scene scene(floor);
  const auto shape = posed::shared(door());
  const ObjectId stays = scene.space.add(shape, {});
  const auto used = [] {
    const auto memory = ::mallinfo2();
    return memory.uordblks + memory.hblkhd;
  };
  const std::size_t before = used();
  ObjectId last = stays;
  for (int i = 0; i < 100'000; ++i) {
    const ObjectId next = scene.space.add(shape, {{3.0 * (i % 30), 0.0, 0.0}});
    ASSERT_GT(next, last) << "numbers are not reused";
    scene.space.remove(next);
    ASSERT_FALSE(scene.space.has(next));
    last = next;
  }
  EXPECT_LT(used(), before + (64U << 10));
  EXPECT_EQ(scene.space.instances(), std::vector{stays});
}

TEST(Instances, LieInAThousandPlacesAtOnce) {
  Mesh floor;
  scenes::add_floor(floor, -100.0, -100.0, 100.0, 100.0, 0.0);
  Scene scene(floor);
  const auto shape = posed::shared(door());
  std::vector<ObjectId> ids;
  for (int i = 0; i < 1000; ++i) ids.push_back(scene.space.add(shape, {{3.0 * (i % 30), 3.0 * (i / 30), 0.0}}));
  for (int i = 0; i < 1000; i += 37) {
    const Impact s =
        scene.space.sweep({.radius = 0.1}, {3.0 * (i % 30) - 1.0, 3.0 * (i / 30) + 0.5, 1.0}, {1.0, 0.0, 0.0});
    ASSERT_TRUE(s.hit);
    ASSERT_EQ(s.object, ids[i]);
  }
}

}  // namespace
