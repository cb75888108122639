// A real window, with xdotool as the person: what X11 and OpenSceneGraph make of keys, focus, sizes and the mouse.
#include "osg_window.h"

namespace {

using namespace osg_window;

TEST(ManipulatorWindow, AKeyMovesForAsLongAsItIsDownWhateverItRepeats) {
  Window w;
  xdo("keydown w");
  EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYDOWN, 'w') > 5; }));  // repeated
  xdo("keyup w");
  EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYUP, 'w') == 1; }));
  w.run(0.1);
  const Vec3 there = w.at();
  EXPECT_NEAR(there.x, 1.4 * w.watch->seconds_down('w'), 0.01);
  EXPECT_GT(there.x, 0.5);
  w.run(0.3);
  EXPECT_EQ(w.at(), there);
}

TEST(ManipulatorWindow, ShiftAndItsLetterHurry) {
  Window w;
  xdo("keydown shift keydown w");
  EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYDOWN, 'w') > 0; }));
  w.run(0.4);
  EXPECT_TRUE(w.manipulator->down("forward") && w.manipulator->down("fast"));
  xdo("keyup shift keyup w");  // so that the letter comes up as another character than it went down
  EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYUP, 'w') == 1; }));
  w.run(0.1);
  bool capital = false;
  for (const Watch::Moment& m : w.watch->moments) capital |= m.type == Adapter::KEYDOWN && m.key == 'W';
  EXPECT_TRUE(capital);
  EXPECT_NEAR(w.at().x, 7.0 * w.watch->seconds_down('w'), 0.25);
  EXPECT_FALSE(w.manipulator->down("forward"));
}

TEST(ManipulatorWindow, LosingTheFocusLetsGoOfTheKeys) {
  Window w, other;
  w.focus();
  w.run(0.2);
  xdo("keydown w");
  EXPECT_TRUE(w.until([&] { return w.at().x > 0.3; }));
  other.focus();
  EXPECT_TRUE(w.until([&] { return !w.manipulator->down("forward"); }));
  const Vec3 there = w.at();
  xdo("keyup w");  // somebody else hears that
  w.run(0.3);
  EXPECT_EQ(w.at(), there);
  w.focus();
  w.run(0.3);
  EXPECT_EQ(w.at(), there);
}

TEST(ManipulatorWindow, AnotherSizeOfTheWindowIsNoticed) {
  Window w;
  xdo("search --name " + w.name + " windowsize 500 400");
  EXPECT_TRUE(w.until([&] { return w.watch->width == 500; }));
  xdo("mousemove 300 200 mousedown 1");
  w.run(0.2);
  const double yaw = w.manipulator->yaw();
  xdo("mousemove 200 200");
  w.run(0.2);
  xdo("mouseup 1 mousemove 250 220");
  w.run(0.2);
  EXPECT_NEAR(w.manipulator->yaw() - yaw, quarter * 100.0 / 400.0, 0.01);
  xdo("keydown w");
  EXPECT_TRUE(w.until([&] { return glm::length(w.at() - Vec3(0.0, 0.0, w.at().z)) > 0.3; }));
  xdo("keyup w");
}

TEST(ManipulatorWindow, TheGrabbedMouseTurnsOnAndOnAndEscapeLeavesWithoutClosing) {
  Window w;
  w.manipulator->setMouseGrab(true);
  w.run(0.3);
  double turned = 0.0, yaw = w.manipulator->yaw();
  for (int i = 0; i < 60; ++i) {
    xdo("mousemove_relative 40 0");
    w.run(0.03);
    turned -= std::remainder(w.manipulator->yaw() - yaw, 4.0 * quarter);
    yaw = w.manipulator->yaw();
  }
  EXPECT_NEAR(turned, 2400.0 * quarter / 600.0, 0.1);  // three windows wide
  EXPECT_NEAR(w.manipulator->pitch(), 0.0, 0.02);

  xdo("key Escape");
  EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYUP, Adapter::KEY_Escape) == 1; }));
  w.run(0.1);
  EXPECT_FALSE(w.manipulator->mouseGrab());
  EXPECT_FALSE(w.viewer.done());
  yaw = w.manipulator->yaw();
  xdo("mousemove_relative 40 0");
  w.run(0.1);
  EXPECT_EQ(w.manipulator->yaw(), yaw);
  xdo("key Escape");  // now it is the viewer's again
  EXPECT_TRUE(w.until([&] { return w.viewer.done(); }));
}

TEST(ManipulatorWindow, DoubleClickAndWheelArrive) {
  Window w;
  w.manipulator->look(0.0, -0.4);
  w.run(0.1);
  xdo("mousemove 520 420 click --repeat 2 --delay 50 1");
  EXPECT_TRUE(w.until([&] { return w.manipulator->going() || glm::length(w.at() - Vec3(0, 0, w.at().z)) > 1.0; }));
  EXPECT_TRUE(w.until([&] { return !w.manipulator->going(); }));
  EXPECT_GT(w.at().x, 1.0);
  EXPECT_LT(w.at().y, -0.1);
  xdo("click 4");
  EXPECT_TRUE(w.until([&] { return w.manipulator->speed() > 1.5; }));
}

