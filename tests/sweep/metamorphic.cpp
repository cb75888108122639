// The same scene told otherwise gets the same answer: moved, turned about z, mirrored, corners reordered, split.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <vector>

#include "hit_resolution.h"
#include "oracle.h"
#include "roam/sweep.h"
#include "sweep/certified.h"

namespace {

using oracle::Quad;
using roam::Body;
using roam::Triangle;
using roam::Vec3;

struct Query {
  Body body;
  Vec3 from;
  Vec3 motion;
  Triangle triangle;
};

/// Coordinates on a grid of 2^-20 m: sums, differences and halves of them are exact, also far from the origin.
class Generator {
 public:
  Query next() {
    Query q;
    q.body = {on_grid(0.25) + 0.3, random_() % 2 == 0 ? 0.0 : on_grid(0.5) + 0.6};
    q.triangle = {point(2.0), point(2.0), point(2.0)};
    q.from = point(4.0);
    q.motion = point(2.0) - q.from;
    return q;
  }

 private:
  double on_grid(double size) {
    return std::floor((static_cast<double>(random_() >> 11) * 0x1p-52 - 1.0) * size * 0x1p20) * 0x1p-20;
  }
  Vec3 point(double size) { return {on_grid(size), on_grid(size), on_grid(size)}; }

  std::mt19937_64 random_{5};
};

constexpr int queries = 20000;

roam::SweepResult answer(const Query& q) { return roam::sweep(q.body, q.from, q.motion, q.triangle); }

/// Metres along the motion are worth this much gap or more, unless the hit is grazing.
constexpr double steep = 0.05;

/// Whether `s` answers `q`, told by an `other` way of asking: same outcome, time and depth.
void expect_same(const Query& q, const roam::SweepResult& s, const roam::SweepResult& other) {
  const double resolution =
      2.0 * roam::certified::hit_resolution(
                q.body, q.motion, {{q.triangle[0] - q.from, q.triangle[1] - q.from, q.triangle[2] - q.from}, 0.0}, 1.0);
  if (s.hit != other.hit) {
    // Only at the radius itself may they differ.
    const Quad least = oracle::least_distance<Quad>(q.body, q.from, q.motion, 1.0, q.triangle);
    EXPECT_NEAR(static_cast<double>(least - Quad(q.body.radius)), 0.0, resolution);
    return;
  }
  if (!s.hit || s.time == 0.0) {
    EXPECT_NEAR(s.distance, other.distance, 1e-9 * (q.body.radius + std::abs(s.distance)) + resolution);
    return;
  }
  const double approach = -glm::dot(s.normal, q.motion);
  if (approach < steep * glm::length(q.motion)) return;
  EXPECT_NEAR(s.time, other.time, resolution / approach);
}

template <class Change>
void expect_unchanged_by(Change change) {
  Generator generator;
  int hits = 0;
  for (int i = 0; i < queries; ++i) {
    const Query q = generator.next();
    const roam::SweepResult s = answer(q);
    hits += s.hit ? 1 : 0;
    expect_same(q, s, answer(change(q)));
  }
  EXPECT_GT(hits, queries / 5);
  EXPECT_LT(hits, queries);
}

template <class Map>
Query mapped(Query q, Map map) {
  q.from = map(q.from);
  q.motion = map(q.motion);
  for (Vec3& corner : q.triangle) corner = map(corner);
  return q;
}

TEST(SweepMetamorphic, TranslationDoesNotChangeABit) {
  for (const Vec3& by :
       {Vec3(-13739, 253, 182), Vec3(1e5, 1e5, -1e5), Vec3(6.4e6, -6.4e6, 6.4e6), Vec3(1e9, -1e9, 1e9)}) {
    Generator generator;
    for (int i = 0; i < queries; ++i) {
      const Query q = generator.next();
      Query moved = q;
      moved.from += by;
      for (Vec3& corner : moved.triangle) corner += by;
      const auto s = answer(q), t = answer(moved);
      EXPECT_EQ(s.hit, t.hit);
      EXPECT_EQ(s.time, t.time);
      EXPECT_EQ(s.distance, t.distance);
      EXPECT_EQ(s.normal, t.normal);
      EXPECT_EQ(s.feature, t.feature);
    }
  }
}

TEST(SweepMetamorphic, QuarterTurnsAboutTheVerticalDoNotMatter) {
  expect_unchanged_by([](const Query& q) { return mapped(q, [](const Vec3& v) { return Vec3(-v.y, v.x, v.z); }); });
}

TEST(SweepMetamorphic, TurningAboutTheVerticalDoesNotMatter) {
  const double c = std::cos(0.7), s = std::sin(0.7);
  Generator generator;
  for (int i = 0; i < queries; ++i) {
    const Query q = generator.next();
    const Query turned = mapped(q, [&](const Vec3& v) { return Vec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z); });
    const auto a = answer(q), b = answer(turned);
    // Turning rounds the scene itself.
    const double rounding = 1e-14;
    if (a.hit != b.hit) {
      const Quad least = oracle::least_distance<Quad>(q.body, q.from, q.motion, 1.0, q.triangle);
      EXPECT_NEAR(static_cast<double>(least - Quad(q.body.radius)), 0.0, 100.0 * rounding);
    } else if (a.hit && a.time > 0.0) {
      const double approach = -glm::dot(a.normal, q.motion);
      if (approach > steep * glm::length(q.motion)) {
        EXPECT_NEAR(a.time, b.time, 100.0 * rounding / approach);
      }
    } else {
      EXPECT_NEAR(a.distance, b.distance, 1e-9);
    }
  }
}

TEST(SweepMetamorphic, MirroringDoesNotMatter) {
  for (int k = 0; k < 3; ++k) {
    expect_unchanged_by([k](const Query& q) {
      return mapped(q, [k](Vec3 v) {
        v[k] = -v[k];
        return v;
      });
    });
  }
}

TEST(SweepMetamorphic, OrderOfCornersDoesNotMatter) {
  int order[] = {0, 1, 2};
  while (std::next_permutation(order, order + 3)) {
    expect_unchanged_by([&](Query q) {
      const Triangle t = q.triangle;
      q.triangle = {t[order[0]], t[order[1]], t[order[2]]};
      return q;
    });
  }
}

TEST(SweepMetamorphic, SplittingATriangleDoesNotMatter) {
  Generator generator;
  int hits = 0;
  for (int i = 0; i < queries; ++i) {
    const Query q = generator.next();
    const auto& [a, b, c] = q.triangle;
    const Vec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), ca = 0.5 * (c + a);
    const Triangle parts[] = {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}};
    roam::SweepResult first;
    first.distance = 1e9;
    for (const Triangle& part : parts) {
      const auto s = roam::sweep(q.body, q.from, q.motion, part);
      const bool earlier = s.hit != first.hit     ? s.hit
                           : s.time != first.time ? s.time < first.time
                                                  : s.distance < first.distance;
      if (earlier) first = s;
    }
    const auto whole = answer(q);
    hits += whole.hit ? 1 : 0;
    // A body that is pierced by the whole may leave a part by a shorter way.
    if (whole.hit && whole.distance < 0.0) {
      EXPECT_TRUE(first.hit);
      EXPECT_LT(first.distance, 0.0);
    } else {
      expect_same(q, whole, first);
    }
  }
  EXPECT_GT(hits, queries / 5);
}

}  // namespace
