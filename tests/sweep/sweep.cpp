// What a sweep against one triangle answers, case by case.

#include "roam/sweep.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <random>
#include <string>

#include "oracle.h"
#include "roam/error.h"

namespace {

using roam::Body;
using roam::Feature;
using roam::Triangle;
using roam::Vec3;

/// Metres, for scenes of a few metres: above the resolution of a hit, far below anything that is meant.
constexpr double close = 1e-12;

/// Legs of 4 m along x and y, corner at the origin.
const Triangle floor_triangle{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
const Body ball{.radius = 0.5};
const Body person = Body::capsule(0.3, 1.8);

/// No way out is shorter than `depth`: every direction tried leaves the body inside.
void expect_no_shorter_way_out(const Body& body, const Vec3& place, const Triangle& triangle, double depth) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 way = glm::normalize(Vec3(in(random), in(random), in(random)));
    EXPECT_LT(oracle::distance(body, place + way * (depth * 0.999), triangle), body.radius);
  }
}

TEST(Sweep, MeetsAFaceFromEitherSide) {
  for (const double side : {1.0, -1.0}) {
    const auto s = roam::sweep(ball, {1, 1, 2.0 * side}, {0, 0, -4.0 * side}, floor_triangle);
    ASSERT_TRUE(s.hit);
    EXPECT_LE(s.time, 0.375);
    EXPECT_NEAR(s.time, 0.375, close);
    EXPECT_EQ(s.feature, Feature::face);
    EXPECT_NEAR(glm::distance(s.point, Vec3(1, 1, 0)), 0.0, close);
    EXPECT_NEAR(s.normal.z, side, close);
    EXPECT_GE(s.distance, 0.0);
    EXPECT_LT(s.distance, close);
  }
}

TEST(Sweep, MeetsASlopeWithTheEndOfAnAxisOfAnyHeight) {
  const Triangle slope{Vec3(-4, -4, -4), Vec3(4, -4, 4), Vec3(0, 8, 0)};
  const double touching = 0.3 * std::sqrt(2.0);  // m, height of the lower end over the slope
  for (const double half : {0.0, 0.5, 1.0, 2.0}) {
    const auto s = roam::sweep({.radius = 0.3, .half_height = half}, {0, 0, half + 1.4}, {0, 0, -2}, slope);
    ASSERT_TRUE(s.hit);
    EXPECT_NEAR(s.time, 0.5 * (1.4 - touching), 1e-9) << half;
    EXPECT_NEAR(glm::distance(s.point, Vec3(0.5 * touching, 0, 0.5 * touching)), 0.0, 1e-9) << half;
  }
}

TEST(Sweep, EndsAtATimeAndIsTheSameBefore) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> in(-3.0, 5.0), fraction(0.0, 1.0);
  int hits = 0, cut = 0;
  for (int i = 0; i < 2000; ++i) {
    const Body& body = i % 2 == 0 ? ball : person;
    const Vec3 from(in(random), in(random), in(random)), motion(in(random), in(random), in(random));
    const roam::SweepResult whole = roam::sweep(body, from, motion, floor_triangle);
    const double until = fraction(random);
    for (const double end : {1.0, until}) {
      const roam::SweepResult s = roam::sweep(body, from, motion, floor_triangle, end);
      // A hit right at the end may be seen by one of both alone.
      if (whole.hit && std::abs(whole.time - end) < 1e-9) continue;
      ASSERT_EQ(s.hit, whole.hit && whole.time < end) << i;
      EXPECT_NEAR(s.time, s.hit ? whole.time : end, 1e-12);
      EXPECT_TRUE(s.hit || s.distance == 0.0);
      hits += s.hit ? 1 : 0;
      cut += whole.hit && !s.hit ? 1 : 0;
    }
  }
  EXPECT_GT(hits, 200);
  EXPECT_GT(cut, 50);
  for (const double wrong : {-0.1, 1.1, std::numeric_limits<double>::quiet_NaN()}) {
    EXPECT_THROW(static_cast<void>(roam::sweep(ball, {1, 1, 2}, {0, 0, -4}, floor_triangle, wrong)), roam::Error);
  }
}

TEST(Sweep, DoesNotDependOnTheWinding) {
  const Triangle turned{floor_triangle[0], floor_triangle[2], floor_triangle[1]};
  const auto s = roam::sweep(ball, {1, 1, 2}, {0.5, 0, -4}, floor_triangle);
  const auto t = roam::sweep(ball, {1, 1, 2}, {0.5, 0, -4}, turned);
  EXPECT_NEAR(s.time, t.time, close);
}

