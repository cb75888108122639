// The passes between the scene and the picture.

#include <algorithm>
#include <osg/Texture2D>
#include <vector>

#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::FrameSettings;
using graphics::Quality;

/// A wall of the photogrammetric kind: textured, without normals.
osg::ref_ptr<osg::Geometry> photograph(osg::ref_ptr<osg::Geometry> geometry) {
  osg::ref_ptr<osg::Image> image = new osg::Image;
  image->allocateImage(1, 1, 1, GL_RGB, GL_UNSIGNED_BYTE, 1);
  image->data()[0] = 240;
  image->data()[1] = 130;
  image->data()[2] = 15;
  geometry->setTexCoordArray(0, new osg::Vec2Array(4));
  const osg::ref_ptr<osg::Texture2D> texture = new osg::Texture2D(image);
  texture->setWrap(osg::Texture::WRAP_S, osg::Texture::REPEAT);
  texture->setWrap(osg::Texture::WRAP_T, osg::Texture::REPEAT);
  geometry->getOrCreateStateSet()->setTextureAttributeAndModes(0, texture);
  return geometry;
}

/// A wall at a floor, seen from the front and above.
struct Corner {
  explicit Corner(const FrameSettings& settings, bool photographed = false) : stage(320, 180, settings) {
    const auto made = [&](osg::ref_ptr<osg::Geometry> g) { return photographed ? photograph(g) : g; };
    stage.add(made(quad({0, 4, 0}, x_axis * 9, z_axis * 9)));
    stage.add(made(quad({0, 4, -1}, x_axis * 9, y_axis * 9)));
  }
  Stage stage;
};

/// The row of the picture in which the wall meets the floor: 1 m below the eye at a distance of 4 m.
int foot_row(const Stage& stage) {
  const double half = std::tan(0.5 * stage.frame.vertical_fov() * 3.14159265358979 / 180.0);
  return static_cast<int>(90.0 * (1.0 - 0.25 / half));
}

TEST(GraphicsEffects, OcclusionDarkensACornerAndLeavesAFreePlaneAlone) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    Corner with(settings), without(plain);
    with.stage.frame.set_edges(false);
    const auto dark = with.stage.picture(), bright = without.stage.picture();
    const int foot = foot_row(with.stage);
    for (const int x : {40, 160, 280}) {
      EXPECT_LT(at(*dark, x, foot + 2).sum(), 0.95 * at(*bright, x, foot + 2).sum()) << x;
      EXPECT_LT(at(*dark, x, foot - 2).sum(), 0.95 * at(*bright, x, foot - 2).sum()) << x;
      // Farther than the reach of the occlusion.
      for (const int y : {foot + 60, 170}) EXPECT_LE(at(*dark, x, y).distance(at(*bright, x, y)), 3) << x << " " << y;
    }
  }
}

TEST(GraphicsEffects, AFreePlaneIsLeftAloneAtEveryAngleAndDistance) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    for (const double height : {0.1, 1.6, 40.0, 900.0}) {
      Stage with(160, 90, settings), without(160, 90);
      for (Stage* stage : {&with, &without}) {
        stage->add(quad({0, 0, -height}, x_axis * 1e6, y_axis * 1e6));
        stage->look({0, 0, 0}, {0.3, 1, -0.4});
      }
      const auto a = with.picture(), b = without.picture();
      int wrong = 0;
      // Without the rows about the horizon, which the smoothing changes.
      for (int y = 0; y < 60; ++y) {
        for (int x = 0; x < 160; ++x) {
          const Pixel p = at(*a, x, y), q = at(*b, x, y);
          wrong += std::abs(p.r - q.r) > 1 || std::abs(p.g - q.g) > 1 || std::abs(p.b - q.b) > 1;
        }
      }
      EXPECT_EQ(wrong, 0) << height;
    }
  }
}

