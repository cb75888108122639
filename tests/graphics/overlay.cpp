// The body, its contacts and its way, drawn in the scene.

#include "graphics/overlay.h"

#include <tuple>

#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::Overlay;

/// Pixels that differ from the picture without overlay, and by how much on average.
struct Difference {
  int pixels = 0;
  double mean = 0;
};

Difference difference(const osg::Image& a, const osg::Image& b) {
  Difference d;
  for (int y = 0; y < a.t(); ++y) {
    for (int x = 0; x < a.s(); ++x) {
      const int distance = at(a, x, y).distance(at(b, x, y));
      if (distance <= 8) continue;
      ++d.pixels;
      d.mean += distance;
    }
  }
  d.mean /= std::max(1, d.pixels);
  return d;
}

/// Rows and columns that are covered.
struct Extent {
  int width = 0, height = 0;
};
Extent extent(const osg::Image& a, const osg::Image& b) {
  int left = a.s(), right = -1, bottom = a.t(), top = -1;
  for (int y = 0; y < a.t(); ++y) {
    for (int x = 0; x < a.s(); ++x) {
      if (at(a, x, y).distance(at(b, x, y)) <= 8) continue;
      left = std::min(left, x), right = std::max(right, x), bottom = std::min(bottom, y), top = std::max(top, y);
    }
  }
  return {right - left + 1, top - bottom + 1};
}

osg::ref_ptr<osg::Geometry> grey_wall(double distance) {
  return paint(quad({0, distance, 0}, {30, 0, 0}, {0, 0, 30}), {0.5f, 0.5f, 0.5f, 1});
}

TEST(GraphicsOverlay, LinesGetWiderWithTheWindow) {
  for (const auto& [width, height, line] : {std::tuple{640, 360, 2}, std::tuple{1920, 2160, 4}}) {
    Stage stage(width, height);
    stage.add(grey_wall(20));
    const auto without = stage.picture();
    Overlay overlay(stage.frame);
    overlay.set_marks({.lines = {{Vec3(-3, 10, 0), Vec3(3, 10, 0)}}});
    EXPECT_NEAR(extent(*without, *stage.picture()).height, line, 1) << height;
  }
}

TEST(GraphicsOverlay, TheBodyIsAsLargeAsItIs) {
  Stage stage(320, 180);
  stage.add(grey_wall(20));
  const auto without = stage.picture();
  Overlay overlay(stage.frame);
  const double scale = 90 / std::tan(0.5 * 65 * M_PI / 180) / 10;  // pixels a metre at 10 m

  overlay.set_marks({.body = graphics::BodyMark{{0, 10, 0}, 1.0, 2.0}});
  const Extent sphere = extent(*without, *stage.picture());
  EXPECT_NEAR(sphere.width, 2 * scale, 3);
  EXPECT_NEAR(sphere.height, 2 * scale, 3);

  overlay.set_marks({.body = graphics::BodyMark{{0, 10, 0}, 1.0, 4.0}});
  const Extent capsule = extent(*without, *stage.picture());
  EXPECT_NEAR(capsule.width, 2 * scale, 3);
  EXPECT_NEAR(capsule.height, 4 * scale, 3);

  overlay.set_marks({});
  EXPECT_EQ(difference(*without, *stage.picture()).pixels, 0);
}

TEST(GraphicsOverlay, WhatLiesBehindAWallShinesThroughFaintly) {
  Stage stage(320, 180);
  stage.add(grey_wall(8));
  const auto without = stage.picture();
  Overlay overlay(stage.frame);
  overlay.set_marks({.body = graphics::BodyMark{{0, 6, 0}, 1.0, 2.0}});
  const Difference before = difference(*without, *stage.picture());
  overlay.set_marks({.body = graphics::BodyMark{{0, 12, 0}, 1.0, 2.0}});
  const Difference behind = difference(*without, *stage.picture());
  EXPECT_GT(before.pixels, 100);
  EXPECT_GT(behind.pixels, 50);
  EXPECT_LT(behind.mean, 0.5 * before.mean);
}

