// The certified sweep in local coordinates, as the world calls it: corners known only within an error, a start that is
// free already, a tolerance, and the time of closest approach.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "adversarial_queries.h"
#include "hit_resolution.h"
#include "oracle.h"
#include "roam/sweep.h"
#include "sweep/certified.h"
#include "sweep/gap_line.h"
#include "sweep/support_plane.h"

namespace {

using adversarial::Kind;
using adversarial::Query;
using oracle::Quad;
using roam::Vec3;
namespace certified = roam::certified;

constexpr int queries = 5000;

/// The triangle of a query at the origin, relative to its start; a single rounding apart from the truth.
certified::LocalTriangle blurred_local(const Query& q, double more_error = 0.0) {
  certified::LocalTriangle t{};
  double largest = 0.0;
  for (int i = 0; i < 3; ++i) {
    t.corner[i] = q.triangle[i] - q.from;
    for (int k = 0; k < 3; ++k) largest = std::max(largest, std::abs(t.corner[i][k]));
  }
  t.corner_error = certified::unit_roundoff * largest + more_error;
  return t;
}

template <class Check>
void for_each_query(Check check) {
  for (const Kind kind : adversarial::kinds) {
    for (const bool capsule : {false, true}) {
      adversarial::Generator generator(kind, capsule, Vec3(0), 77u + static_cast<unsigned>(kind));
      for (int i = 0; i < queries / 18; ++i) check(generator.next());
    }
  }
}

TEST(CertifiedSweep, HoldsForEveryTriangleWithinTheCornerError) {
  std::mt19937_64 random(9);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  int hits = 0;
  for_each_query([&](const Query& q) {
    const double error = std::pow(10.0, -6.0 + 3.0 * in(random));
    certified::LocalTriangle blurred = blurred_local(q, error);
    for (Vec3& corner : blurred.corner) corner += error * Vec3(in(random), in(random), in(random));
    const auto s = certified::sweep(q.body, q.motion, blurred, 0.0, 1.0, 0.0);
    const Quad least = oracle::least_distance<Quad>(q.body, q.from, q.motion, s.time, q.triangle);
    if (s.distance >= 0.0) {
      EXPECT_GE(least, Quad(q.body.radius));
    }
    if (!s.hit) {
      EXPECT_GE(least - Quad(q.body.radius), Quad(s.distance));
      return;
    }
    ++hits;
    const Quad at = oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, s.time, q.triangle);
    const double far = certified::hit_resolution(q.body, q.motion, blurred, 1.0) + 2.0 * error;
    EXPECT_LE(at - Quad(q.body.radius), Quad(far));
  });
  EXPECT_GT(hits, queries / 5);
}

TEST(CertifiedSweep, ToleranceIsKeptAndStopsEarlier) {
  int sooner = 0;
  for_each_query([&](const Query& q) {
    const double tolerance = 1e-4;
    const auto t = blurred_local(q);
    const auto s = certified::sweep(q.body, q.motion, t, 0.0, 1.0, tolerance);
    if (!s.hit) {
      EXPECT_GE(oracle::least_distance<Quad>(q.body, q.from, q.motion, 1.0, q.triangle), Quad(q.body.radius));
      return;
    }
    const Quad at = oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, s.time, q.triangle);
    const double allowed = std::max(tolerance, certified::hit_resolution(q.body, q.motion, t, 1.0));
    EXPECT_LE(at - Quad(q.body.radius), Quad(allowed));
    const auto exact = certified::sweep(q.body, q.motion, t, 0.0, 1.0, 0.0);
    if (exact.hit) {
      EXPECT_LE(s.time, exact.time);
      sooner += s.time < exact.time ? 1 : 0;
    }
  });
  EXPECT_GT(sooner, 10);
}

TEST(CertifiedSweep, OfASphereKeepsTheSamePromisesFromAnyFreeTimeToAnyEnd) {
  std::mt19937_64 random(12);
  std::uniform_real_distribution<double> share(0.0, 1.0);
  int hits = 0, late_begins = 0, early_ends = 0;
  for_each_query([&](Query q) {
    q.body.half_height = 0.0;
    // A sphere as it comes, then a thin one that runs onto the face, or about onto an edge or a corner.
    for (const bool aimed : {false, true}) {
      const double tolerance = share(random) < 0.5 ? 1e-6 : 0.0;
      if (aimed) {
        const double u = std::min(share(random), 1.2 * share(random)),
                     v = share(random) < 0.3 ? 0.0 : (1.0 - u) * share(random);
        const Vec3 at = q.triangle[0] + u * (q.triangle[1] - q.triangle[0]) + v * (q.triangle[2] - q.triangle[0]);
        q.body.radius = 1e-7;
        q.motion = (1.0 + share(random)) * (at - q.from);
      }
      const auto t = blurred_local(q);
      const auto judged = [&](double begin, double end) {
        const double time = certified::sphere_impact_time(q.body, q.motion, t, begin, end, tolerance);
        EXPECT_GE(time, begin);
        EXPECT_LE(time, end);
        if (time > begin) {
          EXPECT_GE(oracle::least_distance<Quad>(q.body, q.from, q.motion, time, q.triangle), Quad(q.body.radius));
        }
        if (time < end) {
          ++hits;
          const Quad at = oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, time, q.triangle);
          EXPECT_LE(at - Quad(q.body.radius),
                    Quad(std::max(tolerance, certified::hit_resolution(q.body, q.motion, t, 1.0))));
        }
        return time;
      };
      const double whole = judged(0.0, 1.0);
      if (whole == 0.0) continue;
      const double begin = whole * (share(random) < 0.2 ? 1.0 : share(random));
      const double end = begin + (1.0 - begin) * share(random);
      const double part = judged(begin, end);
      late_begins += part < end ? 1 : 0;
      early_ends += whole < 1.0 && end < whole ? 1 : 0;
    }
  });
  EXPECT_GT(hits, queries / 5);
  EXPECT_GT(late_begins, queries / 20);
  EXPECT_GT(early_ends, queries / 20);
}

