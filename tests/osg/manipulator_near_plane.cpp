// The near plane that OpenSceneGraph computes: before the walls, in scenes of any size.
#include <osg/Geometry>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osgGA/TrackballManipulator>
#include <osgUtil/CullVisitor>
#include <osgUtil/RenderStage>
#include <osgUtil/StateGraph>

#include "osg_rig.h"

namespace {

using namespace scenes;
using rig::Rig;

/// The projection with which a viewer's cull would draw the scene.
osg::Matrixd computed_projection(const osg::Camera& camera, osg::Node& scene) {
  const osg::ref_ptr<osgUtil::CullVisitor> cull = osgUtil::CullVisitor::create();
  cull->inheritCullSettings(camera);
  const osg::ref_ptr<osgUtil::StateGraph> states = new osgUtil::StateGraph;
  const osg::ref_ptr<osgUtil::RenderStage> stage = new osgUtil::RenderStage;
  cull->setStateGraph(states);
  cull->setRenderStage(stage);
  const osg::ref_ptr<osg::RefMatrix> projection = new osg::RefMatrix(camera.getProjectionMatrix());
  const osg::ref_ptr<osg::Viewport> viewport = new osg::Viewport(0, 0, 800, 600);
  cull->pushViewport(viewport);
  cull->pushProjectionMatrix(projection);
  const osg::ref_ptr<osg::RefMatrix> view = new osg::RefMatrix(camera.getViewMatrix());
  cull->pushModelViewMatrix(view, osg::Transform::ABSOLUTE_RF);
  scene.accept(*cull);
  cull->popModelViewMatrix();
  cull->popProjectionMatrix();
  return *projection;
}

struct NearAndFar {
  double near = 0.0, far = 0.0;
};

NearAndFar computed(const osg::Camera& camera, osg::Node& scene) {
  double left, right, bottom, top;
  NearAndFar planes;
  EXPECT_TRUE(computed_projection(camera, scene).getFrustum(left, right, bottom, top, planes.near, planes.far));
  return planes;
}

/// A plain of 4 km by 4 km with a wall on it, drawn and to collide with, and a body before the wall.
struct Plain {
  Rig r;
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  osg::ref_ptr<osg::Camera> camera = new osg::Camera;

  Plain() {
    Mesh m;
    add_floor(m, -2000.0, -2000.0, 2000.0, 2000.0, 0.0);
    add_box(m, {0.0, -5.0, 0.0}, {1.0, 5.0, 4.0});
    r->setSpace(std::make_shared<const roam::World>(build(m)));
    // One drawable that the body is inside the bounds of, as in every scene that was not cut into pieces.
    osg::ref_ptr<osg::CompositeShape> shape = new osg::CompositeShape;
    shape->addChild(new osg::Box(osg::Vec3(0.0f, 0.0f, -0.5f), 4000.0f, 4000.0f, 1.0f));
    shape->addChild(new osg::Box(osg::Vec3(0.5f, 0.0f, 2.0f), 1.0f, 10.0f, 4.0f));
    scene->addChild(new osg::ShapeDrawable(shape));
    camera->setProjectionMatrixAsPerspective(60.0, 800.0 / 600.0, 1.0, 1000.0);
    // Put into the wall, it comes to rest in touch with it.
    r->setPose({-0.1, 0.0, 2.0}, 0.0, 0.0);
    EXPECT_NEAR(r->eye().x, -0.3, 0.01);
  }

