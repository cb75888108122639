// Every vector instruction set, compiler and kind of processor gives the same bits, and right answers.

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/index/instruction_sets.cpp"
#include <hwy/foreach_target.h>
// Must come after foreach_target.h.
#include <hwy/highway.h>

#include "index/traverse.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

/// The library's own; null if it was built without this instruction set.
[[gnu::weak]] Impact FirstImpact(const Index& index, const Piece& piece, double until);

/// The instruction set to which calls go; 0 if the library was built without it.
inline std::int64_t Dispatched() { return &FirstImpact != nullptr ? std::int64_t{HWY_TARGET} : 0; }

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE

#include <gtest/gtest.h>

#include <bit>
#include <ostream>
#include <utility>

#include "clutter.h"
#include "judged_queries.h"
#include "roam/world.h"

namespace roam::index {
HWY_EXPORT(Dispatched);
}

namespace {

/// The instruction sets that the compiler was configured for and this processor says that it has.
std::int64_t expected_sets() {
  std::int64_t sets = HWY_STATIC_TARGET;
#if defined(__x86_64__)
  __builtin_cpu_init();
  const auto has = [&](bool whether, std::int64_t set) { sets |= whether ? set : 0; };
  has(__builtin_cpu_supports("ssse3"), HWY_SSSE3);
  has(__builtin_cpu_supports("sse4.2") && __builtin_cpu_supports("aes") && __builtin_cpu_supports("pclmul"), HWY_SSE4);
  has(__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("bmi2"), HWY_AVX2);
  has(__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") && __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512cd"),
      HWY_AVX3);
#elif defined(__aarch64__)
  sets |= HWY_NEON;
#endif
  return sets & HWY_TARGETS;
}

/// Calls `ask` with each instruction set. Fails if one that the processor has is not tried, or calls go elsewhere.
template <class Ask>
void with_each_set(const Ask& ask) {
  std::int64_t tried = 0;
  std::string names;
  for (const std::int64_t set : hwy::SupportedAndGeneratedTargets()) {
    hwy::SetSupportedTargetsForTest(set);
    hwy::GetChosenTarget().DeInit();
    SCOPED_TRACE(hwy::TargetName(set));
    const std::int64_t dispatched = [] {
      using namespace roam::index;
      return HWY_DYNAMIC_DISPATCH(Dispatched)();
    }();
    EXPECT_EQ(dispatched, set) << "the library was built without it";
    ask();
    if (dispatched == set) tried |= set;
    names += std::string(names.empty() ? "" : " ") + hwy::TargetName(set);
    if (testing::Test::HasFatalFailure()) break;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  if (testing::Test::HasFatalFailure()) return;
  std::cout << "tried: " << names << '\n';
  for (std::int64_t missing = expected_sets() & ~tried; missing != 0; missing &= missing - 1) {
    ADD_FAILURE() << hwy::TargetName(missing & -missing) << ", which this processor has, was not tried";
  }
}

struct Answers {
  std::vector<roam::Impact> sweeps, rays;
  std::vector<roam::Clearance> clearances;
  std::vector<double> gaps, floors;
  std::vector<roam::Contact> contacts;
  std::vector<roam::Vec3> way;  ///< of a walker and a flier
};

/// Segment by segment, from place to place.
void walk(const roam::World& world, roam::Mode mode, std::vector<roam::Vec3>& way) {
  clutter::Random random(12);
  roam::Walker walker(world, {}, mode, roam::Vec3(0.0));
  roam::Vec3 wish(0.0);
  for (int i = 0; i < 1500; ++i) {
    if (i % 100 == 0) walker.place(random.in_box(15.0));
    if (i % 15 == 0) wish = 5.0 * random.direction();
    for (const roam::Segment& segment : walker.step({.velocity = wish}, 1.0 / 60.0).segments) {
      way.push_back(segment.position);
      way.emplace_back(segment.axis_clearance);
    }
  }
}

Answers ask(const roam::World& world) {
  clutter::Random random(11);
  Answers out;
  for (int q = 0; q < 20000; ++q) {
    const double radius = random.between(0.0, 0.5), half_height = random.between(0.0, 1.0);
    const roam::Body body{q % 3 == 0 ? 0.0 : radius, q % 2 == 0 ? 0.0 : half_height};  // one in six is a short ray
    constexpr double longest[] = {0.001, 0.01, 0.1, 1.0, 10.0, 30.0};
    const roam::Vec3 from = random.in_box(22.0), direction = random.direction();
    const roam::Vec3 motion = random.between(0.0, longest[q % 6]) * direction;
    out.sweeps.push_back(world.sweep(body, from, motion));
    out.rays.push_back(world.ray(from, 30.0 * direction));
    const roam::Vec3 way = q % 5 == 0 ? roam::Vec3(0.0) : motion;
    out.clearances.push_back(world.clearance(body, from, way, 0.5));
    out.gaps.push_back(world.gap_bound(body, from, way, 0.5));
    roam::Contact contacts[8];
    const auto found = world.contacts(body, from, way, 0.2, contacts);
    out.contacts.insert(out.contacts.end(), contacts, contacts + found);
    out.floors.push_back(world.floor_clearance(body, from, 1.0, {}).distance);
  }
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly}) walk(world, mode, out.way);
  return out;
}

struct Digests {
  std::uint64_t queries, walks;
  bool operator==(const Digests&) const = default;
  friend std::ostream& operator<<(std::ostream& out, const Digests& d) { return out << d.queries << ", " << d.walks; }
};

