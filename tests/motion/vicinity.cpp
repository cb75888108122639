// What a walker keeps of the space around it is no more than a shorter way to the same answers: where it goes does not
// depend on it.

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "roam/collector.h"
#include "walker_judged.h"

namespace {

using namespace scenes;
using roam::Collector;
using roam::Space;
using roam::TriangleId;
using roam::Vicinity;
using roam::WalkerInput;

/// Passes every query on to a world, with or without what the body keeps, and counts them.
class Counting final : public Space {
 public:
  mutable bool forgets = false;
  mutable long sweeps = 0, sweeps_in = 0, gaps = 0, gaps_in = 0;
  mutable double farthest = 0.0;  ///< greatest reach of a gap

  explicit Counting(const World& world) : world_(world) {}

  [[nodiscard]] roam::SpaceFacts facts() const override { return world_.facts(); }
  [[nodiscard]] roam::Object object(TriangleId triangle) const override { return world_.object(triangle); }

 protected:
  [[nodiscard]] roam::FirstImpact find_first(const roam::Query& query, Vicinity* vicinity) const override {
    ++(vicinity ? sweeps_in : sweeps);
    return Space::find_first_of(world_, query, forgets ? nullptr : vicinity);
  }
  void find_near(const roam::Query& query, Collector& collector, Vicinity* vicinity) const override {
    if (collector.kind() == Collector::Kind::gap) {
      ++(vicinity ? gaps_in : gaps);
      farthest = std::max(farthest, collector.initial_reach());
    }
    Space::find_near_of(world_, query, collector, forgets ? nullptr : vicinity);
  }