TEST(Sweep, MeetsAnEdge) {
  // The centre passes 0.3 m above the edge y = 0: at 0.4 m before it the distance is 0.5 m.
  const auto s = roam::sweep(ball, {2, -2, 0.3}, {0, 4, 0}, floor_triangle);
  ASSERT_TRUE(s.hit);
  EXPECT_EQ(s.feature, Feature::edge);
  EXPECT_LE(s.time, 0.4);
  EXPECT_NEAR(s.time, 0.4, close);
  EXPECT_NEAR(glm::distance(s.point, Vec3(2, 0, 0)), 0.0, close);
  EXPECT_NEAR(glm::distance(s.normal, Vec3(0, -0.8, 0.6)), 0.0, close);
}

TEST(Sweep, MeetsAVertex) {
  const auto s = roam::sweep(ball, {-2, -0.3, 0}, {4, 0, 0}, {Vec3(0, 0, 0), Vec3(4, 4, 0), Vec3(4, 5, 0)});
  ASSERT_TRUE(s.hit);
  EXPECT_EQ(s.feature, Feature::vertex);
  EXPECT_NEAR(s.time, 0.4, close);
  EXPECT_NEAR(glm::distance(s.normal, Vec3(-0.8, -0.6, 0)), 0.0, close);
}

TEST(Sweep, MissTellsTheLeastGapOfTheWholeMotion) {
  const auto s = roam::sweep(ball, {1, 1, 5}, {0.5, 0.5, -4}, floor_triangle);
  ASSERT_FALSE(s.hit);
  EXPECT_EQ(s.time, 1.0);
  EXPECT_LE(s.distance, 0.5);
  EXPECT_NEAR(s.distance, 0.5, close);
  const auto passing = roam::sweep(ball, {-10, -2, 0}, {30, 0, 0}, floor_triangle);
  ASSERT_FALSE(passing.hit);
  EXPECT_LE(passing.distance, 1.5);
  EXPECT_NEAR(passing.distance, 1.5, 1e-9);
}

TEST(Sweep, LeavingIsFreeAndTellsTheGapAtTheStart) {
  const auto s = roam::sweep(ball, {1, 1, 0.6}, {0, 0, 1e5}, floor_triangle);
  EXPECT_FALSE(s.hit);
  EXPECT_NEAR(s.distance, 0.1, 1e-9);
}

TEST(Sweep, StartInTouchIsAHitAtZeroWhereverItGoes) {
  for (const Vec3& motion : {Vec3(0, 0, -1), Vec3(0, 0, 1), Vec3(1, 0, 0), Vec3(0)}) {
    const auto s = roam::sweep(ball, {1, 1, 0.5}, motion, floor_triangle);
    ASSERT_TRUE(s.hit);
    EXPECT_EQ(s.time, 0.0);
    EXPECT_LT(s.distance, 0.0);
    EXPECT_GT(s.distance, -close);
  }
}

TEST(Sweep, EmbeddedSphereIsToldDepthAndWayOut) {
  const auto s = roam::sweep(ball, {1, 1, 0.2}, {1, 0, 0}, floor_triangle);
  ASSERT_TRUE(s.hit);
  EXPECT_EQ(s.time, 0.0);
  EXPECT_NEAR(s.distance, -0.3, close);
  EXPECT_NEAR(s.normal.z, 1.0, close);
  expect_no_shorter_way_out(ball, {1, 1, 0.2}, floor_triangle, -s.distance);
}

TEST(Sweep, SphereCentredOnTheFaceLeavesAlongItsNormal) {
  const auto s = roam::sweep(ball, {1, 1, 0}, {1, 0, 0}, floor_triangle);
  ASSERT_TRUE(s.hit);
  EXPECT_NEAR(s.distance, -0.5, close);
  EXPECT_NEAR(std::abs(s.normal.z), 1.0, close);
  EXPECT_EQ(s.feature, Feature::face);
}

TEST(Sweep, CapsulePiercedByAFloorLeavesByTheNearerEnd) {
  // The axis reaches from 0.4 m below the floor to 0.8 m above it.
  const auto s = roam::sweep(person, {1, 1, 0.2}, {0, 0, 0}, floor_triangle);
  ASSERT_TRUE(s.hit);
  EXPECT_NEAR(s.distance, -0.7, close);
  EXPECT_NEAR(s.normal.z, 1.0, close);
  EXPECT_EQ(s.feature, Feature::face);
  EXPECT_NEAR(glm::distance(s.point, Vec3(1, 1, 0)), 0.0, close);
  expect_no_shorter_way_out(person, {1, 1, 0.2}, floor_triangle, -s.distance);
}

