// Depth, size and threads of the picture.

#include <atomic>
#include <chrono>
#include <future>
#include <osg/MatrixTransform>
#include <osg/observer_ptr>
#include <thread>

#include "graphics_stage.h"

namespace roam::test {
namespace {

using graphics::FrameSettings;

const osg::Vec4 red(1, 0, 0, 1), blue(0, 0, 1, 1), white(1, 1, 1, 1);

bool reddish(const Pixel& p) { return p.r > p.b + 40; }

int count_red(const osg::Image& image) {
  int count = 0;
  for (int y = 0; y < image.t(); ++y) {
    for (int x = 0; x < image.s(); ++x) count += reddish(at(image, x, y));
  }
  return count;
}

TEST(GraphicsFrame, KeepsNothingInMemoryWhenItIsGone) {
  osg::observer_ptr<osg::Camera> camera;
  osg::observer_ptr<osg::Group> scene;
  osg::observer_ptr<osg::Node> wall;
  {
    Stage stage;
    const osg::ref_ptr<osg::Node> added = paint(quad({0, 1, 0}, x_axis, z_axis), red);
    stage.add(added);
    (void)stage.picture();
    camera = stage.viewer.getCamera();
    scene = stage.frame.root();
    wall = added;
    ASSERT_TRUE(camera.valid() && scene.valid() && wall.valid());
  }
  EXPECT_FALSE(camera.valid());
  EXPECT_FALSE(scene.valid());
  EXPECT_FALSE(wall.valid());
}

TEST(GraphicsFrame, AWallBeforeTheNoseIsNotCut) {
  Stage stage;
  stage.add(paint(quad({0, 0.06, 0}, x_axis, z_axis), red));
  const auto picture = stage.picture();
  EXPECT_EQ(count_red(*picture), picture->s() * picture->t());
  stage.frame.set_near(0.07);
  EXPECT_EQ(count_red(*stage.picture()), 0);
}

TEST(GraphicsFrame, NearLimitIsTheLargestThatCutsNoWallInAnyDirection) {
  // The worst wall is square to the line of sight through a corner of the picture.
  const double radius = 0.5, aspect = 320.0 / 180.0;
  Stage stage;
  const osg::Camera& camera = *stage.viewer.getCamera();
  const osg::Matrixd& seen = camera.getProjectionMatrix();
  osg::Vec3d out = osg::Matrixd::transform3x3(osg::Vec3d(1.0 / seen(0, 0), 1.0 / seen(1, 1), -1.0),
                                              osg::Matrixd::inverse(camera.getViewMatrix()));
  out.normalize();
  osg::Vec3d u = out ^ z_axis;
  u.normalize();
  stage.add(paint(quad(out * radius, u * 9, (u ^ out) * 9), red));
  const double limit = graphics::near_limit(radius, stage.frame.vertical_fov(), aspect);
  EXPECT_NEAR(radius / limit, 1.64, 0.005);
  stage.frame.set_near(0.99 * limit);
  EXPECT_TRUE(reddish(at(*stage.picture(), 319, 179)));
  stage.frame.set_near(1.05 * limit);
  EXPECT_FALSE(reddish(at(*stage.picture(), 319, 179)));
}

/// Two walls 5 cm apart at 10 km, the red one before the blue one: the most pixels that were blue at any of the places
/// that a camera passes. In both orders of drawing: where depths are equal, the last one wins.
int most_wrong_pixels(const FrameSettings& settings) {
  const osg::Vec3d slant(std::cos(0.2), std::sin(0.2), 0), up(0, std::sin(0.1), std::cos(0.1));
  const double far = 10'000;
  int wrong = 0;
  for (const bool red_first : {true, false}) {
    Stage stage(160, 90, settings);
    const auto near_wall = paint(quad({0, far, 0}, slant * 20'000, up * 20'000), red);
    const auto far_wall = paint(quad({0, far + 0.05, 0}, slant * 20'000, up * 20'000), blue);
    stage.add(red_first ? near_wall : far_wall);
    stage.add(red_first ? far_wall : near_wall);
    for (int i = 0; i < 16; ++i) {
      stage.look({0.0137 * i, 0.0311 * i, 0.0073 * i}, {0.0137 * i, 1000.0, 0});
      const auto picture = stage.picture();
      wrong = std::max(wrong, picture->s() * picture->t() - count_red(*picture));
    }
  }
  return wrong;
}

TEST(GraphicsFrame, WallsFiveCentimetresApartAtTenKilometresDoNotFlicker) {
  EXPECT_EQ(most_wrong_pixels({.near = 0.05, .samples = 1}), 0);
  EXPECT_EQ(most_wrong_pixels({.near = 0.05, .samples = 4}), 0);
}

TEST(GraphicsFrame, AnOrdinaryDepthFlickersThereAndSaysSo) {
  EXPECT_GT(most_wrong_pixels({.near = 0.05, .samples = 1, .reversed_depth = false}), 100);
  Stage ordinary(64, 64, {.reversed_depth = false});
  EXPECT_FALSE(ordinary.frame.reversed_depth());
  EXPECT_NE(ordinary.frame.describe().find("flicker"), std::string::npos) << ordinary.frame.describe();
  Stage reversed(64, 64);
  EXPECT_TRUE(reversed.frame.reversed_depth());
  EXPECT_NE(reversed.frame.describe().find("reversed"), std::string::npos) << reversed.frame.describe();
}

TEST(GraphicsFrame, AnOrdinaryDepthShowsWhatIsNearAndKeepsTheOrder) {
  Stage stage(160, 90, {.samples = 1, .reversed_depth = false});
  stage.add(paint(quad({0, 0.06, 0}, x_axis, z_axis), red));
  stage.add(paint(quad({0, 9, 0}, x_axis * 99, z_axis * 99), blue));
  const auto picture = stage.picture();
  EXPECT_EQ(count_red(*picture), picture->s() * picture->t());
}

TEST(GraphicsFrame, AFarOriginThatIsSubtractedChangesNoPixel) {
  const auto draw = [](const osg::Vec3d& origin) {
    Stage stage;
    osg::ref_ptr<osg::MatrixTransform> subtracted = new osg::MatrixTransform(osg::Matrix::translate(-origin));
    osg::ref_ptr<osg::MatrixTransform> placed =
        new osg::MatrixTransform(osg::Matrix::rotate(0.3, z_axis) * osg::Matrix::translate(origin));
    subtracted->addChild(placed);
    for (int i = 0; i < 40; ++i) {
      const double angle = 0.7 * i;
      const osg::Vec3d centre(6 * std::cos(angle), 6 * std::sin(angle), 0.1 * i - 2);
      placed->addChild(quad(centre, {0.5 + 0.01 * i, 0.1, 0}, {0, 0.2, 0.4}));
    }
    stage.add(subtracted);
    const osg::Vec3d eye = origin + osg::Vec3d(0.25, -0.5, 0.125);
    stage.look(eye - origin, eye + osg::Vec3d(0.3, 1, 0.1) - origin);
    return stage.picture();
  };
  const auto here = draw({0, 0, 0});
  EXPECT_EQ(differing(*here, *draw({6.4e6, -3.2e6, 1.5e5})), 0);
  EXPECT_GT(differing(*here, *Stage().picture()), 1000);
}

TEST(GraphicsFrame, OnlyWhatLiesOutsideThePictureIsLeftOut) {
  struct Count : osg::Drawable::DrawCallback {
    mutable int drawn = 0;
    void drawImplementation(osg::RenderInfo& info, const osg::Drawable* drawable) const override {
      ++drawn;
      drawable->drawImplementation(info);
    }
  };
  Stage stage;
  const auto counted = [&](const osg::Vec3d& centre, double size) {
    osg::ref_ptr<Count> count = new Count;
    osg::ref_ptr<osg::Geometry> geometry = quad(centre, x_axis * size, z_axis * size);
    geometry->setDrawCallback(count);
    stage.add(geometry);
    return count;
  };
  const auto touching = counted({0, 0.051, 0}, 0.1), ahead = counted({0, 10, 0}, 1), far = counted({0, 2e5, 0}, 1e4);
  const auto behind = counted({0, -10, 0}, 1), aside = counted({40, 10, 0}, 1), above = counted({0, 10, 30}, 1);
  stage.picture();
  EXPECT_EQ(touching->drawn, 1);
  EXPECT_EQ(ahead->drawn, 1);
  EXPECT_EQ(far->drawn, 1);
  EXPECT_EQ(behind->drawn, 0);
  EXPECT_EQ(aside->drawn, 0);
  EXPECT_EQ(above->drawn, 0);
}

TEST(GraphicsFrame, ThePictureFollowsTheWindowAndKeepsItsProportions) {
  for (const graphics::Headless how : {graphics::Headless::egl, graphics::Headless::xvfb}) {
    Stage stage(320, 180, {.samples = 4}, how);
    stage.add(paint(quad({0, 4, 0}, x_axis, z_axis), red));
    stage.picture();
    for (const auto& [width, height] : {std::pair{200, 300}, std::pair{641, 359}, std::pair{64, 64}}) {
      stage.context.window->setWindowRectangle(0, 0, width, height);
      osg::ref_ptr<osg::Image> picture = stage.picture();
      // An X server answers when it likes to.
      for (int i = 0; i < 500 && picture->s() != width; ++i) {
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
        picture = stage.picture();
      }
      ASSERT_EQ(picture->s(), width) << stage.context.place;
      ASSERT_EQ(picture->t(), height) << stage.context.place;
      EXPECT_EQ(stage.frame.width(), width);
      EXPECT_EQ(stage.context.height(), height);
      int across = 0, upright = 0;
      for (int x = 0; x < width; ++x) across += reddish(at(*picture, x, height / 2));
      for (int y = 0; y < height; ++y) upright += reddish(at(*picture, width / 2, y));
      EXPECT_NEAR(upright, height / (4 * std::tan(0.5 * 65 * M_PI / 180)), 2);
      EXPECT_NEAR(across, std::min(upright, width), 2);
    }
  }
}

TEST(GraphicsFrame, SamplesSmoothEdges) {
  const auto shades = [](graphics::Quality quality) {
    Stage stage(160, 90, {.samples = 4, .quality = quality});
    stage.add(paint(quad({0, 4, 0}, {1, 0, 0.3}, {-0.3, 0, 1}), white));
    stage.add(paint(quad({0, 5, 0}, x_axis * 99, z_axis * 99), {0, 0, 0, 1}));
    const auto picture = stage.picture();
    int between = 0;
    for (int y = 0; y < 90; ++y) {
      for (int x = 0; x < 160; ++x) between += at(*picture, x, y).g > 20 && at(*picture, x, y).g < 120;
    }
    return between;
  };
  EXPECT_EQ(shades(graphics::Quality::plain), 0);
  EXPECT_GT(shades(graphics::Quality::full), 40);
}

TEST(GraphicsFrame, DrawsInAThreadOfItsOwn) {
  Stage stage;
  stage.viewer.setThreadingModel(osgViewer::Viewer::DrawThreadPerContext);
  stage.add(paint(quad({0, 4, 0}, x_axis * 9, z_axis * 9), red));
  const auto taken = std::make_shared<std::promise<int>>();
  std::atomic<std::thread::id> drawer{};
  stage.viewer.frame();
  stage.frame.request_picture(true, [&, taken](osg::ref_ptr<osg::Image> image) {
    drawer = std::this_thread::get_id();
    taken->set_value(count_red(*image));
  });
  for (int i = 0; i < 3; ++i) stage.viewer.frame();
  std::future<int> result = taken->get_future();
  ASSERT_EQ(result.wait_for(std::chrono::seconds(20)), std::future_status::ready);
  EXPECT_EQ(result.get(), 320 * 180);
  EXPECT_NE(drawer.load(), std::this_thread::get_id());
  stage.viewer.stopThreading();
}

TEST(GraphicsFrame, IsTimedWithoutWaitsForTheScreen) {
  using Clock = graphics::FrameTimes::Clock;
  static constexpr auto wait = std::chrono::milliseconds(400);
  struct SlowScreen : osg::GraphicsContext::SwapCallback {
    void swapBuffersImplementation(osg::GraphicsContext* window) override {
      std::this_thread::sleep_for(wait);
      window->swapBuffersImplementation();
    }
  };
  Stage stage(64, 64, plain, graphics::Headless::xvfb);
  stage.viewer.frame();
  stage.context.window->setSwapCallback(new SlowScreen);
  stage.frame.set_timed(true);
  const auto begin = Clock::now();
  stage.viewer.frame();
  const auto end = Clock::now();
  EXPECT_GE(end - begin, wait);
  EXPECT_GT(stage.frame.times().drawn, begin);
  EXPECT_GE(end - stage.frame.times().drawn, wait);
  const auto drawn = stage.frame.times().drawn;
  stage.frame.set_timed(false);
  stage.viewer.frame();
  EXPECT_EQ(stage.frame.times().drawn, drawn);
}

TEST(GraphicsFrame, RefusesSettingsThatDrawNothing) {
  const graphics::Context context = graphics::open_headless(64, 64);
  const auto make = [&](const FrameSettings& settings) {
    osgViewer::Viewer viewer;
    graphics::Frame(viewer, context, settings);
  };
  EXPECT_THROW(make({.near = 0}), Error);
  EXPECT_THROW(make({.near = std::nan("")}), Error);
  EXPECT_THROW(make({.vertical_fov = 179}), Error);
  EXPECT_THROW(make({.samples = -1}), Error);
}

}  // namespace
}  // namespace roam::test