TEST(GraphicsEffects, PhotographsAreShownAsTheyAre) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    Corner corner(settings, true);
    const auto picture = corner.stage.picture();
    for (int y = 0; y < 180; ++y) {
      for (int x = 0; x < 320; ++x) ASSERT_EQ(at(*picture, x, y), (Pixel{240, 130, 15})) << x << " " << y;
    }
  }
}

/// A board half a metre before a wall.
void add_board(Stage& stage) {
  stage.add(quad({0, 4, 0}, x_axis * 9, z_axis * 9));
  stage.add(quad({-2, 3.0, 0}, x_axis * 2, z_axis * 2));
}

TEST(GraphicsEffects, EdgesAreDrawnAtAStepAndVanishWhenSwitchedOff) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    Stage stage(320, 180, settings);
    add_board(stage);
    const auto least = [](const osg::Image& picture) {
      int sum = 3 * 255;
      for (int x = 150; x < 170; ++x) sum = std::min(sum, at(picture, x, 100).sum());
      return sum;
    };
    const int on = least(*stage.picture());
    stage.frame.set_edges(false);
    const int off = least(*stage.picture());
    EXPECT_LT(on, 0.85 * off);
    stage.frame.set_edges(true);
    EXPECT_EQ(least(*stage.picture()), on);
  }
}

/// How much darker the lines make each row between two, of the columns around the middle.
std::vector<int> lines_of_rows(Stage& stage, int first, int last) {
  const auto sum = [&](const osg::Image& picture, int y) {
    int all = 0;
    for (int x = 80; x < 240; ++x) all += at(picture, x, y).sum();
    return all;
  };
  stage.frame.set_edges(true);
  const auto with = stage.picture();
  stage.frame.set_edges(false);
  const auto without = stage.picture();
  std::vector<int> rows;
  for (int y = first; y < last; ++y) rows.push_back(sum(*without, y) - sum(*with, y));
  return rows;
}

TEST(GraphicsEffects, ASlantingEdgeIsDrawnInEveryRow) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    Stage stage(320, 180, settings);
    const osg::Vec3d along(0.6, 0, 4), left(-4, 1.2, 0), right(4, 1.2, 0), middle(0, 4, 0);
    stage.add(quad(middle + left, left, along));
    stage.add(quad(middle + right, right, along));
    std::vector<int> rows = lines_of_rows(stage, 40, 140);
    std::sort(rows.begin(), rows.end());
    const int median = rows[rows.size() / 2];
    EXPECT_GT(median, 20);
    EXPECT_GT(rows.front(), 0.5 * median) << "no gaps: no dots";
    EXPECT_LT(rows.back(), 1.6 * median);
  }
}

TEST(GraphicsEffects, TheEndOfLevelGroundIsDrawnWhole) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    Stage stage(320, 180, settings);
    stage.add(quad({0, 4, -0.6}, x_axis * 9, y_axis * 4));  // which ends at 8 m, seen at 4 degrees
    stage.add(quad({0, 16, 0}, x_axis * 20, z_axis * 20));
    const auto with = stage.picture();
    stage.frame.set_edges(false);
    const auto without = stage.picture();
    for (int x = 0; x < 320; ++x) {
      int darkest = 0;
      for (int y = 60; y < 90; ++y) darkest = std::max(darkest, at(*without, x, y).sum() - at(*with, x, y).sum());
      ASSERT_GT(darkest, 30) << x;
    }
  }
}

TEST(GraphicsEffects, APlaneOfManyTrianglesHasNoEdges) {
  for (const FrameSettings& settings : {with_full, with_light}) {
    Stage stage(320, 180, settings);
    // Its end is too far away for a line.
    for (int i = -20; i < 200; ++i) {
      stage.add(quad({0.5 * i, 2.0 + 0.4 * i, 0}, osg::Vec3d(0.25, 0.2, 0), z_axis * 90));
    }
    const auto with = stage.picture();
    stage.frame.set_edges(false);
    EXPECT_EQ(differing(*with, *stage.picture()), 0);
  }
}