TEST(Sweep, CapsulePiercedNearAnEdgeLeavesSideways) {
  const auto s = roam::sweep(person, {2, 0.1, 0}, {0, 0, 0}, floor_triangle);
  ASSERT_TRUE(s.hit);
  EXPECT_NEAR(s.distance, -0.4, close);
  EXPECT_NEAR(s.normal.y, -1.0, close);
  EXPECT_EQ(s.feature, Feature::edge);
  expect_no_shorter_way_out(person, {2, 0.1, 0}, floor_triangle, -s.distance);
}

TEST(Sweep, WayOutFreesBodiesEmbeddedAnyhow) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const auto point = [&] { return Vec3(in(random), in(random), in(random)); };
  int embedded = 0;
  for (int i = 0; i < 20000; ++i) {
    const Triangle t{point(), point(), point()};
    const Vec3 place = 0.5 * point();
    const Body body{0.3, i % 2 == 0 ? 0.0 : 0.6};
    const auto s = roam::sweep(body, place, {0.1, 0, 0}, t);
    if (!s.hit || s.distance >= 0.0) continue;
    ++embedded;
    EXPECT_GE(oracle::distance(body, place + s.normal * (1e-14 - s.distance), t), body.radius);
    EXPECT_LT(oracle::distance(body, place + s.normal * (-0.999 * s.distance), t), body.radius);
  }
  EXPECT_GT(embedded, 5000);
}

TEST(Sweep, ZeroMotionAnswersTheGapAtThePlace) {
  const auto s = roam::sweep(ball, {1, 1, 2}, Vec3(0), floor_triangle);
  EXPECT_FALSE(s.hit);
  EXPECT_EQ(s.time, 1.0);
  EXPECT_NEAR(s.distance, 1.5, close);
}

TEST(Sweep, TrianglesThatArePointsOrSegmentsStopABody) {
  const Vec3 p(1, 2, 3), q(1, 5, 3);
  const auto at_point = roam::sweep(ball, p + Vec3(2, 0, 0), {-4, 0, 0}, {p, p, p});
  ASSERT_TRUE(at_point.hit);
  EXPECT_EQ(at_point.feature, Feature::vertex);
  EXPECT_NEAR(at_point.time, 0.375, close);
  const Vec3 beside(3, 3, 3);
  for (const Triangle& segment : {Triangle{p, q, q}, {p, p, q}, {q, p, q}, {p, q, 0.5 * (p + q)}}) {
    const auto s = roam::sweep(ball, beside, {-4, 0, 0}, segment);
    ASSERT_TRUE(s.hit);
    EXPECT_EQ(s.feature, Feature::edge);
    EXPECT_NEAR(s.time, 0.375, close);
    EXPECT_NEAR(s.normal.x, 1.0, close);
  }
}

TEST(Sweep, BodiesCentredOnDegenerateTrianglesHaveAWayOut) {
  const Vec3 p(1, 2, 3);
  for (const Body& body : {ball, person}) {
    for (const Vec3& end : {p, p + Vec3(0, 0, 1), p + Vec3(1, 0, 0), p + Vec3(1, 1, 1)}) {
      const Triangle t{p, p, end};
      const auto s = roam::sweep(body, p, {1, 0, 0}, t);
      ASSERT_TRUE(s.hit);
      EXPECT_NEAR(s.distance, -body.radius, close);
      EXPECT_NEAR(oracle::distance(body, p - s.normal * s.distance, t), body.radius, close);
    }
  }
}

TEST(Sweep, MotionsFromANanometreToAHundredKilometresAreAnswered) {
  const auto tiny = roam::sweep(ball, {1, 1, 0.5 + 5e-10}, {0, 0, -1e-9}, floor_triangle);
  ASSERT_TRUE(tiny.hit);
  EXPECT_NEAR(tiny.time, 0.5, 1e-4);
  const auto huge = roam::sweep(ball, {1, 1, 5e4 + 0.5}, {0, 0, -1e5}, floor_triangle);
  ASSERT_TRUE(huge.hit);
  EXPECT_LE(huge.time, 0.5);
  EXPECT_NEAR(huge.time, 0.5, 1e-13);
}

