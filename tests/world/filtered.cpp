// A space without some of its objects is the space that never had them.

#include "roam/filtered.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "first_impacts.h"
#include "judged_queries.h"
#include "roam/instances.h"
#include "roam/patchwork.h"
#include "roam/walker.h"

namespace {

using roam::Filtered;
using roam::Impact;
using roam::Mesh;
using roam::ObjectId;
using roam::Query;
using roam::Vec3;
using roam::World;

std::vector<Mesh> clutter_of(int objects) {
  clutter::Random random(21);
  std::vector<Mesh> meshes;
  for (int i = 0; i < objects; ++i) meshes.push_back(clutter::make(random, {.count = 60, .half = 4.0}));
  return meshes;
}

TEST(Filtered, IsTheSpaceWithoutThoseObjects) {
  const std::vector<Mesh> meshes = clutter_of(8);
  for (const bool lossless : {false, true}) {
    const World world = World::build(meshes, {.lossless = lossless});
    Filtered some(world);
    const std::vector<ObjectId> ignored{1, 4, 5};
    some.ignore_only(ignored);
    Mesh left;
    for (ObjectId i = 0; i < meshes.size(); ++i) {
      if (some.ignores(i)) continue;
      for (std::size_t t = 0; t < meshes[i].triangles.size(); ++t) {
        const roam::Triangle c = meshes[i].triangle(t);
        scenes::add_triangle(left, c[0], c[1], c[2]);
      }
    }
    const double farthest = lossless ? judged::farthest_lossless : judged::farthest_off;
    judged::NearJudge judge(left);
    std::array<roam::Contact, 64> contacts;
    long other = 0;
    for (const Query& q : first_impacts::queries(22, 4.0, 1500)) {
      const Impact s = some.sweep(q), unfiltered = world.sweep(q);
      if (glm::length(q.motion) < 10.0) judged::judge_sweep(s, q.body, q.from, q.motion, farthest, judge);
      if (glm::length(q.motion) < 10.0) judged::judge_gap(some.gap_bound(q, 1.0), q.body, q.from, q.motion, 1.0, judge);
      ASSERT_FALSE(HasFatalFailure());
      other += s.time != unfiltered.time ? 1 : 0;
      ASSERT_TRUE(!s.hit || !some.ignores(s.object));
      const roam::Clearance near = some.clearance(q, 1.0);
      ASSERT_TRUE(!near.found || !some.ignores(near.object));
      const roam::Clearance floor = some.floor_clearance(q.body, q.from, 1.0, {});
      ASSERT_TRUE(!floor.found || !some.ignores(floor.object));
      for (std::size_t i = some.contacts(q, 0.5, contacts); i-- > 0;) ASSERT_FALSE(some.ignores(contacts[i].object));
      // The same, said by the query itself.
      const roam::ObjectFilter filter{ignored};
      Query with = q;
      with.ignored = &filter;
      ASSERT_TRUE(course::same(world.sweep(with), s));
    }
    EXPECT_GT(other, 100);
    EXPECT_GT(first_impacts::compare(some, first_impacts::queries(23, 4.0, 500)).hits, 100);
  }
}

TEST(Filtered, IsTheSpaceWithoutTheTrianglesBeyondAPlane) {
  const std::vector<Mesh> meshes = clutter_of(8);
  const World world = World::build(meshes, {.lossless = true});
  const double c = std::sqrt(0.5);
  const std::vector<roam::HalfSpace> beyond{{{0, 0, 1}, 1.0}, {{-c, c, 0}, 2.0}};
  Filtered some(world);
  some.ignore_beyond(beyond);
  EXPECT_EQ(some.beyond().size(), 2u);
  some.ignore(3);
  Mesh left;
  long gone = 0, cut = 0;
  for (ObjectId i = 0; i < meshes.size(); ++i) {
    for (std::size_t t = 0; t < meshes[i].triangles.size() && i != 3; ++t) {
      const roam::Triangle corners = meshes[i].triangle(t);
      const roam::ObjectFilter filter{{}, nullptr, beyond};
      const bool is_gone = filter.ignores(corners);
      gone += is_gone;
      if (is_gone) continue;
      cut += std::any_of(corners.begin(), corners.end(), [&](const Vec3& p) { return beyond[0].holds(p); });
      scenes::add_triangle(left, corners[0], corners[1], corners[2]);
    }
  }
  ASSERT_GT(gone, 50);
  ASSERT_GT(cut, 5) << "triangles that cross a plane stay whole";
  judged::NearJudge judge(left);
  std::array<roam::Contact, 64> contacts;
  for (const Query& q : first_impacts::queries(25, 4.0, 1500)) {
    const Impact s = some.sweep(q);
    if (glm::length(q.motion) < 10.0) {
      judged::judge_sweep(s, q.body, q.from, q.motion, judged::farthest_lossless, judge);
      judged::judge_gap(some.gap_bound(q, 1.0), q.body, q.from, q.motion, 1.0, judge);
    }
    ASSERT_FALSE(HasFatalFailure());
    // The same, said by the query itself.
    const std::vector<ObjectId> objects{3};
    const roam::ObjectFilter objects_too{objects}, filter{{}, &objects_too, beyond};
    Query with = q;
    with.ignored = &filter;
    ASSERT_TRUE(course::same(world.sweep(with), s));
    ASSERT_EQ(world.contacts(with, 0.5, contacts), some.contacts(q, 0.5, contacts));
  }
  EXPECT_GT(first_impacts::compare(some, first_impacts::queries(26, 4.0, 500)).hits, 100);
}

TEST(Filtered, ChangesItsRevisionWithItsHalfSpaces) {
  const World world = World::build(clutter_of(2));
  Filtered some(world);
  const std::uint64_t first = *some.facts().revision;
  const std::vector<roam::HalfSpace> beyond{{{0, 0, 1}, 1.0}};
  some.ignore_beyond(beyond);
  const std::uint64_t second = *some.facts().revision;
  EXPECT_NE(second, first);
  some.ignore_beyond(beyond);
  EXPECT_EQ(*some.facts().revision, second);
  some.ignore_beyond({});
  EXPECT_NE(*some.facts().revision, second);
  const std::vector<roam::HalfSpace> wrong{{{0, 0, 1}, std::nan("")}};
  EXPECT_THROW(some.ignore_beyond(wrong), roam::Error);
}

TEST(Filtered, OfAFilteredIgnoresBoth) {
  const World world = World::build(clutter_of(6));
  Filtered outer_only(world), inner(world);
  inner.ignore(0);
  Filtered outer(inner);
  outer.ignore(3);
  outer_only.ignore(0);
  outer_only.ignore(3);
  for (const Query& q : first_impacts::queries(24, 4.0, 500)) {
    ASSERT_TRUE(course::same(outer.sweep(q), outer_only.sweep(q)));
    ASSERT_EQ(outer.gap_bound(q, 1.0), outer_only.gap_bound(q, 1.0));
  }
}

TEST(Filtered, RefusesAnUpdateThatAnyLiveSpaceRefuses) {
  const World world = World::build(clutter_of(2));
  Filtered filtered(world);
  roam::Instances instances(world);
  const roam::Body ball{0.3, 0.0};
  const double nan = std::numeric_limits<double>::quiet_NaN(), infinite = std::numeric_limits<double>::infinity();
  for (roam::LiveSpace* space : {static_cast<roam::LiveSpace*>(&filtered), static_cast<roam::LiveSpace*>(&instances)}) {
    EXPECT_FALSE(space->update(ball, {1.0, 2.0, 3.0}, {4.0, 0.0, 0.0}));
    EXPECT_THROW(space->update({-1.0, 0.0}, {1.0, 2.0, 3.0}, {4.0, 0.0, 0.0}), roam::Error);
    EXPECT_THROW(space->update(ball, {1.0, nan, 3.0}, {4.0, 0.0, 0.0}), roam::Error);
    EXPECT_THROW(space->update(ball, {1.0, 2.0, 3.0}, {0.0, 0.0, infinite}), roam::Error);
  }
}

TEST(Filtered, IgnoresAndStopsIgnoring) {
  const World world = World::build(clutter_of(3));
  Filtered some(world);
  const auto revision = [&] { return *some.facts().revision; };
  const std::uint64_t first = revision();
  some.ignore(2);
  EXPECT_TRUE(some.ignores(2));
  EXPECT_NE(revision(), first);
  const std::uint64_t second = revision();
  some.ignore(2);
  EXPECT_EQ(revision(), second);
  some.stop_ignoring(2);
  EXPECT_FALSE(some.ignores(2));
  EXPECT_NE(revision(), second);
  EXPECT_NE(revision(), first);
  some.ignore_only(std::vector<ObjectId>{2, 0, 2});
  EXPECT_TRUE(some.ignores(0) && !some.ignores(1) && some.ignores(2));
}

TEST(Filtered, HasAnotherRevisionWhenAnotherIsAssigned) {
  const World world = World::build(clutter_of(3));
  Filtered a(world), b(world);
  a.ignore(1);
  b.ignore(2);
  const std::uint64_t before = *a.facts().revision;
  a = b;
  EXPECT_NE(*a.facts().revision, before);
  EXPECT_TRUE(a.ignores(2) && !a.ignores(1));
}

/// A room of 10 m, and a wall across it that is an object of its own.
std::vector<Mesh> room_with_door() {
  std::vector<Mesh> meshes(2);
  scenes::add_box(meshes[0], {-5.0, -5.0, 0.0}, {5.0, 5.0, 3.0});
  meshes[1].name = "door";
  scenes::add_box(meshes[1], {-0.05, -5.0, 0.0}, {0.05, 5.0, 3.0});
  return meshes;
}

TEST(Filtered, CutsTheSpaceThatInstancesAreIn) {
  const World world = World::build(room_with_door());
  const roam::Instances all(world);
  Filtered some(all);
  const roam::Body ball{.radius = 0.1};
  const auto falls = [&] { return !some.sweep(ball, {2.0, 0.0, 1.5}, {0.0, 0.0, -9.0}).hit; };
  EXPECT_FALSE(falls());
  const std::vector<roam::HalfSpace> below{{{0.0, 0.0, -1.0}, -0.5}};
  some.ignore_beyond(below);
  EXPECT_TRUE(falls());
  EXPECT_TRUE(some.sweep(ball, {2.0, 0.0, 1.5}, {-9.0, 0.0, 0.0}).hit) << "the door stays: it reaches higher";
}

TEST(Filtered, LetsOneBodyThroughADoorThatStopsAnother) {
  const World world = World::build(room_with_door());
  Filtered open(world), shut(world);
  open.ignore(1);
  const auto go = [](roam::Walker& walker, double seconds) {
    for (double t = 0.0; t < seconds; t += 1.0 / 60.0) walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
  };
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly}) {
    roam::Walker one(open, {}, mode, {-3.0, 0.0, 1.0}), other(shut, {}, mode, {-3.0, 0.0, 1.0});
    go(one, 4.0);
    go(other, 4.0);
    EXPECT_GT(one.position().x, 2.0);
    EXPECT_LT(other.position().x, -0.3);
    EXPECT_TRUE(other.report().blocked);
    // It is opened before the one that waits at it, and shut again behind it.
    shut.ignore(1);
    go(other, 4.0);
    EXPECT_GT(other.position().x, 2.0);
    shut.stop_ignoring(1);
    for (double t = 0.0; t < 4.0; t += 1.0 / 60.0) other.step({.velocity = {-1.4, 0.0, 0.0}}, 1.0 / 60.0);
    EXPECT_GT(other.position().x, 0.3);
    shut.stop_ignoring(1);
  }
}

TEST(Filtered, FreesABodyOnWhichADoorIsShut) {
  const World world = World::build(room_with_door());
  Filtered space(world);
  space.ignore(1);
  roam::Walker walker(space, {}, roam::Mode::walk, {0.1, 0.0, 1.0});
  space.stop_ignoring(1);
  walker.step({}, 1.0 / 60.0);
  EXPECT_TRUE(walker.report().has(roam::EventKind::freed));
  EXPECT_FALSE(walker.held());
  EXPECT_TRUE(space.fits(walker.body(), walker.position()));
}

TEST(Filtered, IgnoresNothingThatIsUnknown) {
  roam::Patchwork patchwork;
  patchwork.expect({{1.0, -1.0, -1.0}, {2.0, 1.0, 1.0}});
  patchwork.update();
  Filtered some(patchwork);
  some.ignore(0);
  some.ignore(roam::no_object);
  EXPECT_FALSE(some.ignores(roam::no_object));
  EXPECT_TRUE(some.sweep({.radius = 0.1}, Vec3(0.0), {3.0, 0.0, 0.0}).unknown);
}

}  // namespace
