// The sun's shadows.

#include "graphics/sun.h"

#include <osg/MatrixTransform>

#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::FrameSettings;

/// Where a point at height `z` throws its shadow on the ground.
osg::Vec3d shadow_of(const osg::Vec3d& p) {
  const Vec3 sun = graphics::sun_direction();
  return p - osg::Vec3d(sun.x, sun.y, sun.z) * (p.z() / sun.z);
}

/// Counts how often its geometry is drawn.
struct Counter : osg::Drawable::DrawCallback {
  mutable int times = 0;
  void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override {
    ++times;
    drawable->drawImplementation(info);
  }
};

/// Ground with a board of 2 x 2 m, 3 m above it.
struct Yard {
  explicit Yard(const FrameSettings& settings = with_full, const osg::Vec3d& where = {})
      : stage(320, 180, settings), at(where) {
    stage.frame.set_edges(false);
    osg::ref_ptr<osg::MatrixTransform> cell = new osg::MatrixTransform(osg::Matrixd::translate(where));
    board->setDrawCallback(counter);
    cell->addChild(quad({0, 0, 0}, x_axis * 40, y_axis * 40));
    cell->addChild(board);
    stage.add(cell);
    sun.emplace(stage.frame, *stage.scene);
    look_down({0, 0, 12});
  }

  void look_down(const osg::Vec3d& eye) { stage.look(at + eye, at + eye + osg::Vec3d(0, 0.001, -1)); }
  /// The brightness of the ground at a point.
  int bright(const osg::Image& picture, const osg::Vec3d& place) {
    const osg::Camera& camera = *stage.viewer.getCamera();
    const osg::Vec3d clip = (at + place) * camera.getViewMatrix() * camera.getProjectionMatrix();
    const auto pixel = [](double share, int size) { return static_cast<int>(0.5 * (1.0 + share) * size); };
    return roam::test::at(picture, pixel(clip.x(), 320), pixel(clip.y(), 180)).sum();
  }
  /// The brightness of the ground in the middle of the board's shadow, in percent of that beside it.
  int share() {
    const auto picture = stage.picture();
    return 100 * bright(*picture, shadow_of({0, 0, 3})) / bright(*picture, shadow_of({0, 0, 3}) - y_axis * 5);
  }

  Stage stage;
  osg::Vec3d at;
  osg::ref_ptr<Counter> counter = new Counter;
  osg::ref_ptr<osg::Geometry> board = quad({0, 0, 3}, x_axis, y_axis);
  std::optional<graphics::Sun> sun;
};

TEST(GraphicsSun, ThrowsTheShadowOfABoardOnTheGround) {
  Yard yard;
  EXPECT_LT(yard.share(), 80);
  yard.sun->set_shadows(false);
  EXPECT_GT(yard.share(), 97);
  yard.sun->set_shadows(true);
  EXPECT_LT(yard.share(), 80);
}

TEST(GraphicsSun, TheShadowEndsWhereTheBoardEnds) {
  Yard yard;
  yard.look_down({-1.8, 1.35, 12});
  const auto picture = yard.stage.picture();
  for (const osg::Vec3d& side : {x_axis, -x_axis, y_axis, -y_axis}) {
    const int lit = yard.bright(*picture, shadow_of(osg::Vec3d(0, 0, 3) + side * 1.15));
    const int dark = yard.bright(*picture, shadow_of(osg::Vec3d(0, 0, 3) + side * 0.85));
    EXPECT_LT(dark, 0.85 * lit);
  }
}

TEST(GraphicsSun, APlainPictureIsTheSameWithAndWithoutIt) {
  Yard with(plain), without(plain);
  without.sun.reset();
  EXPECT_EQ(differing(*with.stage.picture(), *without.stage.picture()), 0);
  EXPECT_EQ(with.counter->times, without.counter->times);
}

TEST(GraphicsSun, ASceneWithoutASunIsLitAsBefore) {
  Yard with, without;
  without.sun.reset();
  (void)with.stage.picture();
  with.sun.reset();
  EXPECT_EQ(differing(*with.stage.picture(), *without.stage.picture()), 0);
}

TEST(GraphicsSun, AStillHasShadowsWhateverTheQuality) {
  Yard yard(plain);
  osg::ref_ptr<osg::Image> still;
  yard.stage.frame.request_picture(
      false, [&](osg::ref_ptr<osg::Image> image) { still = image; }, {}, graphics::Finish::full);
  yard.stage.viewer.frame();
  ASSERT_TRUE(still);
  EXPECT_LT(yard.bright(*still, shadow_of({0, 0, 3})), 0.8 * yard.bright(*still, shadow_of({0, -5, 3})));
  EXPECT_GT(yard.share(), 97) << "the next frame has its own quality again";
}

TEST(GraphicsSun, DrawsTheMapsOnlyWhenTheyMoveOrTheSceneChanges) {
  Yard yard;
  const auto drawn = [&] {
    yard.counter->times = 0;
    (void)yard.stage.picture();
    return yard.counter->times;
  };
  EXPECT_GT(drawn(), 1);
  EXPECT_EQ(drawn(), 1);
  yard.look_down({0.1, 0.1, 12});
  EXPECT_EQ(drawn(), 1);
  yard.look_down({5, 0, 12});
  EXPECT_GT(drawn(), 1);
  EXPECT_EQ(drawn(), 1);
  yard.stage.add(quad({3, 3, 1}, x_axis, y_axis));
  EXPECT_GT(drawn(), 1);
  EXPECT_EQ(drawn(), 1);
  std::uint64_t version = 0;
  yard.sun->watch([&] { return version; });
  EXPECT_EQ(drawn(), 1);
  // A little has changed: one map a frame. The third holds all of the yard.
  ++version;
  for (int map = 0; map < 3; ++map) EXPECT_EQ(drawn(), 2) << map;
  EXPECT_EQ(drawn(), 1);
  yard.sun->set_shadows(false);
  EXPECT_EQ(drawn(), 1);
  ++version;
  yard.sun->set_shadows(true);
  EXPECT_EQ(drawn(), 4) << "all at once after a pause, as for a still";
  EXPECT_EQ(drawn(), 1);
}

