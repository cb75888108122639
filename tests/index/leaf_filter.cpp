// The leaf tests lose no triangle: bodies that just touch one far off in a tile, judged in higher precision. World may
// let a body sink by more than a leaf's margin mostly is, so that whole worlds would not show what these do.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "clutter.h"
#include "graze.h"
#include "index/leaf-inl.h"
#include "index/ray-inl.h"
#include "oracle.h"

namespace {

using roam::Body;
using roam::Triangle;
using roam::Vec3;
using roam::index::fine_steps;
using roam::index::Leaf;
using roam::index::node_width;
namespace lanes = roam::index::HWY_NAMESPACE;

/// Metres. The triangles lie anywhere in a tile of this step, and bodies pass one of them that set out far from it.
constexpr double step_size = 1.0 / 1024.0;
const Vec3 curve_origin(-13739.0, 253.0, 182.0);

struct LeafScene {
  Leaf leaf{};
  roam::index::FineLeaf fine{};
  const roam::index::FineLeaf* low;
  Triangle triangles[node_width];

  /// `has_low`: vertices have low bits.
  LeafScene(clutter::Random& random, bool has_low) : low(has_low ? &fine : nullptr) {
    leaf.triangle_count = node_width;
    // Up to eight metres wide, as fits the tile.
    const double half = std::pow(10.0, random.between(-1.0, 0.6));
    const Vec3 middle = Vec3(32.0) + random.in_box(31.9 - half);
    Vec3 vertices[node_width];
    for (int v = 0; v < node_width; ++v) {
      const Vec3 at = (middle + random.in_box(half)) / step_size;
      for (int k = 0; k < 3; ++k) {
        leaf.vertex[k][v] = static_cast<std::uint16_t>(at[k]);
        if (has_low) fine.vertex[k][v] = static_cast<std::int16_t>(random.engine() & 0xffffU);
        vertices[v][k] = curve_origin[k] + step_size * (leaf.vertex[k][v] + fine.vertex[k][v] / double(fine_steps));
      }
    }
    for (int i = 0; i < node_width; ++i) {
      for (int c = 0; c < 3; ++c) {
        const auto v = static_cast<std::uint32_t>(random.engine() % node_width);
        leaf.corner[c][i / 8] |= v << (4 * (i % 8));
        triangles[i][c] = vertices[v];
      }
    }
  }
};

/// A body that passes one triangle of a scene, and touches it by less than a rounding of its radius.
struct Touch {
  LeafScene scene;
  lanes::Frame frame{curve_origin, step_size, curve_origin};
  clutter::Graze graze;
  float radius = 0.0F;
  bool some = false;  ///< there is one