TEST(GraphicsOverlay, ATriangleOnAWallIsSeenOnIt) {
  Stage stage(320, 180);
  // Slanted, so that the depths of wall and triangle are not rounded alike.
  const osg::Vec3d along(0.8, 0.55, 0), up(0.1, 0.2, 0.95), middle(0, 8, 0);
  stage.add(paint(quad(middle, along * 30, up * 30), {0.5f, 0.5f, 0.5f, 1}));
  const auto without = stage.picture();
  Overlay overlay(stage.frame);
  graphics::Marks marks;
  const auto on_wall = [&](double s, double t) {
    const osg::Vec3d p = middle + along * s + up * t;
    return Vec3(p.x(), p.y(), p.z());
  };
  marks.triangles.push_back({on_wall(-2, -1), on_wall(2, -1), on_wall(0, 2)});
  overlay.set_marks(marks);
  const auto with = stage.picture();
  // Its face, well inside: as much warmer than the grey of the wall everywhere.
  const Pixel first = at(*with, 150, 90);
  EXPECT_GT(first.r, first.b + 20);
  for (int y = 85; y <= 95; ++y) {
    for (int x = 150; x <= 170; ++x) {
      EXPECT_LT(at(*with, x, y).distance(first), 12) << x << " " << y;
      EXPECT_GT(at(*with, x, y).distance(at(*without, x, y)), 20) << x << " " << y;
    }
  }
}

TEST(GraphicsOverlay, ContactsAreDrawnWithTheirNormals) {
  Stage stage(320, 180);
  stage.add(grey_wall(8));
  const auto without = stage.picture();
  Overlay overlay(stage.frame);
  graphics::Marks marks;
  marks.contacts.push_back({Vec3(0, 4, 0), Vec3(1, 0, 0)});
  overlay.set_marks(marks);
  const Extent drawn = extent(*without, *stage.picture());
  const double scale = 90 / std::tan(0.5 * 65 * M_PI / 180) / 4;
  EXPECT_NEAR(drawn.width, (0.3 + 0.05) * scale, 3);
  EXPECT_NEAR(drawn.height, 0.1 * scale, 3);
}

TEST(GraphicsOverlay, GoesAwayWithItsObject) {
  Stage stage(320, 180);
  const auto without = stage.picture();
  {
    Overlay overlay(stage.frame);
    overlay.set_marks({.body = graphics::BodyMark{{0, 6, 0}, 1.0, 2.0, true}});
    EXPECT_GT(difference(*without, *stage.picture()).pixels, 100);
  }
  EXPECT_EQ(difference(*without, *stage.picture()).pixels, 0);
}

TEST(GraphicsOverlay, AMeasuredLineIsSeen) {
  Stage stage(320, 180);
  stage.add(grey_wall(20));
  const auto without = stage.picture();
  Overlay overlay(stage.frame);
  graphics::Marks marks;
  marks.lines.push_back({Vec3(-3, 10, 0), Vec3(3, 10, 0)});
  marks.points.push_back({-3, 10, 0});
  overlay.set_marks(marks);
  const double scale = 90 / std::tan(0.5 * 65 * M_PI / 180) / 10;  // pixels a metre at 10 m
  EXPECT_NEAR(extent(*without, *stage.picture()).width, 6 * scale, 3);
}

TEST(GraphicsOverlay, ABodyThatTheEyeIsInIsARingAtItsFeet) {
  Stage stage;
  stage.add(grey_wall(20));
  const auto without = stage.picture();
  Overlay overlay(stage.frame);
  graphics::BodyMark body{{0, 0, -0.7}, 0.3, 1.8};
  overlay.set_marks({.body = body});
  EXPECT_GT(difference(*without, *stage.picture()).pixels, 100) << "its lines cross the view";
  body.inside = true;
  overlay.set_marks({.body = body});
  EXPECT_EQ(difference(*without, *stage.picture()).pixels, 0);
  stage.look({0, 0, 0}, {0, 0.001, -1});
  const auto with_ring = stage.picture();
  overlay.set_marks({});
  EXPECT_GT(difference(*stage.picture(), *with_ring).pixels, 100);
}

}  // namespace
}  // namespace roam::test
