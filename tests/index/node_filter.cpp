// The node tests lose no child: boxes that a body just touches, judged in higher precision.

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>

#include "clutter.h"
#include "index/ray-inl.h"

namespace {

using roam::Vec3;
using roam::index::Node;
using roam::index::node_width;
namespace lanes = roam::index::HWY_NAMESPACE;

/// Child boxes and the start of a query, far off in a tile or in the tree over tiles.
struct NodeScene {
  Node node{};
  Vec3 origin, start;
  double step;
  float extent;  ///< of the widest node (m)

  NodeScene(clutter::Random& random, bool top) {
    step = top ? 1.0 / 65536.0 : 1.0 / 1024.0;
    extent = static_cast<float>(step * (top ? 0x1p29 : 0x1p16));
    const double wide = top ? 4000.0 : 60.0;
    origin = {-13739.0, 253.0, 182.0};
    node.child_count = node_width;
    node.inner_count = node_width;
    for (int k = 0; k < 3; ++k) {
      node.shift[k] = static_cast<std::uint8_t>(random.between(0.0, top ? 18.0 : 8.0));
      node.origin[k] = static_cast<std::int32_t>(random.between(0.0, 0.5 * wide / step));
      for (int i = 0; i < node_width; ++i) {
        const auto a = static_cast<std::uint8_t>(random.between(0.0, 256.0));
        const auto b = static_cast<std::uint8_t>(random.between(0.0, 256.0));
        node.lower[k][i] = std::min(a, b);
        node.upper[k][i] = std::max(a, b);
      }
    }
    start = origin + Vec3(random.between(0.0, wide), random.between(0.0, wide), random.between(0.0, wide));
  }
  [[nodiscard]] long double plane(const std::uint8_t (&bounds)[3][node_width], int i, int k) const {
    const auto steps = static_cast<std::int64_t>(node.origin[k]) + (std::int64_t{bounds[k][i]} << node.shift[k]);
    return (long double)(origin[k]) + (long double)(step)*steps;
  }
  /// Distance of the axis at time t to child box i.
  [[nodiscard]] long double distance(int i, const Vec3& motion, double half_height, long double t) const {
    long double squared = 0.0L;
    for (int k = 0; k < 3; ++k) {
      const long double at = (long double)(start[k]) + t * (long double)(motion[k]);
      const long double h = k == 2 ? half_height : 0.0;
      const long double d = std::max({plane(node.lower, i, k) - h - at, at - plane(node.upper, i, k) - h, 0.0L});
      squared += d * d;
    }
    return std::sqrt(squared);
  }
  [[nodiscard]] float grown(float radius, const lanes::Motion& motion) const {
    return lanes::grown_radius(radius, motion.half_height, motion.longest, extent, static_cast<float>(step));
  }
  /// When the axis is nearest to child box i; the distance is convex in time.
  [[nodiscard]] long double nearest_time(int i, const Vec3& motion, double half_height) const {
    long double a = 0.0L, b = 1.0L;
    for (int n = 0; n < 200; ++n) {
      const long double c = a + (b - a) / 3, d = b - (b - a) / 3;
      if (distance(i, motion, half_height, c) <= distance(i, motion, half_height, d)) {
        b = d;
      } else {
        a = c;
      }
    }
    return 0.5L * (a + b);
  }
};

/// The half height of a body and its way, metres.
struct BodyMove {
  double half_height;
  Vec3 way;
};
BodyMove any_move(clutter::Random& random, int q) {
  BodyMove m{q % 2 == 0 ? 0.0 : random.between(0.0, 2.0), Vec3(0.0)};
  m.way = random.direction() * std::pow(10.0, random.between(-3.0, 1.8));
  if (q % 5 == 0) m.way[q % 3] = 0.0;  // along a plane
  return m;
}

void touch_every_child(bool top) {
  clutter::Random random(41);
  int tested = 0, left_out = 0;
  for (int q = 0; q < 3000; ++q) {
    const NodeScene scene(random, top);
    const lanes::Frame frame(scene.origin, scene.step, scene.start);
    const auto [h, way] = any_move(random, q);
    const lanes::Motion motion(way, h);
    for (int i = 0; i < node_width; ++i) {
      const long double t = scene.nearest_time(i, way, h), d = scene.distance(i, way, h, t);
      if (d > 1000.0L) continue;
      ++tested;
      const auto radius = std::nextafter(static_cast<float>(d), 2000.0F);
      const float grown = scene.grown(radius, motion);
      lanes::Children children;
      lanes::sweep_node(scene.node, frame, motion, grown, 1.0F, children);
      ASSERT_NE(children.mask >> i & 1U, 0U) << "query " << q << " child " << i;
      ASSERT_LE((long double)(children.key[i]), t * (1.0L + 1e-9L) + 1e-9L) << "query " << q << " child " << i;
      if (h == 0.0) {
        lanes::ray_node(scene.node, lanes::RayFrame(frame, motion, lanes::Ray(motion), grown), motion, 1.0F, children);
        ASSERT_NE(children.mask >> i & 1U, 0U) << "query " << q << " child " << i;
        ASSERT_LE((long double)(children.key[i]), t * (1.0L + 1e-9L) + 1e-9L) << "query " << q << " child " << i;
      }
      // A part of the radius as what the frame adds to a reach.
      const float more = q % 3 == 0 ? 0.0F : 0.25F * radius;
      const lanes::Swept swept(frame, lanes::Reach(way, double(radius) - double(more), h), more);
      const std::uint32_t met = lanes::met_children(scene.node, swept);
      ASSERT_NE(met >> i & 1U, 0U) << "query " << q << " child " << i;
      left_out += node_width - std::popcount(met);

      for (const Vec3& gone : {Vec3(0.0), way}) {
        const long double least = gone == way ? d : scene.distance(i, Vec3(0.0), h, 0.0L);
        if (least > 1000.0L) continue;
        const auto reach = std::nextafter(static_cast<float>(least), 2000.0F);
        const lanes::Way near(gone, h);
        const float margin = lanes::grown_radius(0.0F, near.half_height, near.longest + 2.0F * reach, scene.extent,
                                                 static_cast<float>(scene.step));
        lanes::VF left = lanes::set(1e9F);
        lanes::near_node(scene.node, frame, near, margin, reach, left, children);
        ASSERT_NE(children.mask >> i & 1U, 0U) << "query " << q << " child " << i;
        ASSERT_LE((long double)(children.key[i]), least * (1.0L + 1e-15L)) << "query " << q << " child " << i;
        // Out of reach it is bounded, too.
        const float half = 0.5F * static_cast<float>(least);
        lanes::near_node(scene.node, frame, near, margin, half, left, children);
        alignas(64) float lanes_left[lanes::lane_count];
        lanes::hn::Store(left, lanes::kF, lanes_left);
        ASSERT_GE(*std::min_element(lanes_left, lanes_left + lanes::lane_count), half) << "query " << q;
        ASSERT_TRUE((children.mask >> i & 1U) != 0 || children.key[i] > half) << "query " << q << " child " << i;
      }
    }
  }
  EXPECT_GT(tested, 2000);
  EXPECT_GT(left_out, tested / 4) << "whole numbers tell nothing";
}

TEST(NodeFilter, LosesNoChildOfATinyTileToALargeBodyFarOff) {
  clutter::Random random(42);
  Node node{};
  node.child_count = node_width;
  for (int k = 0; k < 3; ++k) {
    node.shift[k] = 8;
    for (int i = 0; i < node_width; ++i) {
      node.lower[k][i] = 1;
      node.upper[k][i] = 254;
    }
  }
  const Vec3 origin(-13739.0, 253.0, 182.0);
  constexpr double finest = 0x1p-19, wide = 65536.0 * finest;
  for (int q = 0; q < 2000; ++q) {
    const double radius = random.between(500.0, 1000.0), h = random.between(0.0, 1000.0);
    // The end of the axis is so near that the tile is deep inside of the body.
    const double off = (q % 2 == 0 ? 1.0 : -1.0) * random.between(0.0, radius + h - 1.0);
    const Vec3 start = origin + Vec3(0.5 * wide, 0.5 * wide, off);
    const lanes::Frame frame(origin, finest, start);
    const lanes::Swept swept(frame, lanes::Reach(Vec3(0.0, 0.0, q % 3 == 0 ? 1.0 : 0.0), radius, h), 0.0F);
    ASSERT_EQ(lanes::met_children(node, swept), (1U << node_width) - 1) << q << ": " << off << " m off";
  }
}

/// Bodies that graze a child box, and bodies that meet it at any angle before they would be nearest to it.
void delay_every_child(bool top) {
  clutter::Random random(43);
  int tested = 0, delayed = 0;
  for (int q = 0; q < 3000; ++q) {
    const NodeScene scene(random, top);
    const lanes::Frame frame(scene.origin, scene.step, scene.start);
    const auto [h, way] = any_move(random, q);
    const lanes::Motion motion(way, h);
    for (int i = 0; i < node_width; ++i) {
      const long double nearest = scene.nearest_time(i, way, h), least = scene.distance(i, way, h, nearest);
      const long double most = scene.distance(i, way, h, 0.0L);
      if (least > 1000.0L) continue;
      ++tested;
      const long double apart = q % 3 == 0 ? least : least + (long double)(random.unit()) * (most - least);
      const auto radius = std::nextafter(static_cast<float>(apart), 2000.0F);
      long double free = 0.0L, met = nearest;
      for (int n = 0; n < 100 && most > (long double)(radius); ++n) {
        const long double t = 0.5L * (free + met);
        (scene.distance(i, way, h, t) > (long double)(radius) ? free : met) = t;
      }
      const float grown = scene.grown(radius, motion);
      lanes::Children children;
      lanes::sweep_node(scene.node, frame, motion, grown, 1.0F, children);
      ASSERT_NE(children.mask >> i & 1U, 0U) << "query " << q << " child " << i;
      const float entry = children.key[i];
      lanes::delay_children(scene.node, frame, motion, grown, 1.0F, children);
      ASSERT_NE(children.mask >> i & 1U, 0U) << "query " << q << " child " << i;
      ASSERT_GE(children.key[i], entry) << "query " << q << " child " << i;
      ASSERT_LE((long double)(children.key[i]), met) << "query " << q << " child " << i;
      delayed += children.key[i] > entry ? 1 : 0;
    }
  }
  EXPECT_GT(tested, 2000);
  EXPECT_GT(delayed, tested / 4) << "the second plane tells nothing";
}

/// Rays through corners and edges of child boxes, which they leave as they enter them.
void pierce_every_child(bool top) {
  clutter::Random random(44);
  for (int q = 0; q < 2000; ++q) {
    const NodeScene scene(random, top);
    const lanes::Frame frame(scene.origin, scene.step, scene.start);
    for (int i = 0; i < node_width; ++i) {
      Vec3 point;
      for (int k = 0; k < 3; ++k) {
        const auto lower = double(scene.plane(scene.node.lower, i, k)),
                   upper = double(scene.plane(scene.node.upper, i, k));
        const bool between = q % 2 == 1 && k == q % 3;
        point[k] = between ? random.between(lower, upper) : (random.unit() < 0.5 ? lower : upper);
      }
      const Vec3 way = (point - scene.start) * random.between(1.0, 2.0);
      const lanes::Motion motion(way, 0.0);
      const float grown = scene.grown(0.0F, motion);
      lanes::Children children;
      lanes::ray_node(scene.node, lanes::RayFrame(frame, motion, lanes::Ray(motion), grown), motion, 1.0F, children);
      ASSERT_NE(children.mask >> i & 1U, 0U) << "query " << q << " child " << i;
    }
  }
}

TEST(NodeFilter, LosesNoChildOfATileThatARayTouches) { pierce_every_child(false); }

TEST(NodeFilter, LosesNoChildOfTheTreeOverTilesThatARayTouches) { pierce_every_child(true); }

TEST(NodeFilter, DelaysNoChildOfATileTooLong) { delay_every_child(false); }

TEST(NodeFilter, DelaysNoChildOfTheTreeOverTilesTooLong) { delay_every_child(true); }

TEST(NodeFilter, LosesNoChildOfATile) { touch_every_child(false); }

TEST(NodeFilter, LosesNoChildOfTheTreeOverTiles) { touch_every_child(true); }

}  // namespace