TEST(CertifiedSweep, CanBeginAtAnyTimeThatIsKnownToBeFree) {
  int begun = 0;
  for_each_query([&](const Query& q) {
    const auto t = blurred_local(q);
    const auto whole = certified::sweep(q.body, q.motion, t, 0.0, 1.0, 0.0);
    if (whole.hit && whole.time == 0.0) return;
    for (const double share : {0.25, 0.9, 1.0}) {
      const double begin = share * whole.time;
      const auto rest = certified::sweep(q.body, q.motion, t, begin, 1.0, 0.0);
      EXPECT_GE(rest.time, begin);
      EXPECT_GE(rest.distance, 0.0);
      const Quad least = oracle::least_distance<Quad>(q.body, q.from, q.motion, rest.time, q.triangle);
      EXPECT_GE(least, Quad(q.body.radius));
      ++begun;
    }
    // And need not be followed to its end.
    const double end = 0.5 * whole.time;
    const auto first = certified::sweep(q.body, q.motion, t, 0.0, end, 0.0);
    const double resolution = certified::hit_resolution(q.body, q.motion, t, 1.0);
    if (first.hit) {
      const Quad at = oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, first.time, q.triangle);
      EXPECT_LE(at - Quad(q.body.radius), Quad(resolution));
    } else {
      EXPECT_EQ(first.time, end);
    }
  });
  EXPECT_GT(begun, queries);
}

TEST(CertifiedSweep, ApproachFindsWhereTheGapIsLeast) {
  int inside = 0;
  for_each_query([&](const Query& q) {
    const auto t = blurred_local(q);
    const auto a = certified::approach(q.body, q.motion, t, 0.0, 1.0);
    ASSERT_GE(a.time, 0.0);
    ASSERT_LE(a.time, 1.0);
    inside += a.time > 0.0 && a.time < 1.0 ? 1 : 0;
    const Quad least = oracle::least_distance<Quad>(q.body, q.from, q.motion, 1.0, q.triangle) - Quad(q.body.radius);
    EXPECT_LE(Quad(a.proximity.distance), least);
    const double resolution = certified::hit_resolution(q.body, q.motion, t, 1.0);
    const double tolerance =
        1e-9 * q.body.radius + 2.0 * certified::approach_tolerance * std::abs(double(least)) + resolution;
    const Quad there =
        oracle::distance_on_the_way<Quad>(q.body, q.from, q.motion, a.time, q.triangle) - Quad(q.body.radius);
    EXPECT_LE(there, least + Quad(tolerance));
    // Where they meet, the distance goes on below minus the radius: depth has no such simple judge.
    if (least > Quad(resolution) - Quad(q.body.radius)) {
      EXPECT_GE(Quad(a.proximity.distance), least - Quad(tolerance));
    }
  });
  EXPECT_GT(inside, queries / 5);
}

TEST(CertifiedSweep, ApproachOfABodyAtRestIsItsProximity) {
  for_each_query([&](Query q) {
    q.motion = Vec3(0);
    const auto t = blurred_local(q);
    const auto a = certified::approach(q.body, q.motion, t, 0.0, 1.0);
    const auto p = certified::proximity(q.body, t);
    EXPECT_NEAR(a.proximity.distance, p.distance, certified::hit_resolution(q.body, q.motion, t, 1.0));
    EXPECT_EQ(a.proximity.normal, p.normal);
  });
}

TEST(SupportPlane, BoundsTheDistanceFromBelowAndTightly) {
  for_each_query([&](const Query& q) {
    const auto t = blurred_local(q);
    certified::Obstacle obstacle(t.corner, q.body.half_height);
    const double doubt = certified::error_bound(q.body, Vec3(0), t).at_start;
    const auto plane = certified::support_plane(obstacle, Vec3(0), doubt);
    const Quad distance = oracle::distance<Quad>(q.body, q.from, q.triangle);
    EXPECT_LE(Quad(plane.value(Vec3(0)) - doubt), distance);
    // As Minkowski's facets tell how deep two bodies are in each other, only disjoint ones are judged from above.
    if (distance > Quad(doubt)) {
      EXPECT_GE(Quad(plane.value(Vec3(0)) + 2.0 * doubt), distance);
    }
  });
}

}  // namespace