/// The pixels between the red of a board and that of the sky behind it.
int blended(const osg::Image& picture) {
  int count = 0;
  for (int y = 0; y < picture.t(); ++y) {
    for (int x = 0; x < picture.s(); ++x) count += at(picture, x, y).r > 170 && at(picture, x, y).r < 230;
  }
  return count;
}

TEST(GraphicsEffects, AStillIsSmoothWhateverTheQuality) {
  for (const Quality quality : {Quality::full, Quality::light, Quality::plain}) {
    Stage stage(200, 120, {.quality = quality});
    stage.add(photograph(quad({0, 5, 0}, osg::Vec3d(1.5, 0, 0.3), osg::Vec3d(-0.3, 0, 1.5))));
    osg::ref_ptr<osg::Image> still;
    stage.frame.request_picture(
        false, [&](osg::ref_ptr<osg::Image> image) { still = image; }, {}, graphics::Finish::full);
    stage.viewer.frame();
    ASSERT_TRUE(still);
    EXPECT_GT(blended(*still), 40) << int(quality);
    // The next frame has its own quality again.
    EXPECT_EQ(blended(*stage.picture()) > 0, quality == Quality::full) << int(quality);
  }
}

TEST(GraphicsEffects, APictureOfTheFrameIsAsItsNeighboursThoughAStillIsTaken) {
  for (const Quality quality : {Quality::full, Quality::light, Quality::plain}) {
    Stage stage(200, 120, {.quality = quality});
    add_board(stage);
    const auto before = stage.picture();
    osg::ref_ptr<osg::Image> still, film;
    stage.frame.request_picture(
        false, [&](osg::ref_ptr<osg::Image> image) { still = image; }, {}, graphics::Finish::full);
    stage.frame.request_picture(false, [&](osg::ref_ptr<osg::Image> image) { film = image; });
    stage.viewer.frame();
    EXPECT_TRUE(still);
    EXPECT_EQ(film.valid(), quality == Quality::full) << int(quality);
    stage.viewer.frame();
    ASSERT_TRUE(film);
    EXPECT_EQ(differing(*film, *before), 0) << int(quality);
  }
}

TEST(GraphicsEffects, WhereThereIsNoRoomForSamplesAreDrawnWithOne) {
  graphics::Context context = graphics::open_headless(320, 180);
  context.abilities.samples = 4096;  // which no driver has
  Stage many(context, {.samples = 4096, .quality = Quality::full}), one(320, 180, with_full);
  add_board(many);
  add_board(one);
  EXPECT_EQ(many.frame.lack(), "");
  EXPECT_EQ(differing(*many.picture(), *one.picture()), 0) << "with all effects";
  const std::string lack = many.frame.lack();
  EXPECT_EQ(lack, "the graphics driver cannot give 4096 samples a pixel");
  EXPECT_NE(many.frame.describe().find("1 sample a pixel (" + lack + ")"), std::string::npos) << many.frame.describe();
  many.frame.set_quality(Quality::light);
  static_cast<void>(many.picture());
  EXPECT_EQ(many.frame.lack(), "") << "it has one sample";
}

TEST(GraphicsEffects, EffectsFollowTheWindow) {
  Stage stage(160, 90, {.quality = Quality::full});
  add_board(stage);
  for (const auto& [width, height] : {std::pair{161, 91}, std::pair{1, 1}, std::pair{320, 37}, std::pair{640, 360}}) {
    stage.context.window->setWindowRectangle(0, 0, width, height);
    const auto picture = stage.picture();
    ASSERT_EQ(picture->s(), width);
    ASSERT_EQ(picture->t(), height);
    EXPECT_GT(at(*picture, width / 4, height / 2).sum(), 3 * 60) << width;
  }
}

TEST(GraphicsEffects, WithoutReversedDepthACornerIsDarkerToo) {
  Corner with({.samples = 1, .reversed_depth = false}), without(plain);
  const int foot = foot_row(with.stage);
  EXPECT_LT(at(*with.stage.picture(), 160, foot + 2).sum(), 0.95 * at(*without.stage.picture(), 160, foot + 2).sum());
}

}  // namespace
}  // namespace roam::test
