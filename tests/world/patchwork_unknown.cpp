// The unknown box: its certified answers against the distances of its sides, by brute force in long double.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <utility>
#include <vector>

#include "clutter.h"
#include "oracle.h"
#include "roam/patchwork.h"
#include "walker_scenes.h"

namespace {

using roam::Body;
using roam::Box;
using roam::Patchwork;
using roam::Vec3;

constexpr double margin = Patchwork::margin;

/// The box as triangles and as a solid.
struct Solid {
  Box box;
  roam::Mesh sides;

  explicit Solid(const Box& of) : box(of) { scenes::add_box(sides, of.lower, of.upper); }

  [[nodiscard]] bool has_inside(const Body& body, const Vec3& place) const {
    const auto within = [&](int k, double more) {
      return place[k] + more >= box.lower[k] && place[k] - more <= box.upper[k];
    };
    return within(0, 0.0) && within(1, 0.0) && within(2, body.half_height);
  }
  /// Of the axis from the solid over [0, until] of the motion; 0 when they meet.
  [[nodiscard]] double distance(const Body& body, const Vec3& from, const Vec3& motion, double until) const {
    if (has_inside(body, from)) return 0.0;
    long double least = 1e30L;
    for (std::size_t t = 0; t < sides.triangles.size(); ++t) {
      least = std::min(least, oracle::least_distance(body, from, motion, until, sides.triangle(t)));
    }
    return static_cast<double>(least);
  }
};

struct Case {
  Body body;
  Vec3 from, motion;
};

/// Boxes like needles, boards, points and blocks, met in every direction.
void ask(clutter::Random& random, const Vec3& centre, double size, int queries, std::array<int, 4>& tally) {
  Vec3 half = random.in_box(0.5);
  for (int k = 0; k < 3; ++k) {
    half[k] = random.engine() % 6 == 0 ? 0.0 : size * std::abs(half[k]) * std::pow(10.0, random.between(-3.0, 0.0));
  }
  const Vec3 middle = centre + size * random.in_box(0.1);
  const Solid solid({middle - half, middle + half});
  Patchwork space;
  (void)space.expect(solid.box);
  space.update();
  const double rounding = 1e-15 * (std::abs(centre.x) + std::abs(centre.y) + size) + 1e-9;
  for (int q = 0; q < queries; ++q) {
    const Body body{q % 5 == 0 ? 0.0 : random.between(0.0, 0.4), q % 2 == 0 ? 0.0 : 0.7};
    Vec3 from = middle + (half + Vec3(body.radius + 0.3)) * random.in_box(2.0);
    Vec3 motion = random.between(0.01, 3.0) * size * random.direction();
    if (q % 3 == 0) motion[static_cast<int>(random.engine() % 3)] = 0.0;
    if (q % 8 == 1) {  // along a side, nearly in touch
      const int k = static_cast<int>(random.engine() % 3);
      from[k] = solid.box.upper[k] + body.radius + (k == 2 ? body.half_height : 0.0) + random.between(-1e-3, 6e-3);
      motion[k] = random.between(-1e-3, 1e-3);
    }
    const auto s = space.sweep(body, from, motion);
    const double kept = body.radius + margin;
    const double on_the_way = solid.distance(body, from, motion, s.time);
    ASSERT_GE(s.time, 0.0);
    if (!s.hit) {
      ++tally[0];
      ASSERT_GE(on_the_way, kept - rounding);
    } else if (s.distance < 0.0) {
      ++tally[1];
      ASSERT_EQ(s.time, 0.0);
      ASSERT_LE(solid.distance(body, from, Vec3(0.0), 1.0), kept + rounding);
      const Vec3 out = from - s.distance * s.normal;
      ASSERT_GE(solid.distance(body, out, Vec3(0.0), 1.0), kept - 2.0 * rounding) << "the way out leads out";
      ASSERT_FALSE(solid.has_inside(body, out));
      for (const double shorter : {0.5, 0.9, 0.99}) {  // and no other is shorter
        const Vec3 other = from - shorter * s.distance * random.direction();
        ASSERT_LT(solid.distance(body, other, Vec3(0.0), 1.0), kept + rounding);
      }
    } else {
      ++tally[2];
      ASSERT_GE(on_the_way, kept - rounding);
      const Vec3 there = from + s.time * motion;
      ASSERT_LE(solid.distance(body, there, Vec3(0.0), 1.0), body.radius + 2e-3 + rounding);
      ASSERT_LE(s.distance, 1e-5);
    }
    if (s.hit) {
      ASSERT_TRUE(s.unknown);
      ASSERT_NEAR(s.normal.x * s.normal.x + s.normal.y * s.normal.y + s.normal.z * s.normal.z, 1.0, 1e-12);
      for (int k = 0; k < 3; ++k) {
        ASSERT_GE(s.point[k], solid.box.lower[k]);
        ASSERT_LE(s.point[k], solid.box.upper[k]);
      }
    }
    const auto c = space.clearance(body, from, motion, 1000.0);
    if (!c.found) continue;
    const double least = solid.distance(body, from, motion, 1.0);
    ASSERT_LE(c.distance, least - kept + rounding);
    if (least > 1e-9 + rounding) {  // inside, depth counts and not distance
      ++tally[3];
      ASSERT_GE(c.distance, least - kept - 2e-6 - rounding);
    }
    roam::Contact contact;
    ASSERT_EQ(space.contacts(body, from, motion, 1000.0, {&contact, 1}), 1u);
    ASSERT_LE(contact.distance, least - kept + rounding);
  }
}

TEST(PatchworkUnknown, IsKeptAwayFromByTheMarginAndNoFarther) {
  clutter::Random random(51);
  std::array<int, 4> tally{};
  for (const Vec3 centre : {Vec3(0.0), Vec3(-13739.0, 253.0, 182.0), Vec3(6.4e6, -6.4e6, 6.4e6)}) {
    for (const double size : {0.01, 1.0, 30.0, 900.0}) {
      for (int i = 0; i < 30; ++i) {
        ask(random, centre, size, 100, tally);
        if (HasFatalFailure()) return;
      }
    }
  }
  for (const int count : tally) EXPECT_GT(count, 1000);
}

TEST(PatchworkUnknown, StandsLongMotionsAndWideBoxes) {
  clutter::Random random(52);
  std::array<int, 4> tally{};
  for (int i = 0; i < 100; ++i) {
    ask(random, Vec3(0.0), 3e5, 30, tally);
    if (HasFatalFailure()) return;
  }
  for (const int count : tally) EXPECT_GT(count, 50);
}

TEST(PatchworkUnknown, IsTouchedAtAFaceAnEdgeOrAVertex) {
  Patchwork space;
  static_cast<void>(space.expect({Vec3(-1.0), Vec3(1.0)}));
  space.update();
  const Body ball{0.2, 0.0};
  const std::pair<Vec3, roam::Feature> starts[] = {{{-4.0, 0.2, 0.1}, roam::Feature::face},
                                                   {{-4.0, -4.0, 0.1}, roam::Feature::edge},
                                                   {{-4.0, -4.0, -4.0}, roam::Feature::vertex}};
  for (const auto& [from, feature] : starts) {
    const Vec3 to(0.0, from.y < -1.0 ? 0.0 : from.y, from.z < -1.0 ? 0.0 : from.z);
    const roam::Impact met = space.sweep(ball, from, to - from);
    ASSERT_TRUE(met.hit && met.unknown);
    EXPECT_EQ(met.feature, feature);
    EXPECT_EQ(met.point, glm::clamp(from, Vec3(-1.0), Vec3(1.0)));
  }
}

TEST(PatchworkUnknown, SidesOfOneBoxAndOfDifferentBoxesAreToldApart) {
  Patchwork space;
  (void)space.expect({{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}});
  (void)space.expect({{5.0, 0.0, 0.0}, {6.0, 1.0, 1.0}});
  space.update();
  std::vector<roam::TriangleId> ids;
  for (const double x : {0.5, 5.5}) {
    for (int k = 0; k < 3; ++k) {
      for (const double sign : {-1.0, 1.0}) {
        Vec3 from(x, 0.5, 0.5);
        from[k] += sign;
        Vec3 motion(0.0);
        motion[k] = -sign;
        const auto s = space.sweep({0.1, 0.0}, from, motion);
        ASSERT_TRUE(s.hit && s.unknown);
        EXPECT_EQ(s.normal[k], sign);
        EXPECT_EQ(s.feature, roam::Feature::face);
        EXPECT_EQ(space.object_name(s.triangle), "not loaded yet");
        ids.push_back(s.triangle);
      }
    }
  }
  std::sort(ids.begin(), ids.end());
  EXPECT_EQ(std::unique(ids.begin(), ids.end()), ids.end());
}

TEST(PatchworkUnknown, LeavesABodyBesideItFreeWhenItBecomesKnown) {
  clutter::Random random(53);
  for (int i = 0; i < 300; ++i) {
    const Vec3 at = i % 2 == 0 ? random.in_box(100.0) : 6.4e6 * random.direction() + random.in_box(50.0);
    roam::Mesh mesh;
    scenes::add_box(mesh, at - Vec3(1.0), at + Vec3(1.0));  // the walls are the sides of what was unknown
    Patchwork space;
    const auto patch = space.expect({at - Vec3(1.0), at + Vec3(1.0)});
    space.update();
    const Body body{0.3, i % 3 == 0 ? 0.6 : 0.0};
    const Vec3 from = at + 5.0 * random.direction(), motion = at + random.in_box(0.9) - from;
    const auto s = space.sweep(body, from, motion);
    ASSERT_TRUE(s.hit && s.unknown);
    const Vec3 place = from + s.time * motion;
    space.deliver(patch, scenes::build(mesh));
    space.update(body, place);
    EXPECT_GE(space.clearance(body, place, 1.0).distance, 1e-6);
  }
}

}  // namespace