TEST(Sweep, AnyMixOfLengthsUpToTheLimitIsAnsweredSafely) {
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const auto length = [&](double least, double most) {
    return in(random) < -0.8 ? 0.0 : std::pow(10.0, least + (most - least) * (0.5 + 0.5 * in(random)));
  };
  int hits = 0, misses = 0;
  for (int i = 0; i < 20000; ++i) {
    // A scale for the scene, from far below a metre to the limit, and lengths far below that scale.
    const double most = i % 2 == 0 ? 11.9 : -300.0 + 311.0 * (0.5 + 0.5 * in(random)), least = most - 20.0;
    const auto point = [&] {
      return Vec3(std::copysign(length(least, most), in(random)), std::copysign(length(least, most), in(random)),
                  std::copysign(length(least, most), in(random)));
    };
    const Body body{length(least, most), i % 3 == 0 ? 0.0 : length(least, most)};
    const Triangle t{point(), point(), point()};
    const Vec3 from = point(), motion = point();
    const auto s = roam::sweep(body, from, motion, t);
    (s.hit ? hits : misses) += 1;
    ASSERT_TRUE(s.time >= 0.0 && s.time <= 1.0);
    ASSERT_TRUE(std::isfinite(s.distance));
    using oracle::Quad;
    if (s.distance >= 0.0) {
      EXPECT_GE(oracle::least_distance<Quad>(body, from, motion, s.time, t), Quad(body.radius));
    }
    if (!s.hit) continue;
    ASSERT_NEAR(glm::dot(s.normal, s.normal), 1.0, 1e-15);
    const double reach = body.radius + body.half_height + 3.0 * std::pow(10.0, most) * 4.0;
    const Quad gap = oracle::distance_on_the_way<Quad>(body, from, motion, s.time, t) - Quad(body.radius);
    // Faces of less than 1e-130 m^2 have no normal.
    EXPECT_LE(gap, Quad(1.6e-14 * reach + 1e-64));
  }
  EXPECT_GT(hits, 2000);
  EXPECT_GT(misses, 2000);
}

TEST(Sweep, RayMeetsWhatItPointsAt) {
  const Body point{.radius = 0.0};
  const auto s = roam::sweep(point, {1, 1, 2}, {0, 0, -4}, floor_triangle);
  ASSERT_TRUE(s.hit);
  EXPECT_NEAR(s.time, 0.5, close);
  EXPECT_FALSE(roam::sweep(point, {3, 3, 2}, {0, 0, -4}, floor_triangle).hit);
}

TEST(Sweep, RayDoesNotSlipBetweenTrianglesThatShareAnEdge) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> in(-1.0, 1.0);
  const auto point = [&] { return Vec3(in(random), in(random), in(random)); };
  const Body ray{.radius = 0.0};
  for (int i = 0; i < 20000; ++i) {
    const Vec3 a = point(), b = point(), on_edge = a + (b - a) * (0.5 + 0.5 * in(random));
    const Triangle left{a, b, point()}, right{a, b, a + b - left[2]};
    const Vec3 from = 3.0 * point(), motion = 2.0 * (on_edge - from);
    EXPECT_TRUE(roam::sweep(ray, from, motion, left).hit || roam::sweep(ray, from, motion, right).hit);
  }
}

TEST(Sweep, CapsuleMeetsFloorCeilingWallAndTableEdge) {
  const Triangle ceiling{Vec3(-9, -9, 3), Vec3(9, -9, 3), Vec3(0, 9, 3)};
  const auto head = roam::sweep(person, {0, 0, 1}, {0, 0, 2}, ceiling);
  ASSERT_TRUE(head.hit);
  EXPECT_NEAR(head.time, 0.55, close);
  EXPECT_NEAR(head.normal.z, -1.0, close);
  const auto feet = roam::sweep(person, {1, 1, 2}, {0, 0, -2}, floor_triangle);
  ASSERT_TRUE(feet.hit);
  EXPECT_NEAR(feet.time, 0.55, close);
  EXPECT_NEAR(feet.normal.z, 1.0, close);
  const Triangle wall{Vec3(2, -9, -9), Vec3(2, 9, -9), Vec3(2, 0, 9)};
  const auto side = roam::sweep(person, {0, 0, 0}, {2, 0, 0}, wall);
  ASSERT_TRUE(side.hit);
  EXPECT_NEAR(side.time, 0.85, close);
  EXPECT_NEAR(side.normal.x, -1.0, close);
  const Triangle table{Vec3(1, -9, 0.2), Vec3(1, 9, 0.2), Vec3(9, 0, 0.2)};
  const auto waist = roam::sweep(person, {0, 0, 0}, {2, 0, 0}, table);
  ASSERT_TRUE(waist.hit);
  EXPECT_NEAR(waist.time, 0.35, close);
  EXPECT_NEAR(waist.normal.x, -1.0, close);
  EXPECT_EQ(waist.feature, Feature::edge);
}