  /// The distance along the way of looking of what is nearest in the picture: the wall, seen aslant, in a corner.
  [[nodiscard]] double limit() const {
    const osg::Matrixd p = camera->getProjectionMatrix();
    return r->leastEyeDistance() / std::sqrt(1.0 + std::pow(1.0 / p(0, 0), 2) + std::pow(1.0 / p(1, 1), 2));
  }
  NearAndFar planes() {
    r->updateCamera(*camera);
    return computed(*camera, *scene);
  }
};

TEST(ManipulatorNearPlane, StaysBeforeTheWallThatTheBodyTouchesInALargeScene) {
  Plain p;
  p.r->setAdjustNearFarRatio(false);
  EXPECT_FALSE(p.r->adjustNearFarRatio());
  EXPECT_GT(p.planes().near, 1.0) << "OpenSceneGraph alone cuts the wall";
  p.r->setAdjustNearFarRatio(true);
  for (const double yaw : {0.0, 0.3, 0.6, -1.0}) {
    p.r->look(yaw, 0.0);
    const NearAndFar planes = p.planes();
    EXPECT_LE(planes.near, p.limit());
    EXPECT_GT(planes.near, 0.98 * p.limit()) << "no nearer than needed";
    EXPECT_GT(planes.far, 1000.0);
  }
}

TEST(ManipulatorNearPlane, IsAsNearAsThePictureNeedsWhateverItsWidth) {
  Plain p;
  for (const double degrees : {20.0, 60.0, 120.0}) {
    p.camera->setProjectionMatrixAsPerspective(degrees, 800.0 / 600.0, 1.0, 1000.0);
    const NearAndFar planes = p.planes();
    EXPECT_LE(planes.near, p.limit()) << degrees;
    EXPECT_GT(planes.near, 0.98 * p.limit()) << degrees;
  }
  // The picture of one of several screens side by side, which does not look at its own middle.
  p.camera->setProjectionMatrixAsFrustum(0.5, 1.5, -0.4, 0.4, 1.0, 1000.0);
  const double corner = p.r->leastEyeDistance() / std::sqrt(1.0 + 1.5 * 1.5 + 0.4 * 0.4);
  const NearAndFar planes = p.planes();
  EXPECT_LE(planes.near, corner);
  EXPECT_GT(planes.near, 0.98 * corner);
}

TEST(ManipulatorNearPlane, KeepsTheCamerasOwnRatioWhereThatCutsNothing) {
  Plain p;
  osg::ref_ptr<osg::Node> small = new osg::ShapeDrawable(new osg::Box(osg::Vec3(0.0f, 0.0f, 2.0f), 40.0f));
  for (const double ratio : {0.0005, 0.001}) {
    p.camera->setNearFarRatio(ratio);
    p.r->updateCamera(*p.camera);
    const NearAndFar kept = computed(*p.camera, *small);
    p.r->setAdjustNearFarRatio(false);
    p.r->updateCamera(*p.camera);
    const NearAndFar own = computed(*p.camera, *small);
    p.r->setAdjustNearFarRatio(true);
    EXPECT_DOUBLE_EQ(kept.near, own.near);
    EXPECT_DOUBLE_EQ(kept.far, own.far);
    EXPECT_EQ(p.camera->getNearFarRatio(), ratio);
  }
}

TEST(ManipulatorNearPlane, IsTheOtherManipulatorsAffairWhenThatMovesTheCamera) {
  Plain p;
  const double ours = p.planes().near;
  osg::ref_ptr<osgGA::TrackballManipulator> trackball = new osgGA::TrackballManipulator;
  trackball->setNode(p.scene);
  trackball->setByMatrix(p.r->getMatrix());
  trackball->setDistance(10.0);
  trackball->setCenter({-1.0, 0.0, 2.5});
  trackball->updateCamera(*p.camera);
  const NearAndFar theirs = computed(*p.camera, *p.scene);
  osg::ref_ptr<osg::Camera> untouched = new osg::Camera;
  untouched->setProjectionMatrix(p.camera->getProjectionMatrix());
  trackball->updateCamera(*untouched);
  EXPECT_DOUBLE_EQ(theirs.near, computed(*untouched, *p.scene).near);
  EXPECT_GT(theirs.near, 1.0);
  EXPECT_DOUBLE_EQ(p.planes().near, ours);  // and ours again
}

TEST(ManipulatorNearPlane, LeavesAloneWhatSomebodyElseComputes) {
  struct Theirs : osg::CullSettings::ClampProjectionMatrixCallback {
    bool clampProjectionMatrixImplementation(osg::Matrixf&, double&, double&) const override { return false; }
    bool clampProjectionMatrixImplementation(osg::Matrixd&, double&, double&) const override { return false; }
  };
  Plain p;
  const osg::ref_ptr<Theirs> theirs = new Theirs;
  p.camera->setClampProjectionMatrixCallback(theirs);
  for (const bool on : {true, false}) {
    p.r->setAdjustNearFarRatio(on);
    p.r->updateCamera(*p.camera);
    EXPECT_EQ(p.camera->getClampProjectionMatrixCallback(), theirs.get());
  }
  p.camera->setClampProjectionMatrixCallback(nullptr);
  p.r->setAdjustNearFarRatio(true);
  p.camera->setComputeNearFarMode(osg::CullSettings::DO_NOT_COMPUTE_NEAR_FAR);
  p.r->updateCamera(*p.camera);
  EXPECT_EQ(p.camera->getClampProjectionMatrixCallback(), nullptr);
  p.camera->setComputeNearFarMode(osg::CullSettings::COMPUTE_NEAR_FAR_USING_PRIMITIVES);
  p.r->updateCamera(*p.camera);
  EXPECT_NE(p.camera->getClampProjectionMatrixCallback(), nullptr);
  p.r->setAdjustNearFarRatio(false);
  p.r->updateCamera(*p.camera);
  EXPECT_EQ(p.camera->getClampProjectionMatrixCallback(), nullptr);
}

TEST(ManipulatorNearPlane, OfACameraWithoutPerspectiveIsOpenSceneGraphs) {
  Plain p;
  p.camera->setProjectionMatrixAsOrtho(-10.0, 10.0, -8.0, 8.0, 1.0, 1000.0);
  p.r->updateCamera(*p.camera);
  const osg::Matrixd on = computed_projection(*p.camera, *p.scene);
  p.r->setAdjustNearFarRatio(false);
  p.r->updateCamera(*p.camera);
  EXPECT_TRUE(on == computed_projection(*p.camera, *p.scene));
}

}  // namespace
