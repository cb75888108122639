// osgRoam in a viewer with all of osgviewer's own handlers and cameras.
#include <algorithm>
#include <osgGA/DriveManipulator>
#include <osgGA/FlightManipulator>
#include <osgGA/OrbitManipulator>
#include <osgGA/StateSetManipulator>
#include <osgGA/TerrainManipulator>
#include <osgViewer/CompositeViewer>
#include <osgViewer/ViewerEventHandlers>
#include <sstream>

#include "osgRoam/StatusHandler.h"
#include "osg_window.h"

namespace {

using namespace osg_window;

/// The cameras of osgviewer with ours on 1, and its handlers after StatusHandler.
struct Osgviewer {
  osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> cameras = new osgGA::KeySwitchMatrixManipulator;
  Window w{osgViewer::ViewerBase::SingleThreaded, cameras};
  osg::ref_ptr<osgRoam::StatusHandler> status = new osgRoam::StatusHandler(w.manipulator);
  osg::ref_ptr<osgGA::StateSetManipulator> states =
      new osgGA::StateSetManipulator(w.viewer.getCamera()->getOrCreateStateSet());

  Osgviewer() {
    cameras->addMatrixManipulator('3', "Flight", new osgGA::FlightManipulator);
    cameras->addMatrixManipulator('4', "Drive", new osgGA::DriveManipulator);
    cameras->addMatrixManipulator('5', "Terrain", new osgGA::TerrainManipulator);
    cameras->addMatrixManipulator('6', "Orbit", new osgGA::OrbitManipulator);
    w.viewer.addEventHandler(status);
    w.viewer.addEventHandler(states);
    w.viewer.addEventHandler(new osgViewer::ThreadingHandler);
    w.viewer.addEventHandler(new osgViewer::WindowSizeHandler);
    w.viewer.addEventHandler(new osgViewer::StatsHandler);
    w.viewer.addEventHandler(new osgViewer::HelpHandler);
    w.viewer.addEventHandler(new osgViewer::RecordCameraPathHandler);
    w.viewer.addEventHandler(new osgViewer::LODScaleHandler);
    w.viewer.addEventHandler(new osgViewer::ScreenCaptureHandler);
    w.run(0.2);
  }
  [[nodiscard]] bool wires() const { return states->getPolygonMode() != osg::PolygonMode::FILL; }
  [[nodiscard]] Vec3 at() const { return w.at(); }
};

TEST(StatusHandler, KeepsTheKeysOfTheBodyFromTheHandlersOfOsgviewer) {
  Osgviewer o;
  xdo("keydown w");
  EXPECT_TRUE(o.w.until([&] { return o.at().x > 0.5; }));
  xdo("keyup w keydown s");
  EXPECT_TRUE(o.w.until([&] { return o.at().x < 0.2; }));
  xdo("keyup s keydown e");  // ThreadingHandler's
  o.w.run(0.3);
  xdo("keyup e");
  EXPECT_FALSE(o.wires());
  EXPECT_EQ(o.w.viewer.getThreadingModel(), osgViewer::ViewerBase::SingleThreaded);
  // A key that the body has no use for.
  xdo("key l");
  EXPECT_TRUE(o.w.until([&] { return !o.states->getLightingEnabled(); }));
}

TEST(StatusHandler, LeavesAllKeysToTheOthersWithAnotherCamera) {
  Osgviewer o;
  xdo("key 2");
  EXPECT_TRUE(o.w.until([&] { return o.cameras->getCurrentMatrixManipulator() != o.w.manipulator.get(); }));
  const Vec3 before = o.at();
  xdo("key w");
  EXPECT_TRUE(o.w.until([&] { return o.wires(); }));
  EXPECT_EQ(o.at(), before);
  EXPECT_EQ(o.status->text(), "");
}

TEST(StatusHandler, ShowsWhatTheBodyDoesAndWhyItIsHeld) {
  Osgviewer o;
  EXPECT_EQ(o.status->text(), "walk, 1.4 m/s");
  xdo("key g");
  EXPECT_TRUE(o.w.until([&] { return o.status->text() == "fly, 1.4 m/s"; })) << o.status->text();
  std::ostringstream said;
  struct Into : osg::NotifyHandler {
    explicit Into(std::ostringstream& stream) : to(stream) {}
    void notify(osg::NotifySeverity, const char* message) override { to << message; }
    std::ostringstream& to;
  };
  const osg::ref_ptr<osg::NotifyHandler> before = osg::getNotifyHandler();
  osg::setNotifyHandler(new Into(said));
  o.w.manipulator->setSpace(nullptr);
  EXPECT_TRUE(o.w.until([&] { return !said.str().empty(); }));
  o.w.run(1.5);
  osg::setNotifyHandler(before);
  EXPECT_EQ(o.status->text(), "held: no space to move in has been set");
  EXPECT_EQ(said.str(), "osgRoam: held: no space to move in has been set\n");
}

TEST(StatusHandler, ShowsItInAViewOfACompositeViewerToo) {
  Window w;
  const osg::ref_ptr<osgRoam::Manipulator> manipulator = new osgRoam::Manipulator;
  const osg::ref_ptr<osgRoam::StatusHandler> status = new osgRoam::StatusHandler(manipulator);
  const osg::ref_ptr<osgViewer::View> view = new osgViewer::View;
  view->setCameraManipulator(manipulator);
  osgViewer::CompositeViewer viewer;
  viewer.addView(view);
  const osg::ref_ptr<Adapter> event = new Adapter;
  event->setEventType(Adapter::FRAME);
  status->handle(*event, *view);
  EXPECT_EQ(status->text(), "held: no space to move in has been set");
  // In the right half of a window.
  osg::GraphicsContext* context = w.viewer.getCamera()->getGraphicsContext();
  view->getCamera()->setGraphicsContext(context);
  view->getCamera()->setViewport(400, 0, 400, 600);
  status->handle(*event, *view);
  const auto& cameras = context->getCameras();
  const auto shown = std::find_if(cameras.begin(), cameras.end(),
                                  [](const osg::Camera* one) { return one->getName() == "osgRoam status"; });
  ASSERT_NE(shown, cameras.end());
  EXPECT_EQ((*shown)->getViewport()->x(), 400.0);
  view->getCamera()->setGraphicsContext(nullptr);
}

TEST(StatusHandler, SaysThatTheBodyIsHeldOverNothing) {
  Osgviewer o;
  o.w.manipulator->setFeet(Vec3(2000, 0, 1), 0, 0);  // far beyond the floor
  const std::string expected = "held: there is nothing below to stand on; G flies; Home goes to the start";
  EXPECT_TRUE(o.w.until([&] { return o.status->text() == expected; })) << o.status->text();
}

TEST(StatusHandler, IsDrawnOverThePicture) {
  Osgviewer o;
  const auto white = [&] {
    osg::ref_ptr<osg::Image> seen = new osg::Image;
    struct Read : osg::Camera::DrawCallback {
      explicit Read(osg::Image& image) : to(image) {}
      void operator()(osg::RenderInfo&) const override { to.readPixels(0, 0, 300, 60, GL_RGB, GL_UNSIGNED_BYTE); }
      osg::Image& to;
    };
    osgViewer::ViewerBase::Contexts contexts;
    o.w.viewer.getContexts(contexts);
    for (osg::Camera* camera : contexts.front()->getCameras()) {
      if (camera->getRenderOrder() == osg::Camera::POST_RENDER) camera->setFinalDrawCallback(new Read(*seen));
    }
    o.w.run(0.2);
    int count = 0;
    for (unsigned i = 0; seen->data() != nullptr && i < 300u * 60u; ++i) {
      const unsigned char* p = seen->data() + 3 * static_cast<std::size_t>(i);
      count += p[0] > 120 && p[1] > 120 && p[2] > 120;
    }
    return count;
  };
  o.w.viewer.getCamera()->setClearColor(osg::Vec4(0.2f, 0.3f, 0.4f, 1));
  EXPECT_GT(white(), 50);
}

TEST(StatusHandler, ABodyThatComesFromATrackballStandsOnAFloor) {
  Osgviewer o;
  xdo("key 2");
  EXPECT_TRUE(o.w.until([&] { return o.cameras->getCurrentMatrixManipulator() != o.w.manipulator.get(); }));
  // High in the air; and beyond the floor's edge, looking at it.
  for (const osg::Vec3d& eye : {osg::Vec3d(30, 20, 90), osg::Vec3d(-700, 0, 60)}) {
    xdo("key 2");
    o.w.run(0.2);
    o.cameras->getCurrentMatrixManipulator()->setByInverseMatrix(
        osg::Matrixd::lookAt(eye, osg::Vec3d(0, 0, 0), osg::Vec3d(0, 0, 1)));
    xdo("key 1");
    EXPECT_TRUE(o.w.until([&] { return o.cameras->getCurrentMatrixManipulator() == o.w.manipulator.get(); }));
    o.w.run(0.1);
    EXPECT_FALSE(o.w.manipulator->held());
    EXPECT_NEAR(o.at().z, 0.9, 0.01);
    EXPECT_EQ(o.w.manipulator->pitch(), 0.0);
    EXPECT_LT(std::abs(o.at().x), 500.0);
  }
}

}  // namespace
