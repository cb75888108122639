// The sweep of one triangle, judged in 113 bits; and the same told otherwise gets the same answer: moved, turned about
// z, mirrored, corners reordered, split, backwards, by halves.

#include <algorithm>
#include <glm/geometric.hpp>

#include "generated.h"
#include "hit_resolution.h"
#include "oracle.h"

namespace {

using generated::OneTriangle;
using oracle::Quad;
using roam::SweepResult;
using roam::Triangle;
using roam::Vec3;

SweepResult answer(const OneTriangle& c) { return roam::sweep(c.body, c.from, c.motion, c.triangle); }

double resolution(const OneTriangle& c) {
  const Triangle& t = c.triangle;
  return roam::certified::hit_resolution(c.body, c.motion, {{t[0] - c.from, t[1] - c.from, t[2] - c.from}, 0.0}, 1.0);
}

void judge(const OneTriangle& c, const SweepResult& s) {
  const Quad radius = c.body.radius;
  if (!s.hit || s.time > 0.0) {
    RC_ASSERT(oracle::least_distance<Quad>(c.body, c.from, c.motion, s.time, c.triangle) >= radius);
  }
  if (s.hit) {
    const Quad distance = oracle::distance_on_the_way<Quad>(c.body, c.from, c.motion, s.time, c.triangle);
    RC_ASSERT(static_cast<double>(distance - radius) <= resolution(c));
    RC_ASSERT(std::abs(glm::length(s.normal) - 1.0) <= 1e-15);
  } else {
    RC_ASSERT(s.time == 1.0);
    const Quad least = oracle::least_distance<Quad>(c.body, c.from, c.motion, 1.0, c.triangle);
    RC_ASSERT(Quad(s.distance) <= least - radius);
  }
}

TEST(SweepProperties, IsFreeUntilItsTimeAndTouchesThen) {
  int hits = 0, in_touch = 0;
  const int held = generated::check(5000, [&](const OneTriangle& c) {
    const SweepResult s = answer(c);
    judge(c, s);
    hits += s.hit && s.time > 0.0;
    in_touch += s.hit && s.time == 0.0;
  });
  EXPECT_GE(hits, held / 5);
  EXPECT_GE(in_touch, held / 100);
}

TEST(SweepProperties, ProximityIsALowerBoundAndTight) {
  generated::check(5000, [](const OneTriangle& c) {
    const roam::Proximity p = roam::proximity(c.body, c.from, c.triangle);
    const double gap = static_cast<double>(oracle::distance<Quad>(c.body, c.from, c.triangle) - Quad(c.body.radius));
    if (gap <= -c.body.radius + 1e-12) return;  // the axis meets the triangle: the distance is a depth
    RC_ASSERT(p.distance <= gap);
    RC_ASSERT(p.distance >= gap - 2.0 * resolution(c));
  });
}

/// Metres along the motion are worth this much gap or more, unless the hit is grazing.
constexpr double steep = 0.05;

/// Whether `s` answers `c`, told by an `other` way of asking: same outcome, time and depth. `rounding` (m) is that of
/// the way of asking.
void expect_same(const OneTriangle& c, const SweepResult& s, const SweepResult& other, double rounding = 0.0) {
  const double close = 2.0 * resolution(c) + rounding;
  if (s.hit != other.hit) {
    // Only at the radius itself may they differ.
    const Quad least = oracle::least_distance<Quad>(c.body, c.from, c.motion, 1.0, c.triangle);
    RC_ASSERT(std::abs(static_cast<double>(least - Quad(c.body.radius))) <= close);
  } else if (!s.hit || s.time == 0.0) {
    RC_ASSERT(std::abs(s.distance - other.distance) <= 1e-9 * (c.body.radius + std::abs(s.distance)) + close);
  } else {
    const double approach = -glm::dot(s.normal, c.motion);
    if (approach < steep * glm::length(c.motion)) return;
    RC_ASSERT(std::abs(s.time - other.time) <= close / approach);
  }
}

template <class Map>
OneTriangle mapped(OneTriangle c, Map map) {
  c.from = map(c.from);
  c.motion = map(c.motion);
  for (Vec3& corner : c.triangle) corner = map(corner);
  return c;
}

TEST(SweepProperties, TranslationDoesNotChangeABit) {
  generated::check(20000, [](const OneTriangle& c) {
    for (const Vec3& by :
         {Vec3(-13739, 253, 182), Vec3(1e5, 1e5, -1e5), Vec3(6.4e6, -6.4e6, 6.4e6), Vec3(1e9, -1e9, 1e9)}) {
      OneTriangle moved = c;
      moved.from += by;
      for (Vec3& corner : moved.triangle) corner += by;
      const SweepResult s = answer(c), t = answer(moved);
      RC_ASSERT(s.hit == t.hit);
      RC_ASSERT(s.time == t.time);
      RC_ASSERT(s.distance == t.distance);
      RC_ASSERT(generated::text(s.normal) == generated::text(t.normal));
      RC_ASSERT(s.feature == t.feature);
    }
  });
}

TEST(SweepProperties, TurningAboutTheVerticalDoesNotMatter) {
  generated::check(20000, [](const OneTriangle& c) {
    expect_same(c, answer(c), answer(mapped(c, [](const Vec3& v) { return Vec3(-v.y, v.x, v.z); })));
    // Turning by no quarter rounds the scene itself.
    const double cosine = std::cos(0.7), sine = std::sin(0.7);
    const OneTriangle turned =
        mapped(c, [&](const Vec3& v) { return Vec3(cosine * v.x - sine * v.y, sine * v.x + cosine * v.y, v.z); });
    expect_same(c, answer(c), answer(turned), 1e-12);
  });
}

TEST(SweepProperties, MirroringDoesNotMatter) {
  generated::check(20000, [](const OneTriangle& c) {
    for (int k = 0; k < 3; ++k) {
      expect_same(c, answer(c), answer(mapped(c, [k](Vec3 v) {
                    v[k] = -v[k];
                    return v;
                  })));
    }
  });
}

TEST(SweepProperties, OrderOfCornersDoesNotMatter) {
  generated::check(20000, [](const OneTriangle& c) {
    int order[] = {0, 1, 2};
    while (std::next_permutation(order, order + 3)) {
      OneTriangle other = c;
      other.triangle = {c.triangle[order[0]], c.triangle[order[1]], c.triangle[order[2]]};
      expect_same(c, answer(c), answer(other));
    }
  });
}

TEST(SweepProperties, SplittingATriangleDoesNotMatter) {
  generated::check(20000, [](const OneTriangle& c) {
    const auto& [x, y, z] = c.triangle;
    const Vec3 xy = 0.5 * (x + y), yz = 0.5 * (y + z), zx = 0.5 * (z + x);
    SweepResult first;
    first.distance = 1e9;
    for (const Triangle& part : {Triangle{x, xy, zx}, {y, yz, xy}, {z, zx, yz}, {xy, yz, zx}}) {
      const SweepResult s = roam::sweep(c.body, c.from, c.motion, part);
      const bool earlier = s.hit != first.hit     ? s.hit
                           : s.time != first.time ? s.time < first.time
                                                  : s.distance < first.distance;
      if (earlier) first = s;
    }
    const SweepResult whole = answer(c);
    // A body that is pierced by the whole may leave a part by a shorter way.
    if (whole.hit && whole.distance < 0.0) {
      RC_ASSERT(first.hit);
      RC_ASSERT(first.distance < 0.0);
    } else {
      expect_same(c, whole, first);
    }
  });
}

TEST(SweepProperties, TheWayBackIsAsFreeAsTheWayThere) {
  generated::check(20000, [](const OneTriangle& c) {
    OneTriangle back = c;
    back.from = c.from + c.motion;
    back.motion = -c.motion;
    const SweepResult there = answer(c), home = answer(back);
    // Where either hits, only the outcome is the same.
    if (there.hit && home.hit) return;
    expect_same(c, there, home);
  });
}

TEST(SweepProperties, HalfTheMotionMeetsItAtTwiceTheTime) {
  generated::check(20000, [](const OneTriangle& c) {
    OneTriangle half = c;
    half.motion *= 0.5;
    const SweepResult whole = answer(c);
    SweepResult first = answer(half);
    if (!whole.hit || whole.time >= 0.5) {
      if (first.hit) expect_same(half, first, {.distance = whole.distance});
      return;
    }
    first.time *= 0.5;
    expect_same(c, whole, first);
  });
}

TEST(SweepProperties, ALargerBodyIsNeverMetLater) {
  generated::check(20000, [](const OneTriangle& c) {
    OneTriangle larger = c;
    larger.body.radius +=
        *rc::gen::map(generated::number(0.0, 0.3), [](double more) { return more + generated::grid; });
    const SweepResult small = answer(c), large = answer(larger);
    RC_ASSERT(!small.hit || large.hit);
    RC_ASSERT(large.time <= small.time);
  });
}

}  // namespace