TEST(GraphicsSun, ItsMapsAndThePassesAreDrawCalls) {
  for (const auto& [settings, passes] : {std::pair(plain, 0), std::pair(with_light, 3), std::pair(with_full, 4)}) {
    Yard yard(settings);
    yard.stage.frame.count_draw_calls();
    (void)yard.stage.picture();
    const int first = yard.stage.frame.draw_calls();
    (void)yard.stage.picture();
    EXPECT_EQ(yard.stage.frame.draw_calls(), 3 + passes) << "sky, ground and board";
    // Each map shows both. The third holds all.
    EXPECT_EQ(first, (settings.quality == graphics::Quality::full ? 3 * 2 : 0) + 3 + passes);
  }
}

TEST(GraphicsSun, DrawsEachMapInTurnWhileTheSceneChangesInEachFrame) {
  Yard yard;
  std::uint64_t version = 0;
  yard.sun->watch([&] { return ++version; });
  (void)yard.stage.picture();
  for (const double height : {30.0, 3.0}) {
    // The board leaves its shadow's place, or comes back.
    osg::Vec3Array& corners = dynamic_cast<osg::Vec3Array&>(*yard.board->getVertexArray());
    for (osg::Vec3& corner : corners) corner.z() = static_cast<float>(height);
    corners.dirty();
    yard.board->dirtyGLObjects();
    for (int map = 0; map < 3; ++map) (void)yard.stage.picture();
    EXPECT_EQ(yard.share() < 80, height < 10.0) << height;
  }
}

TEST(GraphicsSun, AShadowStaysWhereItIsWhenTheEyeMoves) {
  Yard yard;
  // The column in which the ground gets bright, right of the shadow's middle, in metres.
  const auto edge = [&](double eye) {
    yard.look_down({eye, 1.35, 12});
    const auto picture = yard.stage.picture();
    const osg::Vec3d middle = shadow_of({0, 0, 3});
    const int dark = yard.bright(*picture, middle), lit = yard.bright(*picture, middle - y_axis * 4);
    double x = 0.0;
    while (x < 3.0 && yard.bright(*picture, middle + x_axis * x) < (dark + lit) / 2) x += 0.005;
    return x;
  };
  const double pixel = 2.0 * 12.0 * std::tan(0.5 * 65.0 * 3.14159265 / 180.0) / 180.0;
  const double there = edge(0.0);
  EXPECT_NEAR(there, 1.0, 2.0 * pixel);
  for (double eye = -1.0; eye < 1.0; eye += 0.137) EXPECT_NEAR(edge(eye), there, 1.1 * pixel) << eye;
}

TEST(GraphicsSun, ShadowsAreRightFarFromTheOrigin) {
  for (const osg::Vec3d& at : {osg::Vec3d(20'000, -7000, 300), osg::Vec3d(-3, 50'000, -2000)}) {
    Yard yard(with_full, at);
    EXPECT_LT(yard.share(), 80);
    const auto picture = yard.stage.picture();
    for (int x = -3; x < 4; ++x) {
      const int here = yard.bright(*picture, osg::Vec3d(x, -4, 0)), there = yard.bright(*picture, osg::Vec3d(x, -5, 0));
      EXPECT_NEAR(here, there, 4) << "the ground does not shadow itself";
    }
  }
}

TEST(GraphicsSun, GlassAndWhatASectionHidesThrowNoShadow) {
  Yard glazed;
  graphics::apply({.blended = true}, *glazed.board->getOrCreateStateSet());
  EXPECT_GT(glazed.share(), 97);
  Yard cut;
  EXPECT_LT(cut.share(), 80);
  graphics::set_section(*cut.stage.scene, std::vector<HalfSpace>{{{0, 0, 1}, 2.0}});
  EXPECT_GT(cut.share(), 97);
  graphics::set_section(*cut.stage.scene, {});
  EXPECT_LT(cut.share(), 80);
}

TEST(GraphicsSun, UnderARoofTheLampShines) {
  Stage stage(320, 180, with_full);
  stage.add(quad({0, 0, 3}, x_axis * 9, y_axis * 9));
  stage.add(quad({0, 0, 0}, x_axis * 9, y_axis * 9));
  graphics::Sun sun(stage.frame, *stage.scene);
  stage.look({0, 0, 1.6}, {0, 1, 1.3});
  const int outdoors = at(*stage.picture(), 160, 20).sum();
  sun.set_outdoors(0.0);
  const int indoors = at(*stage.picture(), 160, 20).sum();
  EXPECT_GT(indoors, 1.2 * outdoors);
  sun.set_outdoors(0.5);
  const int between = at(*stage.picture(), 160, 20).sum();
  EXPECT_GT(between, outdoors);
  EXPECT_LT(between, indoors);
}

}  // namespace
}  // namespace roam::test
