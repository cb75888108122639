// The bound of the checker against the oracle in long double, which shares nothing with it.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <random>

#include "check/check.h"
#include "verify/swept_distance.h"

namespace {

using roam::Triangle;
using roam::Vec3;
using roam::checking::apart;
using roam::checking::Segment;

/// Segments and triangles of hard kinds, far from the origin.
class Cases {
 public:
  explicit Cases(unsigned seed) : random_(seed) {}

  Segment segment() {
    Segment s;
    s.from = Vec3(-13739, 253, 182) + vector(1.0);
    s.to = s.from;
    switch (pick(5)) {
      case 0:
        break;  // a rest
      case 1:
        s.to.z += real();
        break;  // straight up or down
      case 2:
        s.to += Vec3(real(), real(), 0.0);
        break;  // level
      case 3:
        s.to += vector(1e3);
        break;  // long
      default:
        s.to += vector(0.02);
        break;  // one step
    }
    s.size = {0.3, pick(3) == 0 ? 0.0 : 0.6};
    return s;
  }

  /// Near the segment.
  Triangle triangle(const Segment& s) {
    const double size = std::pow(10.0, 1.0 + 3.0 * real());  // 1 cm to 10 km
    const Vec3 a = s.from + 0.5 * (1.0 + real()) * (s.to - s.from) + vector(2.0), along = vector(size);
    switch (pick(6)) {
      case 0:
        return {a, a, a};
      case 1:
        return {a, a + along, a + 0.3 * along};  // without area
      case 2:
        return {a, a + along, a + 0.5 * along + vector(1e-7)};  // a sliver
      case 3:
        return {a, a + (s.to - s.from) + vector(1e-9 * size), a + along};  // an edge almost parallel to the way
      case 4:
        return {a, a + Vec3(0.0, 0.0, size) + vector(1e-9 * size), a + along};  // and to the axis
      default:
        return {a, a + along, a + vector(size)};
    }
  }

 private:
  double real() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random_); }
  int pick(int of) { return std::uniform_int_distribution<int>(0, of - 1)(random_); }
  Vec3 vector(double size) { return size * Vec3(real(), real(), real()); }
  std::mt19937_64 random_;
};

TEST(CheckerBound, IsTheTrueDistance) {
  Cases cases(1);
  int apart_ones = 0;
  for (int i = 0; i < 200'000; ++i) {
    const Segment s = cases.segment();
    const Triangle t = cases.triangle(s);
    const auto d = static_cast<double>(roam::verification::swept_distance(s.from, s.to, s.size.half_height, t));
    ASSERT_FALSE(apart(s, t, d + 1e-13)) << i;  // never more than the truth
    if (!(d > 1e-6)) continue;
    ++apart_ones;
    ASSERT_TRUE(apart(s, t, d - 1e-9)) << i << ": " << d;  // and all of it
  }
  EXPECT_GT(apart_ones, 50'000);
}

TEST(CheckerBound, KnowsNoSidesOfATriangle) {
  const Triangle wall{Vec3(5, -9, 0), Vec3(5, 9, 0), Vec3(5, 0, 9)};
  Segment s{Vec3(4, 0, 1), Vec3(4.5, 0, 1), {0.3, 0.6}, 0.3};
  EXPECT_TRUE(apart(s, wall, 0.5 - 1e-9));
  EXPECT_FALSE(apart(s, wall, 0.5 + 1e-9));
  EXPECT_TRUE(apart(s, {wall[0], wall[2], wall[1]}, 0.5 - 1e-9));
  s.to.x = 6;  // through it
  EXPECT_FALSE(apart(s, wall, 1e-6));
}

}  // namespace