TEST(ManipulatorWindow, AViewerThatDrawsOnDemandRestsWhenTheBodyDoes) {
  Window w;
  w.viewer.setRunFrameScheme(osgViewer::ViewerBase::ON_DEMAND);
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly, roam::Mode::ghost}) {
    w.manipulator->setMode(mode);
    const int pressed = w.watch->count(Adapter::KEYDOWN, 'w'), let_go = w.watch->count(Adapter::KEYUP, 'w');
    xdo("keydown w");
    EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYDOWN, 'w') > pressed; }));
    EXPECT_TRUE(w.viewer.checkNeedToDoFrame());
    xdo("keyup w");
    EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYUP, 'w') > let_go; }));
    EXPECT_TRUE(w.until([&] { return !w.viewer.checkNeedToDoFrame(); })) << to_string(mode);
  }
}

/// Reads the middle of each picture.
struct Middle : osg::Camera::DrawCallback {
  mutable osg::Vec4 color;
  void operator()(osg::RenderInfo&) const override {
    osg::ref_ptr<osg::Image> pixel = new osg::Image;
    pixel->readPixels(400, 300, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE);
    color = pixel->getColor(0, 0);
  }
};

TEST(ManipulatorWindow, OneSeesTheWallThatTheBodyTouchesAndNotThroughIt) {
  Window w;
  Mesh mesh;
  add_floor(mesh, -2000.0, -2000.0, 2000.0, 2000.0, 0.0);
  add_box(mesh, {0.0, -5.0, 0.0}, {0.2, 5.0, 4.0});
  osg::ref_ptr<osg::CompositeShape> shape = new osg::CompositeShape;
  shape->addChild(new osg::Box(osg::Vec3(0.0f, 0.0f, -0.5f), 4000.0f, 4000.0f, 1.0f));
  shape->addChild(new osg::Box(osg::Vec3(0.1f, 0.0f, 2.0f), 0.2f, 10.0f, 4.0f));
  osg::ref_ptr<osg::ShapeDrawable> drawn = new osg::ShapeDrawable(shape);
  drawn->setColor(osg::Vec4(1.0f, 0.0f, 0.0f, 1.0f));
  drawn->getOrCreateStateSet()->setMode(GL_LIGHTING, osg::StateAttribute::OFF);
  w.viewer.setSceneData(drawn);
  w.manipulator->setSpace(std::make_shared<const roam::World>(build(mesh)));
  w.manipulator->setPose({-0.1, 0.0, 1.6}, 0.0, 0.4);  // comes to rest in touch with the wall
  const osg::ref_ptr<Middle> middle = new Middle;
  w.viewer.getCamera()->setFinalDrawCallback(middle);
  w.run(0.1);
  EXPECT_EQ(middle->color.r(), 1.0f);
  EXPECT_EQ(middle->color.b(), 0.0f);
  w.manipulator->setAdjustNearFarRatio(false);
  w.run(0.1);
  EXPECT_GT(middle->color.b(), 0.2f) << "the sky behind the wall, without that";
}

class Threads : public testing::TestWithParam<osgViewer::ViewerBase::ThreadingModel> {};
INSTANTIATE_TEST_SUITE_P(ManipulatorWindow, Threads,
                         testing::Values(osgViewer::ViewerBase::SingleThreaded,
                                         osgViewer::ViewerBase::CullDrawThreadPerContext,
                                         osgViewer::ViewerBase::DrawThreadPerContext,
                                         osgViewer::ViewerBase::CullThreadPerCameraDrawThreadPerContext));

TEST_P(Threads, WalksAndSwitchesWithTheOthersOfTheSet) {
  osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> set = new osgGA::KeySwitchMatrixManipulator;
  Window w(GetParam(), set);
  xdo("keydown w");
  EXPECT_TRUE(w.until([&] { return w.at().x > 0.5; }));
  xdo("keyup w");
  EXPECT_TRUE(w.until([&] { return w.watch->count(Adapter::KEYUP, 'w') == 1; }));
  w.run(0.1);
  const osg::Vec3d eye = w.viewer.getCamera()->getInverseViewMatrix().getTrans();
  EXPECT_NEAR(eye.x(), w.at().x, 1e-6);
  xdo("key 2");
  EXPECT_TRUE(w.until([&] { return set->getCurrentMatrixManipulator() != w.manipulator.get(); }));
  xdo("key 1");
  EXPECT_TRUE(w.until([&] { return set->getCurrentMatrixManipulator() == w.manipulator.get(); }));
  EXPECT_NEAR(w.at().x, eye.x(), 0.01);
  EXPECT_FALSE(w.manipulator->held());
}

}  // namespace
