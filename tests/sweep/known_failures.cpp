// Cases that well-known engines answer wrongly. Each was reported or measured there; here each is a promise.

#include <gtest/gtest.h>

#include <cmath>

#include "oracle.h"
#include "roam/sweep.h"

namespace {

using oracle::Quad;
using roam::Body;
using roam::Feature;
using roam::Triangle;
using roam::Vec3;

constexpr double nearly = 1e-12;  // metres

TEST(KnownFailures, TenMetreSheetMetEdgeOn) {
  const Triangle sheet[] = {{Vec3(0, 0, 0), Vec3(10, 0, 0), Vec3(10, 0, 10)},
                            {Vec3(0, 0, 0), Vec3(10, 0, 10), Vec3(0, 0, 10)}};
  // Exactly in the sheet's plane, and a hair to either side of it.
  for (const double aside : {0.0, 1e-16, -1e-16, 1e-9, -1e-9, 1e-3}) {
    double first = 2.0;
    Feature feature = Feature::face;
    for (const Triangle& t : sheet) {
      const auto s = roam::sweep({.radius = 0.3}, {-5, aside, 5}, {10, 0, 0}, t);
      if (s.hit && s.time < first) {
        first = s.time;
        feature = s.feature;
      }
    }
    EXPECT_EQ(feature, Feature::edge);
    EXPECT_NEAR(first, (5.0 - std::sqrt(0.09 - aside * aside)) / 10.0, nearly);
  }
}

TEST(KnownFailures, LegsOfThreeMillimetresAtNormalIncidence) {
  const Triangle t{Vec3(0, 0, 0), Vec3(0.003, 0, 0), Vec3(0, 0.003, 0)};
  for (const double side : {1.0, -1.0}) {
    const auto s = roam::sweep({.radius = 0.3}, {0.001, 0.001, side}, {0, 0, -2.0 * side}, t);
    ASSERT_TRUE(s.hit);
    EXPECT_EQ(s.feature, Feature::face);
    EXPECT_NEAR(s.time, 0.35, nearly);
  }
}

/// Its foot on the plane of the inexact normal lies 1.3e-11 m beside the triangle.
TEST(Slivers, HaveThePointOfContactOnThem) {
  const Triangle t{Vec3(0.34000019828978795, -0.48367949927736104, -0.8065072889575805),
                   Vec3(0.70029432128079883, -1.7887855436641438, -1.3010596235966878),
                   Vec3(0.33792595400527736, -0.47616731729135631, -0.8036609356763551)};
  const Vec3 from(0.70029432128079883, -0.63634439048917568, -1.3010596235966878);
  const auto s = roam::sweep({.radius = 1.1346774736860183}, from, {0.76, -1.86, -0.15}, t);
  ASSERT_TRUE(s.hit);
  EXPECT_LT(oracle::distance<Quad>({}, s.point, t), Quad(1e-15));
}

/// A point meets a triangle of 8.7 km inside, 0.16 nm from an edge. The corners' shares tell no such place from the
/// edge.
TEST(KnownFailures, PointOnALargeTriangleBesideItsEdge) {
  const Triangle t{Vec3(-13738.683310483086, 253.83073069755605, 182.45781465465225),
                   Vec3(-14159.301009879238, -7400.647011975786, 928.02879469208892),
                   Vec3(-13738.683310483086, 1268.6137321773726, 182.45781465465225)};
  const Vec3 from(-13923.274420445978, -2539.6562120984927, 509.70103368111882);
  const Vec3 motion(-2.0527466663839684, 1.5883262066232577, 3.1167098865360443);
  const Body body{.radius = 0.0};
  const auto s = roam::sweep(body, from, motion, t);
  ASSERT_TRUE(s.hit);
  EXPECT_EQ(s.feature, Feature::face);
  EXPECT_LT(oracle::distance_on_the_way<Quad>(body, from, motion, s.time, {s.point, s.point, s.point}), Quad(2e-11));
}

TEST(KnownFailures, SliverOfFiveMicrometres) {
  const Triangle t{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0.5, 5e-6, 0)};
  for (const Vec3& way : {Vec3(0, 0, 1), Vec3(0, 1, 0), Vec3(0, 1, 1), Vec3(1, 1, 1e-6)}) {
    const Vec3 target(0.5, 2e-6, 0), from = target - 2.0 * way;
    const auto s = roam::sweep({.radius = 0.3}, from, 4.0 * way, t);
    ASSERT_TRUE(s.hit);
    const Body body{.radius = 0.3};
    EXPECT_GE(oracle::least_distance<Quad>(body, from, 4.0 * way, s.time, t), Quad(0.3));
    EXPECT_LT(oracle::distance_on_the_way<Quad>(body, from, 4.0 * way, s.time, t), Quad(0.3 + nearly));
  }
}