  Touch(clutter::Random& random, bool has_low, bool capsule, bool rests) : scene(random, has_low) {
    const Triangle& t = scene.triangles[random.engine() % node_width];
    if (!(clutter::length(clutter::cross(t[1] - t[0], t[2] - t[0])) > 1e-3)) return;
    some = true;
    const Body body{std::pow(10.0, random.between(-3.0, 1.0)), capsule ? random.between(0.1, 1.0) : 0.0};
    graze = clutter::graze(random, t, body, 0.0, std::pow(10.0, random.between(-2.0, 1.8)));
    if (rests) {
      graze.from += graze.time * graze.motion;
      graze.motion = Vec3(0.0);
    }
    frame = lanes::Frame(curve_origin, step_size, graze.from);
    const long double least = oracle::least_distance(graze.body, graze.from, graze.motion, 1.0, t);
    radius = std::nextafter(static_cast<float>(least), 100.0F);
  }
  [[nodiscard]] long double least(int i, double time) const {
    return oracle::least_distance(graze.body, graze.from, graze.motion, time, scene.triangles[i]);
  }
};

/// A leaf that stops at the first arrival leaves out only triangles met later.
void expect_same_first(const lanes::Met& first, const lanes::Met& all) {
  double earliest = 2.0;
  for (int i = 0; i < node_width; ++i) {
    if ((all.arrived >> i & 1U) != 0) earliest = std::min(earliest, double(all.time[i]));
  }
  for (int i = 0; i < node_width; ++i) {
    const auto kind = [i](const lanes::Met& met) { return (met.arrived >> i & 1U) | (met.open >> i & 1U) << 1; };
    if (kind(first) == kind(all)) {
      if (kind(all) != 0) {
        ASSERT_EQ(first.time[i], all.time[i]) << "triangle " << i;
      }
    } else {
      ASSERT_GT(double((kind(all) != 0 ? all : first).time[i]), earliest) << "triangle " << i;
    }
  }
}

void sweep_every_triangle(bool capsule) {
  clutter::Random random(51);
  int tested = 0, missed = 0, arrived = 0;
  for (int q = 0; q < 10000; ++q) {
    const bool has_low = q % 3 == 0;
    const Touch touch(random, has_low, capsule, false);
    if (!touch.some) continue;
    const lanes::Motion motion(touch.graze.motion, touch.graze.body.half_height);
    const float beyond = has_low ? roam::index::fine_hit_distance : roam::index::hit_limit_distance;
    const float limit = q % 2 == 0 ? -1.0F : touch.radius + beyond;
    lanes::Met met, all;
    lanes::sweep_leaf<true>(touch.scene.leaf, touch.scene.low, touch.frame, motion, touch.radius, limit, 0.0F, 1.0F,
                            met);
    lanes::sweep_leaf<false>(touch.scene.leaf, touch.scene.low, touch.frame, motion, touch.radius, limit, 0.0F, 1.0F,
                             all);
    expect_same_first(met, all);
    for (int i = 0; i < node_width; ++i) {
      ++tested;
      const bool left = ((met.arrived | met.open) >> i & 1U) != 0;
      const double free = left ? double(met.time[i]) : double(met.until);
      missed += left ? 0 : 1;
      if (free > 0.0) {
        ASSERT_GE(touch.least(i, free), (long double)(touch.radius)) << "query " << q << " triangle " << i;
      }
      if ((met.arrived >> i & 1U) == 0) continue;
      ++arrived;
      ASSERT_LE(oracle::distance_on_the_way(touch.graze.body, touch.graze.from, touch.graze.motion, free,
                                            touch.scene.triangles[i]),
                (long double)(limit))
          << "query " << q << " triangle " << i;
    }
  }
  EXPECT_GT(missed, tested / 4) << "the leaf tests tell nothing";
  EXPECT_GT(arrived, 1000);
}

TEST(LeafFilter, LosesNoTriangleToASphere) { sweep_every_triangle(false); }

TEST(LeafFilter, LosesNoTriangleToACapsule) { sweep_every_triangle(true); }

template <class Bounds>
void bound_every_triangle(bool capsule) {
  clutter::Random random(52);
  int tested = 0, left_out = 0;
  for (int q = 0; q < 6000; ++q) {
    const Touch touch(random, q % 2 == 0, capsule, q % 3 == 0);
    if (!touch.some) continue;
    const lanes::Way way(touch.graze.motion, touch.graze.body.half_height);
    const Bounds bounds(1.0 / 8.0, 0.0, 0.0, 100.0);
    lanes::VF left = lanes::set(std::numeric_limits<float>::infinity());
    lanes::Children triangles;
    alignas(64) float most[node_width], lanes_left[lanes::lane_count];
    lanes::near_leaf(touch.scene.leaf, touch.scene.low, touch.frame, way, touch.radius, bounds, left, triangles, most);
    lanes::hn::Store(left, lanes::kF, lanes_left);
    const float others = *std::min_element(lanes_left, lanes_left + lanes::lane_count);
    ASSERT_GT(others, touch.radius);
    for (int i = 0; i < node_width; ++i) {
      ++tested;
      const long double least = touch.least(i, 1.0);
      if ((triangles.mask >> i & 1U) == 0) {
        ++left_out;
        ASSERT_GE(least, (long double)(others)) << "query " << q << " triangle " << i;
        continue;
      }
      ASSERT_GE(least, (long double)(triangles.key[i])) << "query " << q << " triangle " << i;
      ASSERT_LE(least, (long double)(most[i]) + 2e-5L) << "query " << q << " triangle " << i;
    }
  }
  EXPECT_GT(left_out, tested / 4) << "the leaf tests tell nothing";
}

TEST(LeafFilter, BoundsEveryTriangleOfAClearance) {
  bound_every_triangle<lanes::Tight>(false);
  bound_every_triangle<lanes::Tight>(true);
}

TEST(LeafFilter, BoundsEveryTriangleOfAGap) {
  bound_every_triangle<lanes::Slack>(false);
  bound_every_triangle<lanes::Slack>(true);
}

/// A leaf with one triangle, long and narrow, not yet so narrow that its edges stand for it.
struct Sliver {
  Leaf leaf{};
  Triangle triangle{};
  Vec3 along{0.0}, normal{0.0};  ///< of the longest edge; of unit length
  bool some = false;             ///< it has an area

