#pragma once
/// \file
/// First impacts, compared with the sweeps that they are parts of.

#include <vector>

#include "vicinity_course.h"

namespace first_impacts {

/// Spheres, capsules, points, moving and at rest, in a box of half side `half` (m).
inline std::vector<roam::Query> queries(std::uint64_t seed, double half, int count) {
  clutter::Random random(seed);
  std::vector<roam::Query> all;
  for (int i = 0; i < count; ++i) {
    roam::Query q{course::some_body(random, 0.6), random.in_box(half), random.in_box(2.0)};
    if (i % 7 == 0) q.body = {0.0, 0.0};
    if (i % 11 == 0) q.motion = roam::Vec3(0.0);
    if (i % 13 == 0) q.motion *= 50.0;
    all.push_back(q);
  }
  return all;
}

struct Tally {
  long hits = 0, misses = 0, at_start = 0, unknown = 0;
};

inline Tally compare(const roam::Space& space, const std::vector<roam::Query>& queries) {
  Tally tally;
  for (const roam::Query& q : queries) {
    const roam::Impact whole = space.sweep(q);
    const roam::FirstImpact first = space.first_impact(q);
    const auto judge = [&] {
      ASSERT_EQ(first.hit, whole.hit);
      ASSERT_TRUE(course::same(first.time, whole.time));
      ASSERT_EQ(first.triangle, whole.triangle);
      ASSERT_EQ(first.object, whole.object);
      ASSERT_EQ(first.unknown, whole.unknown);
      ASSERT_TRUE(!first.contact || first.contact->triangle == first.triangle);
      ASSERT_TRUE(course::same(space.completed(q, first), whole));
    };
    judge();
    if (testing::Test::HasFatalFailure()) break;
    ++(whole.hit ? tally.hits : tally.misses);
    tally.at_start += whole.hit && whole.time == 0.0 ? 1 : 0;
    tally.unknown += whole.unknown ? 1 : 0;
  }
  return tally;
}

}  // namespace first_impacts
