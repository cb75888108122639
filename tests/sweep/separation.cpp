// The plane of a triangle as a quick way to tell that a moving body stays clear of it.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "adversarial_queries.h"
#include "oracle.h"
#include "sweep/certified.h"
#include "sweep/error_bound.h"

namespace {

using adversarial::Query;
using oracle::Quad;
using roam::Body;
using roam::Vec3;
namespace certified = roam::certified;

bool separates(const Query& q) {
  certified::LocalTriangle t{};
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    t.corner[i] = q.triangle[i] - q.from;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(t.corner[i][k]));
  }
  t.corner_error = certified::unit_roundoff * largest;
  return certified::plane_separates(q.body, q.motion, t);
}

TEST(PlaneSeparation, RejectsNothingThatIsTouched) {
  int rejected = 0, all = 0;
  for (const adversarial::Kind kind : adversarial::kinds) {
    for (const bool capsule : {false, true}) {
      for (const Vec3& origin : adversarial::origins) {
        adversarial::Generator generator(kind, capsule, origin, 78u + static_cast<unsigned>(kind));
        for (int i = 0; i < 100; ++i) {
          const Query q = generator.next();
          ++all;
          if (!separates(q)) continue;
          ++rejected;
          ASSERT_GE(oracle::least_distance<Quad>(q.body, q.from, q.motion, 1.0, q.triangle), Quad(q.body.radius))
              << adversarial::name(kind) << ' ' << i;
        }
      }
    }
  }
  EXPECT_GT(rejected, all / 20);
}

TEST(PlaneSeparation, IsDecidedByTheBodysOwnReach) {
  // A slope of 45 degrees, on the other side of which nothing is.
  const auto gap = [](const Body& body, double beyond) {
    const double away = body.radius + body.half_height * std::sqrt(0.5) + beyond;
    const Vec3 start = away * std::sqrt(0.5) * Vec3(1.0, 0.0, 1.0);
    return Query{body, start, Vec3(0.0, 5.0, 0.0), {Vec3(-1, -1, 1), Vec3(1, -1, -1), Vec3(0, 1, 0)}};
  };
  for (const Body& body : {Body{0.3, 0.0}, Body{0.3, 0.6}, Body{0.0, 0.6}}) {
    EXPECT_TRUE(separates(gap(body, 1e-13)));
    EXPECT_FALSE(separates(gap(body, -1e-13)));
    Query towards = gap(body, 1.0);
    towards.motion = {-0.7, 0.0, -0.7};
    EXPECT_TRUE(separates(towards));
    towards.motion = {-0.8, 0.0, -0.8};
    EXPECT_FALSE(separates(towards));
  }
}

TEST(PlaneSeparation, SaysNothingOfTrianglesWhoseNormalUnderflows) {
  for (const double edge : {0.0, 1e-200, 1e-100, 1e-85, 1e-82, 1e-70}) {
    // In touch: the ball reaches 0.5 m, and the triangle is 0.1 m away.
    const Query q{{0.5, 0.0}, Vec3(0.0), Vec3(0.0), {Vec3(0, 0, 0.1), Vec3(edge, 0, 0.1), Vec3(0, edge, 0.1)}};
    EXPECT_FALSE(separates(q)) << edge;
  }
}

}  // namespace
