// Pictures larger than the window, drawn in tiles.

#include "graphics/large_picture.h"

#include <algorithm>
#include <new>
#include <set>

#include "graphics/composite.h"
#include "graphics/hud.h"
#include "graphics_stage.h"
#include "roam/error.h"

namespace roam::test {
namespace {

using graphics::TileLimits;

/// Several tiles of a small picture.
const TileLimits small{.pixels = 1000, .side = 100, .tile_side = 248};
const TileLimits whole{.pixels = 100'000'000, .side = 16384, .tile_side = 16384};

/// Boards before a wall on a floor, askew: outlines, corners and gaps all over the picture.
struct Boards {
  explicit Boards(int width = 320, int height = 180)
      : stage(width, height, {.samples = 4, .quality = graphics::Quality::plain}) {
    stage.add(quad({0, 6, 0}, x_axis * 9, z_axis * 9));
    stage.add(quad({0, 6, -1}, x_axis * 9, y_axis * 9));
    for (int i = -6; i <= 6; ++i) {
      for (int k = -2; k <= 3; ++k) {
        stage.add(
            paint(quad({0.7 * i, 5.6 - 0.1 * k, 0.75 * k + 0.05 * i}, x_axis * 0.24 + z_axis * 0.03, z_axis * 0.2),
                  {0.9f, 0.6f + 0.03f * static_cast<float>(i), 0.3f, 1}));
      }
    }
    stage.look({0.3, 0, 0.2}, {0.1, 1, 0.1});
    stage.viewer.realize();
  }
  osg::ref_ptr<osg::Image> picture(int width, int height, const TileLimits& limits) {
    return graphics::draw_large_picture(
        stage.frame, width, height, [&] { stage.viewer.frame(); }, limits);
  }
  Stage stage;
};

TEST(GraphicsLargePicture, TilesCoverThePictureOnceAndHaveTheirMargins) {
  for (const auto& [width, height] : {std::pair{7680, 4320}, {16384, 16384}, {5001, 333}, {997, 9001}}) {
    std::int64_t kept = 0;
    const int reach = graphics::effects_reach(height);
    for (const graphics::Tile& t : graphics::tiles_of(width, height)) {
      kept += std::int64_t{t.width} * t.height;
      EXPECT_EQ(t.drawn.x % graphics::effects_period + t.drawn.y % graphics::effects_period, 0);
      EXPECT_TRUE(t.drawn.x == 0 || t.x - t.drawn.x >= reach);
      EXPECT_TRUE(t.drawn.y == 0 || t.y - t.drawn.y >= reach);
      const int right = t.drawn.x + t.drawn.width, upper = t.drawn.y + t.drawn.height;
      EXPECT_TRUE(right == width || right - (t.x + t.width) >= reach);
      EXPECT_TRUE(upper == height || upper - (t.y + t.height) >= reach);
      EXPECT_LE(std::max(t.drawn.width, t.drawn.height), 3072);
    }
    EXPECT_EQ(kept, std::int64_t{width} * height);
  }
  EXPECT_EQ(graphics::tiles_of(3840, 2160).size(), 1u);
}

TEST(GraphicsLargePicture, HasNoSeams) {
  Boards boards;
  ASSERT_GE(graphics::tiles_of(960, 540, small).size(), 12u);
  const auto tiled = boards.picture(960, 540, small), once = boards.picture(960, 540, whole);
  // Single pixels on outlines are rasterized differently; a seam would be a row or a column.
  EXPECT_LT(differing(*tiled, *once, 6), 960 * 540 / 2000);
  for (int x = 0; x < 960; ++x) {
    int wrong = 0;
    for (int y = 0; y < 540; ++y) wrong += at(*tiled, x, y).distance(at(*once, x, y)) > 6;
    EXPECT_LT(wrong, 20) << "column " << x;
  }
  for (int y = 0; y < 540; ++y) {
    int wrong = 0;
    for (int x = 0; x < 960; ++x) wrong += at(*tiled, x, y).distance(at(*once, x, y)) > 6;
    EXPECT_LT(wrong, 20) << "row " << y;
  }
}

TEST(GraphicsLargePicture, IsThatOfTheWindowInMorePixels) {
  Boards boards;
  boards.stage.frame.set_quality(graphics::Quality::full);
  const auto window = boards.stage.picture(), large = boards.picture(1280, 720, small);
  int wrong = 0;
  for (int x = 0; x < 320; ++x) {
    for (int y = 0; y < 180; ++y) {
      Pixel mean;
      for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 4; ++k) {
          const Pixel p = at(*large, 4 * x + i, 4 * y + k);
          mean = {mean.r + p.r, mean.g + p.g, mean.b + p.b};
        }
      }
      wrong += Pixel{mean.r / 16, mean.g / 16, mean.b / 16}.distance(at(*window, x, y)) > 75;
    }
  }
  // All are on outlines: thinner lines are brighter, more so before bright walls.
  EXPECT_LT(wrong, 320 * 180 / 40);
}

TEST(GraphicsLargePicture, LeavesTheWindowAsItWas) {
  Boards boards;
  graphics::Hud hud(boards.stage.frame);
  hud.set_message("a message");
  const auto before = boards.stage.picture(true);
  static_cast<void>(boards.picture(500, 900, small));
  EXPECT_EQ(boards.stage.frame.width(), 320);
  EXPECT_EQ(differing(*boards.stage.picture(true), *before), 0);
}

TEST(GraphicsLargePicture, CutsNoWallThatTheWindowShows) {
  Stage stage(200, 200);
  constexpr double radius = 0.3;
  stage.frame.set_near(graphics::near_limit(radius, stage.frame.vertical_fov(), 1.0));
  stage.add(paint(quad({0, radius, 0}, x_axis * 30, z_axis * 30), {1, 0.5f, 0, 1}));
  stage.viewer.realize();
  const auto wide = graphics::draw_large_picture(
      stage.frame, 800, 100, [&] { stage.viewer.frame(); }, small);
  for (const int x : {0, 400, 799}) {
    for (const int y : {0, 99}) EXPECT_GT(at(*wide, x, y).r, at(*wide, x, y).b + 40) << x << " " << y;
  }
}

TEST(GraphicsLargePicture, ThatIsNotDrawnIsAnError) {
  Boards boards;
  EXPECT_THROW(static_cast<void>(graphics::draw_large_picture(
                   boards.stage.frame, 300, 300, [] {}, small)),
               Error);
  EXPECT_EQ(boards.stage.frame.width(), 320);
}

TEST(GraphicsLargePicture, ForWhichThereIsNoMemoryIsAnError) {
  Boards boards;
  try {
    static_cast<void>(graphics::draw_large_picture(
        boards.stage.frame, 300, 200, [] { throw std::bad_alloc(); }, small));
    FAIL() << "it was drawn";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(), "there is no memory for a picture of 300 x 200 pixels");
  }
  EXPECT_EQ(boards.stage.frame.width(), 320);
}

}  // namespace
}  // namespace roam::test
