// Every vector instruction set that this machine has gives the same bits.

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "clutter.h"
#include "roam/world.h"

namespace {

struct Answers {
  std::vector<roam::Impact> sweeps;
  std::vector<roam::Clearance> clearances;
  std::vector<double> gaps;
};

Answers ask(const roam::World& world) {
  clutter::Random random(11);
  Answers out;
  for (int q = 0; q < 20000; ++q) {
    const roam::Body body{random.between(0.0, 0.5), q % 2 == 0 ? 0.0 : random.between(0.0, 1.0)};
    const roam::Vec3 from = random.in_box(22.0),
                     motion = random.direction() * std::pow(10.0, random.between(-3.0, 1.5));
    out.sweeps.push_back(world.sweep(body, from, motion));
    const roam::Vec3 way = q % 3 == 0 ? roam::Vec3(0.0) : motion;
    out.clearances.push_back(world.clearance(body, from, way, 0.5));
    out.gaps.push_back(world.gap_bound(body, from, way, 0.5));
  }
  return out;
}

TEST(InstructionSets, GiveTheSameBits) {
  clutter::Random random(10);
  const roam::Mesh mesh = clutter::make(random, {20000, 20.0, 0.01, 5.0, roam::Vec3(0.0)});
  const roam::World world = roam::World::build({&mesh, 1});
  const Answers best = ask(world);
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
    ++tried;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  EXPECT_GT(tried, 1) << "this machine has one instruction set only: nothing was compared";
}

}  // namespace