 private:
  const World& world_;
};

/// A floor of many triangles in a hall of 20 m, with kerbs, boxes and leaning boards.
Mesh furnished(std::uint64_t seed) {
  Random random(seed);
  Mesh m = rough_tiling(60, seed);
  add_box(m, {-9.0, -9.0, -1.0}, {9.0, 9.0, 3.0});
  for (int i = 0; i < 25; ++i) {
    const Vec3 lo(random.between(-8.0, 8.0), random.between(-8.0, 8.0), 0.0);
    const double height = random.chance(0.5) ? random.between(0.02, 0.2) : random.between(0.4, 2.0);
    add_box(m, lo, lo + Vec3(random.between(0.2, 1.5), random.between(0.2, 1.5), height));
  }
  for (int i = 0; i < 25; ++i) {
    const Vec3 at(random.between(-8.0, 8.0), random.between(-8.0, 8.0), random.between(0.0, 0.5));
    const auto leg = [&] {
      return Vec3(random.between(-1.0, 1.0), random.between(-1.0, 1.0), random.between(-0.4, 0.4));
    };
    add_triangle(m, at, at + leg(), at + leg());
  }
  return m;
}

/// What is wished at each step: a heading for a while, at the pace of a walk, now and then a jump or a crouch.
std::vector<WalkerInput> wishes(Random& random, int steps, bool plain = false) {
  std::vector<WalkerInput> all;
  double heading = 0.0;
  bool crouch = false;
  for (int i = 0; i < steps; ++i) {
    if (i % 30 == 0) heading = random.between(0.0, 2.0 * std::numbers::pi);
    if (!plain && random.chance(0.02)) crouch = !crouch;
    const Vec3 velocity(1.4 * std::cos(heading), 1.4 * std::sin(heading), 0.0);
    all.push_back({velocity, !plain && random.chance(0.01), crouch});
  }
  return all;
}

void expect_same(const Walker& a, const Walker& b) {
  ASSERT_EQ(a.position(), b.position());
  ASSERT_EQ(a.held(), b.held());
  ASSERT_EQ(a.crouched(), b.crouched());
  const StepReport &r = a.report(), &s = b.report();
  ASSERT_EQ(r.axis_clearance, s.axis_clearance);
  ASSERT_EQ(r.least_gap, s.least_gap);
  ASSERT_EQ(r.segments.total(), s.segments.total());
  for (std::size_t i = 0; i < r.segments.size(); ++i) {
    ASSERT_EQ(r.segments[i].position, s.segments[i].position);
    ASSERT_EQ(r.segments[i].axis_clearance, s.segments[i].axis_clearance);
    ASSERT_EQ(r.segments[i].time, s.segments[i].time);
  }
  ASSERT_EQ(r.contacts.total(), s.contacts.total());
  for (std::size_t i = 0; i < r.contacts.size(); ++i) {
    ASSERT_EQ(r.contacts[i].distance, s.contacts[i].distance);
    ASSERT_EQ(r.contacts[i].point, s.contacts[i].point);
  }
  ASSERT_EQ(r.events.total(), s.events.total());
  for (std::size_t i = 0; i < r.events.size(); ++i) ASSERT_EQ(r.events[i].kind, s.events[i].kind);
}

TEST(WalkerVicinity, TwoThatAreToldTheSameGoTheSameWay) {
  constexpr int steps = 1500;
  long touched = 0;
  for (std::uint64_t seed = 1; seed <= 6; ++seed) {
    SCOPED_TRACE(seed);
    const World world = build(furnished(seed));
    const Mode mode = seed % 3 == 0 ? Mode::fly : Mode::walk;
    Random random(seed);
    const Vec3 start(0.5, 0.5, 2.0);
    Walker one(world, {}, mode, start), other(world, {}, mode, start), third(world, {}, mode, {3.0, -2.0, 2.0});
    const std::vector<WalkerInput> way = wishes(random, steps), astray = wishes(random, steps);
    std::vector<Walker> copies;
    for (int i = 0; i < steps; ++i) {
      SCOPED_TRACE(i);
      if (i % 400 == 317) copies.push_back(one);
      const auto at = static_cast<std::size_t>(i);
      one.step(way[at], frame);
      (void)third.step(astray[at], frame);
      other.step(way[at], frame);
      ASSERT_NO_FATAL_FAILURE(expect_same(one, other));
      for (Walker& copy : copies) {
        copy.step(way[at], frame);
        ASSERT_NO_FATAL_FAILURE(expect_same(one, copy));
      }
      touched += one.report().contacts.empty() ? 0 : 1;
    }
    ASSERT_FALSE(copies.empty());
    // One that was copied goes on as if it had not been, also after the copy went elsewhere and was copied back.
    Walker back = one;
    for (int i = 0; i < 200; ++i) (void)back.step(astray[static_cast<std::size_t>(i)], frame);
    back = one;
    for (int i = 0; i < 200; ++i) {
      back.step(way[static_cast<std::size_t>(i)], frame);
      one.step(way[static_cast<std::size_t>(i)], frame);
      ASSERT_NO_FATAL_FAILURE(expect_same(one, back));
    }
  }
  EXPECT_GT(touched, 200);
}

TEST(WalkerVicinity, OneThatIsPutGoesAsOneThatIsNew) {
  constexpr int steps = 600;
  for (std::uint64_t seed = 21; seed <= 30; ++seed) {
    SCOPED_TRACE(seed);
    const World world = build(furnished(seed));
    Random random(seed);
    const Vec3 start(0.3, 0.2, 1.2);
    Walker fresh(world, {}, Mode::walk, start), used(world, {}, Mode::walk, start + Vec3(0.35, -0.3, 0.0));
    for (int i = 0; i < 7; ++i) (void)used.step({.velocity = {0.4, 0.3, 0.0}}, frame);
    used.place(start);
    fresh.place(start);
    ASSERT_NO_FATAL_FAILURE(expect_same(fresh, used));
    int i = 0;
    for (const WalkerInput& wish : wishes(random, steps)) {
      SCOPED_TRACE(i++);
      fresh.step(wish, frame);
      used.step(wish, frame);
      ASSERT_NO_FATAL_FAILURE(expect_same(fresh, used));
    }
  }
}

/// Metres. What the last digits of single answers make of one step, unless they decide something: whether the body that
/// hovers about a skin above the ground stays as it is, whether it comes over an edge.
constexpr double apart_in_a_step = 1e-4;

TEST(WalkerVicinity, GoesAsOneThatKeepsNothing) {
  constexpr int steps = 2500, seeds = 12;
  double length = 0.0;
  long touched = 0, decided = 0;
  for (std::uint64_t seed = 11; seed < 11 + seeds; ++seed) {
    SCOPED_TRACE(seed);
    const World world = build(furnished(seed));
    const Counting space(world);
    Random random(seed);
    Walker keeps(space, {}, Mode::walk, {0.5, 0.5, 2.0});
    for (const WalkerInput& wish : wishes(random, steps)) {
      Walker forgets = keeps;
      space.forgets = true;
      forgets.step(wish, frame);
      space.forgets = false;
      keeps.step(wish, frame);
      const double apart = glm::length(keeps.position() - forgets.position());
      decided += apart > apart_in_a_step ? 1 : 0;
      ASSERT_EQ(keeps.held(), forgets.held());
      length += glm::length(keeps.report().to - keeps.report().from);
      touched += keeps.report().contacts.empty() ? 0 : 1;
    }
    // It does ask by what it keeps.
    EXPECT_EQ(space.gaps, 0);
    EXPECT_GT(space.gaps_in, steps / 2);
    EXPECT_GT(space.sweeps_in, steps / 2);
    EXPECT_LT(space.sweeps, space.sweeps_in / 10);
  }
  EXPECT_LE(decided, steps * seeds / 10'000);
  EXPECT_GT(length, 50.0);
  EXPECT_GT(touched, 1000);
}

TEST(WalkerVicinity, ABodyOnItsFloorLooksNoFartherThanTheFloor) {
  const World world = build(rough_tiling(40, 3));
  const Counting space(world);
  Walker w(space, {}, Mode::walk, {-8.0, -8.0, 0.95});
  for (int i = 0; i < 10; ++i) w.step({.velocity = {1.4, 0.0, 0.0}}, frame);
  space.farthest = 0.0;
  for (int i = 0; i < 100; ++i) w.step({.velocity = {5.0, 0.0, 0.0}}, frame);
  EXPECT_GT(space.gaps_in, 100);
  EXPECT_LE(space.farthest, w.skin());
}

}  // namespace