  Sliver(clutter::Random& random, int turned) {
    leaf.triangle_count = 1;
    const Vec3 first = random.in_box(31.0), second = random.in_box(31.0);
    along = second - first;
    const Vec3 third = first + random.unit() * along + std::pow(10.0, random.between(-2.7, -0.5)) * random.direction();
    const Vec3 corners[3] = {first, second, third};
    for (int c = 0; c < 3; ++c) {
      for (int k = 0; k < 3; ++k) {
        const double steps = (corners[(c + turned) % 3][k] + 32.0) / step_size;
        leaf.vertex[k][c] = static_cast<std::uint16_t>(steps);
        triangle[c][k] = step_size * leaf.vertex[k][c];
      }
      for (int i = 0; i < node_width; ++i) leaf.corner[c][i / 8] |= static_cast<std::uint32_t>(c) << (4 * (i % 8));
    }
    normal = clutter::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
    const double area = clutter::length(normal);
    some = area > 1e-6;
    normal = normal / area;
    along = along / clutter::length(along);
  }
};

TEST(LeafFilter, KnowsHowNearASliverIs) {
  clutter::Random random(54);
  int tested = 0;
  for (int q = 0; q < 50000; ++q) {
    const Sliver sliver(random, q);
    if (!sliver.some) continue;
    ++tested;
    const Triangle& t = sliver.triangle;
    const Vec3 side = clutter::cross(sliver.normal, sliver.along);
    const double beside = std::pow(10.0, random.between(-3.0, 0.5)), above = std::pow(10.0, random.between(-4.0, 1.0));
    const Vec3 place = t[0] + random.unit() * (t[1] - t[0]) + (q % 2 == 0 ? beside : -beside) * side +
                       (q % 4 < 2 ? above : -above) * sliver.normal;
    const lanes::Frame frame(Vec3(0.0), step_size, place);
    lanes::VF left = lanes::set(0.0F);
    lanes::Children triangles;
    alignas(64) float most[node_width];
    lanes::near_leaf(sliver.leaf, nullptr, frame, lanes::Way(Vec3(0.0), 0.0), 200.0F, lanes::Tight(0.0, 0.0, 0.0, 0.0),
                     left, triangles, most);
    ASSERT_EQ(triangles.mask & 1U, 1U) << q;
    const long double least = oracle::distance(Body{0.0, 0.0}, place, t);
    ASSERT_GE(least, (long double)(triangles.key[0])) << q;
    ASSERT_LE(least, (long double)(most[0]) + 2e-5L) << q;
  }
  EXPECT_GT(tested, 40000);
}

/// Neither later than at the radius nor earlier than at the limit.
TEST(LeafFilter, ArrivesAtASliverInTime) {
  clutter::Random random(55);
  int arrived = 0;
  for (int q = 0; q < 50000; ++q) {
    const Sliver sliver(random, q);
    if (!sliver.some) continue;
    const Body body{std::pow(10.0, random.between(-3.0, 0.6)), q % 2 == 0 ? 0.0 : random.between(0.1, 1.0)};
    const double depth = q % 4 < 2 ? 0.0 : random.between(-0.02, 0.3) * body.radius;
    const clutter::Graze g =
        clutter::graze(random, sliver.triangle, body, depth, std::pow(10.0, random.between(-2.0, 1.8)));
    const lanes::Frame frame(Vec3(0.0), step_size, g.from);
    const lanes::Motion motion(g.motion, body.half_height);
    const float delta = 0.00085F, radius = static_cast<float>(body.radius) + delta;
    const float limit = static_cast<float>(body.radius) + 0.00114F;
    lanes::Met met;
    lanes::sweep_leaf<true>(sliver.leaf, nullptr, frame, motion, radius, limit, 0.0F, 1.0F, met);
    const bool here = (met.arrived & 1U) != 0;
    arrived += here ? 1 : 0;
    const double free = here || (met.open & 1U) != 0 ? double(met.time[0]) : double(met.until);
    if (free > 0.0) {
      ASSERT_GE(oracle::least_distance(body, g.from, g.motion, free, sliver.triangle), (long double)(radius)-1e-6L)
          << q;
    }
    if (here) {
      ASSERT_LE(oracle::distance_on_the_way(body, g.from, g.motion, free, sliver.triangle), (long double)(limit)) << q;
    }
  }
  EXPECT_GT(arrived, 5000);
}

/// The margin of rays must cover this: rounded slopes project along a direction that is not quite that of the way.
TEST(LeafFilter, KnowsHowFarARayLeadsInItsProjection) {
  clutter::Random random(53);
  for (int q = 0; q < 10000; ++q) {
    Vec3 way = random.direction() * std::pow(10.0, random.between(-3.0, 1.8));
    if (q % 5 == 0) way[q % 3] *= 1e-6;
    const lanes::Motion motion(way, 0.0);
    const lanes::Ray ray(motion);
    for (int i = 0; i < 2; ++i) {
      const long double slope = ray.slope[i];
      ASSERT_LE(std::abs((long double)(way[ray.axis[i]]) - slope * (long double)(way[ray.axis[2]])),
                roam::index::speed_roundings * roam::index::float_unit * motion.longest)
          << q;
      ASSERT_LE(1.0L + slope * slope, (long double)(lanes::Ray::longest_across)*lanes::Ray::longest_across) << q;
    }
  }
}

/// Through corners, edges and faces of triangles far off.
TEST(LeafFilter, LeavesEveryTriangleThatARayPierces) {
  clutter::Random random(54);
  int left = 0;
  for (int q = 0; q < 4000; ++q) {
    const LeafScene scene(random, q % 2 == 0);
    for (int i = 0; i < node_width; ++i) {
      const Triangle& t = scene.triangles[i];
      const double u = i % 3 == 0 ? 0.0 : random.unit(), v = i % 3 == 2 ? random.unit() * (1.0 - u) : 0.0;
      Vec3 way = random.direction() * std::pow(10.0, random.between(-3.0, 1.8));
      if (i % 5 == 0) way[i % 3] = 0.0;
      const Vec3 from = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]) - random.unit() * way;
      const lanes::Frame frame(curve_origin, step_size, from);
      const lanes::Motion motion(way, 0.0);
      lanes::Ray ray(motion);
      ray.enter(frame, motion, 0.0F, 0x1p16F);
      const std::uint32_t pierced = lanes::pierced(scene.leaf, scene.low, ray);
      ASSERT_NE(pierced >> i & 1U, 0U) << "query " << q << " triangle " << i;
      left += std::popcount(pierced);
    }
  }
  EXPECT_LT(left, 4000 * node_width * node_width / 2) << "the leaf tests tell nothing";
}

}  // namespace