TEST(Sweep, HasAUnitNormalWhereTheCentreIsInTheMiddleOfAWire) {
  int differ = 0;
  for (int i = 0; i < 300; ++i) {
    // Lengths that are no multiples of each other: half of the sum is then often exactly on the wire.
    const double x = 100.0 * std::sin(1.7 * i), y = 100.0 * std::cos(2.3 * i);
    roam::Triangle wire{roam::Vec3(x, y, x + y), roam::Vec3(x, y, x + y), roam::Vec3(x, y, x + y)};
    for (int k = 0; k < 3; ++k) wire[static_cast<std::size_t>(k)][i % 3] += 50.0 * std::sin(3.1 * i + k);
    const roam::Vec3 middle = 0.5 * wire[0] + 0.5 * wire[2];
    const auto p = roam::proximity({0.3, 0.0}, middle, wire);
    EXPECT_NEAR(glm::length(p.normal), 1.0, 1e-9) << i;
    EXPECT_NEAR(p.normal[i % 3], 0.0, 1e-9) << i;
    differ += p.distance < -0.2999 ? 1 : 0;
  }
  EXPECT_GT(differ, 100);
}

TEST(Sweep, ProximityTellsPointNormalFeatureAndGap) {
  const auto face = roam::proximity(ball, {1, 1, 2}, floor_triangle);
  EXPECT_EQ(face.feature, Feature::face);
  EXPECT_LE(face.distance, 1.5);
  EXPECT_NEAR(face.distance, 1.5, close);
  const auto edge = roam::proximity(ball, {2, -3, 4}, floor_triangle);
  EXPECT_EQ(edge.feature, Feature::edge);
  EXPECT_NEAR(edge.distance, 4.5, close);
  EXPECT_NEAR(glm::distance(edge.normal, Vec3(0, -0.6, 0.8)), 0.0, close);
  const auto vertex = roam::proximity(person, {-3, -4, 0}, floor_triangle);
  EXPECT_EQ(vertex.feature, Feature::vertex);
  EXPECT_NEAR(vertex.distance, 4.7, close);
  const auto inside = roam::proximity(ball, {1, 1, -0.1}, floor_triangle);
  EXPECT_NEAR(inside.distance, -0.4, close);
  EXPECT_NEAR(inside.normal.z, -1.0, close);
}

TEST(Sweep, FeaturesHaveNames) {
  EXPECT_STREQ(roam::to_string(Feature::face), "face");
  EXPECT_STREQ(roam::to_string(Feature::edge), "edge");
  EXPECT_STREQ(roam::to_string(Feature::vertex), "vertex");
}

std::string refusal(const Body& body, const Vec3& from, const Vec3& motion, const Triangle& triangle) {
  try {
    static_cast<void>(roam::sweep(body, from, motion, triangle));
  } catch (const roam::Error& error) {
    return error.what();
  }
  return "";
}

TEST(Sweep, RefusesWhatIsNotANumberAndSaysWhich) {
  const Vec3 o(0);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300}) {
    for (int k = 0; k < 3; ++k) {
      Vec3 v(0);
      v[k] = bad;
      EXPECT_NE(refusal(ball, v, o, floor_triangle).find("position"), std::string::npos);
      EXPECT_NE(refusal(ball, o, v, floor_triangle).find("motion"), std::string::npos);
      EXPECT_NE(refusal(ball, o, o, {o, v, o}).find("corners"), std::string::npos);
    }
    EXPECT_NE(refusal({bad, 0.0}, o, o, floor_triangle).find("radius"), std::string::npos);
    EXPECT_NE(refusal({0.3, bad}, o, o, floor_triangle).find("half height"), std::string::npos);
  }
  EXPECT_NE(refusal({-0.1, 0.0}, o, o, floor_triangle).find("-0.1"), std::string::npos);
  EXPECT_NE(refusal(Body::capsule(0.5, 0.8), o, o, floor_triangle).find("half height"), std::string::npos);
  EXPECT_THROW(static_cast<void>(roam::proximity({-1.0, 0.0}, o, floor_triangle)), roam::Error);
}

}  // namespace