TEST(KnownFailures, FreeEdgeOfFourCentimetresAtWalkingPace) {
  // Radius 5 cm, 1.4 m/s, 60 Hz: a step is 23 mm, so that the edge lies deep inside the sphere one step later.
  const Triangle t{Vec3(0, -0.02, 0), Vec3(0, 0.02, 0), Vec3(3, 0, 0)};
  const Body body{.radius = 0.05};
  const Vec3 step(1.4 / 60.0, 0, 0);
  for (const double height : {0.0, 0.02, 0.04, 0.0499}) {
    Vec3 at(-1, 0, height);
    roam::SweepResult s;
    for (int i = 0; i < 60 && !s.hit; ++i) {
      s = roam::sweep(body, at, step, t);
      EXPECT_GE(oracle::least_distance<Quad>(body, at, step, s.time, t), Quad(0.05));
      at += s.time * step;
    }
    ASSERT_TRUE(s.hit);
    EXPECT_NEAR(at.x, -std::sqrt(0.0025 - height * height), 1e-9);
  }
}

TEST(KnownFailures, GrazedEdgeDoesNotHideTheWallBehindIt) {
  const Body body{.radius = 0.3};
  const Triangle wall{Vec3(5, -9, -9), Vec3(5, 9, -9), Vec3(5, 0, 9)};
  const Vec3 from(-2, 0, 0), motion(10, 0, 0);
  const auto at_wall = roam::sweep(body, from, motion, wall);
  ASSERT_TRUE(at_wall.hit);
  EXPECT_NEAR(at_wall.time, 0.67, nearly);
  // The edge z = -0.3 lies beside the way; whichever way its rounding falls, the wall is met at the same time.
  for (const double more : {1e-15, 1e-13, 1e-9, 1e-6}) {
    const Triangle free_edge{Vec3(1, -1, -0.3 - more), Vec3(1, 1, -0.3 - more), Vec3(1, 0, -3)};
    const auto graze = roam::sweep(body, from, motion, free_edge);
    if (more >= 1e-13) {
      EXPECT_FALSE(graze.hit);
      EXPECT_LE(graze.distance, more + 1e-16);
    }
    const Triangle met_edge{Vec3(1, -1, -0.3 + more), Vec3(1, 1, -0.3 + more), Vec3(1, 0, -3)};
    const auto met = roam::sweep(body, from, motion, met_edge);
    ASSERT_TRUE(met.hit);
    EXPECT_EQ(met.feature, Feature::edge);
    EXPECT_LT(met.time, 0.3);
  }
}

TEST(KnownFailures, PassageOf688MillimetresAdmitsABodyOf640) {
  const Body body = Body::capsule(0.32, 1.8);
  const Triangle left[] = {{Vec3(0, 0.344, 0), Vec3(3, 0.344, 0), Vec3(3, 0.344, 3)},
                           {Vec3(0, 0.344, 0), Vec3(3, 0.344, 3), Vec3(0, 0.344, 3)}};
  for (const Triangle& t : left) {
    Triangle mirrored = t;
    for (Vec3& corner : mirrored) corner.y = -corner.y;
    for (const Triangle& side : {t, mirrored}) {
      const auto s = roam::sweep(body, {-1, 0, 1}, {5, 0, 0}, side);
      EXPECT_FALSE(s.hit);
      EXPECT_NEAR(s.distance, 0.024, nearly);
      // Even a body that fills the passage but for a picometre.
      EXPECT_FALSE(roam::sweep(Body::capsule(0.344 - nearly, 1.8), {-1, 0, 1}, {5, 0, 0}, side).hit);
      EXPECT_TRUE(roam::sweep(Body::capsule(0.344 + nearly, 1.8), {-1, 0, 1}, {5, 0, 0}, side).hit);
    }
  }
}

}  // namespace
