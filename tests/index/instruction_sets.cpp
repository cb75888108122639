// Every vector instruction set, compiler and kind of processor gives the same bits.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <bit>
#include <cstdint>

#include "clutter.h"
#include "roam/walker.h"
#include "roam/world.h"

namespace {

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

/// FNV-1a of all answers, 64 bits at a time.
std::uint64_t digest(const Answers& answers) {
  std::uint64_t hash = 0xcbf29ce484222325U;
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
  for (const roam::Vec3& place : answers.way) add_vector(place);
  return hash;
}

/// `expected` is the digest of the answers. Another one means: this compiler or processor computes something else, or
/// roam has been changed. Only then the new digest takes its place.
void expect_the_same_bits(bool lossless, std::uint64_t expected) {
  clutter::Random random(10);
  std::vector<roam::Mesh> meshes;
  for (const double size : {0.01, 0.05, 0.3, 1.5, 5.0}) {
    meshes.push_back(clutter::make(random, {4000, 20.0, size, size, roam::Vec3(0.0)}));
  }
  const roam::World world = roam::World::build(meshes, {.lossless = lossless});
  const Answers best = ask(world);
  EXPECT_GT(best.way.size(), 1000U);
  EXPECT_EQ(digest(best), expected);
  int tried = 0;
  const auto supported = hwy::SupportedTargets();
  for (auto left = supported; left != 0; left &= left - 1) {
    const auto target = left & -left;
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().DeInit();
    SCOPED_TRACE(hwy::TargetName(target));
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
    ASSERT_EQ(digest(best), digest(other));
    ASSERT_EQ(best.way, other.way);
    ++tried;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  EXPECT_GT(tried, 0);
}

TEST(InstructionSets, GiveTheSameBits) { expect_the_same_bits(false, 18055254882522728647U); }

TEST(InstructionSets, GiveTheSameBitsInALosslessWorld) { expect_the_same_bits(true, 11035967529364366896U); }

}  // namespace