/// FNV-1a of all answers, 64 bits at a time.
Digests digests(const Answers& answers) {
  constexpr std::uint64_t empty = 0xcbf29ce484222325U;
  std::uint64_t hash = empty;
  const auto add = [&](std::uint64_t bits) { hash = (hash ^ bits) * 0x100000001b3U; };
  const auto add_real = [&](double value) { add(std::bit_cast<std::uint64_t>(value)); };
  const auto add_vector = [&](const roam::Vec3& v) {
    for (int k = 0; k < 3; ++k) add_real(v[k]);
  };
  const auto add_impacts = [&](const std::vector<roam::Impact>& impacts) {
    for (const roam::Impact& impact : impacts) {
      add(static_cast<std::uint64_t>(impact.hit));
      if (!impact.hit) continue;
      add(impact.triangle);
      add_real(impact.time);
      add_vector(impact.point);
      add_vector(impact.normal);
    }
  };
  add_impacts(answers.sweeps);
  add_impacts(answers.rays);
  for (const roam::Clearance& clearance : answers.clearances) {
    add_real(clearance.distance);
    add(clearance.triangle);
  }
  for (const double gap : answers.gaps) add_real(gap);
  for (const double floor : answers.floors) add_real(floor);
  for (const roam::Contact& contact : answers.contacts) {
    add(contact.triangle);
    add_real(contact.distance);
    add_vector(contact.point);
  }
  const std::uint64_t queries = std::exchange(hash, empty);
  for (const roam::Vec3& place : answers.way) add_vector(place);
  return {queries, hash};
}

/// Other digests than `expected` mean: this compiler or processor computes something else, or roam has been changed.
/// Only then the new ones take their place.
void expect_the_same_bits(bool lossless, const Digests& expected) {
  clutter::Random random(10);
  std::vector<roam::Mesh> meshes;
  for (const double size : {0.01, 0.05, 0.3, 1.5, 5.0}) {
    meshes.push_back(clutter::make(random, {4000, 20.0, size, size, roam::Vec3(0.0)}));
  }
  const roam::World world = roam::World::build(meshes, {.lossless = lossless});
  const Answers best = ask(world);
  EXPECT_GT(best.way.size(), 1000U);
  EXPECT_EQ(digests(best), expected);
  with_each_set([&] {
    const Answers other = ask(world);
    for (std::size_t q = 0; q < best.sweeps.size(); ++q) {
      const auto &a = best.sweeps[q], &b = other.sweeps[q];
      ASSERT_EQ(a.hit, b.hit) << q;
      ASSERT_EQ(a.time, b.time) << q;
      ASSERT_EQ(a.triangle, b.triangle) << q;
      ASSERT_EQ(a.point, b.point) << q;
      ASSERT_EQ(best.clearances[q].distance, other.clearances[q].distance) << q;
      ASSERT_EQ(best.clearances[q].triangle, other.clearances[q].triangle) << q;
      ASSERT_EQ(best.gaps[q], other.gaps[q]) << q;
    }
    ASSERT_EQ(digests(best), digests(other));
    ASSERT_EQ(best.way, other.way);
  });
}

TEST(InstructionSets, GiveTheSameBits) { expect_the_same_bits(false, {9552819574687595078U, 12931986730012717009U}); }

TEST(InstructionSets, GiveTheSameBitsInALosslessWorld) {
  expect_the_same_bits(true, {18245185947092818419U, 11705280454903692168U});
}

/// Sweeps, rays, gaps and a walk, judged by all triangles.
void judge_by_brute_force(const roam::Mesh& mesh, bool lossless) {
  const roam::World world = scenes::build(mesh, lossless);
  const double farthest = lossless ? judged::farthest_lossless : judged::farthest_off;
  judged::NearJudge near(mesh);
  clutter::Random random(13);
  int hits = 0, misses = 0;
  for (int q = 0; q < 1200; ++q) {
    const roam::Body body{q % 3 == 0 ? 0.0 : random.between(0.0, 0.4), q % 2 == 0 ? 0.0 : random.between(0.0, 0.8)};
    const roam::Vec3 from = random.in_box(6.0), motion = random.between(0.0, 4.0) * random.direction();
    const roam::Impact s = world.sweep(body, from, motion);
    judged::judge_sweep(s, body, from, motion, farthest, near);
    judged::judge_gap(world.gap_bound(body, from, 0.1 * motion, 0.5), body, from, 0.1 * motion, 0.5, near);
    ASSERT_FALSE(testing::Test::HasFatalFailure()) << "query " << q;
    ++(s.hit ? hits : misses);
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(misses, 200);
  const scenes::Judge all(mesh);
  roam::Walker walker(world, {}, roam::Mode::fly, roam::Vec3(0.0));
  for (int i = 0; i < 200; ++i) {
    if (i % 50 == 0) walker.place(random.in_box(5.0));
    const roam::StepReport& step = walker.step({.velocity = 5.0 * random.direction()}, 1.0 / 60.0);
    ASSERT_GE(scenes::margin(all, step), 0.0) << "step " << i;
  }
}

TEST(InstructionSets, AreEachRightByBruteForce) {
  clutter::Random random(14);
  const roam::Mesh mesh = clutter::make(random, {.count = 800, .half = 5.0, .small = 0.05, .large = 3.0});
  with_each_set([&] {
    for (const bool lossless : {false, true}) judge_by_brute_force(mesh, lossless);
  });
}

}  // namespace

#endif  // HWY_ONCE
