// Matrices, home, placements: what osgGA expects of a manipulator of a camera.
#include <algorithm>
#include <glm/geometric.hpp>
#include <numbers>
#include <osg/ApplicationUsage>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <osgGA/FlightManipulator>
#include <osgGA/KeySwitchMatrixManipulator>
#include <osgGA/TrackballManipulator>

#include "osg_rig.h"

namespace {

using namespace scenes;
using rig::Rig;

/// A room of 10 m by 10 m by 3 m with its middle at the origin of the floor.
Mesh room() {
  Mesh m;
  add_box(m, {-5.0, -5.0, 0.0}, {5.0, 5.0, 3.0});
  return m;
}

/// How far the camera is from any triangle.
double eye_distance(const Rig& r, const Mesh& mesh) {
  return Judge(mesh).distance({0.0, 0.0}, r.manipulator->eye(), 100.0);
}

/// The matrix of a camera at `eye` that has `center` in its middle.
osg::Matrixd camera_at(const osg::Vec3d& eye, const osg::Vec3d& center, const osg::Vec3d& up = osg::Vec3d(0, 0, 1)) {
  return osg::Matrixd::inverse(osg::Matrixd::lookAt(eye, center, up));
}

void expect_near(const osg::Vec3d& a, const osg::Vec3d& b, double tolerance) {
  EXPECT_LE((a - b).length(), tolerance) << a.x() << " " << a.y() << " " << a.z() << " and " << b.x() << " " << b.y()
                                         << " " << b.z();
}

TEST(ManipulatorPose, AMatrixThatWasSetIsTheMatrixThatIsGot) {
  Rig r;
  Random random(1);
  for (int i = 0; i < 1000; ++i) {
    const osg::Vec3d eye(random.between(-1e6, 1e6), random.between(-1e6, 1e6), random.between(-1e3, 1e3));
    const osg::Vec3d way(random.between(-1, 1), random.between(-1, 1), random.between(-1, 1));
    const osg::Matrixd camera = camera_at(eye, eye + way);
    i % 2 ? r->setByMatrix(camera) : r->setByInverseMatrix(osg::Matrixd::inverse(camera));
    expect_near(rig::eye_of(r->getMatrix()), eye, 1e-6);
    expect_near(rig::look_of(r->getMatrix()), rig::look_of(camera), 1e-9);
    expect_near(rig::up_of(r->getMatrix()), rig::up_of(camera), 1e-9);
    const osg::Matrixd product = r->getMatrix() * r->getInverseMatrix();
    expect_near(product.getTrans(), osg::Vec3d(), 1e-6);
    osg::ref_ptr<osg::Camera> viewed = new osg::Camera;
    r->updateCamera(*viewed);
    EXPECT_TRUE(viewed->getViewMatrix() == r->getInverseMatrix());
  }
}

TEST(ManipulatorPose, RollIsDropped) {
  Rig r;
  const osg::Matrixd level = camera_at({1, 2, 3}, {4, 6, 2});
  r->setByMatrix(osg::Matrixd::rotate(0.7, 0, 0, 1) * level);
  expect_near(rig::look_of(r->getMatrix()), rig::look_of(level), 1e-12);
  expect_near(rig::up_of(r->getMatrix()), rig::up_of(level), 1e-12);
}

TEST(ManipulatorPose, LookingStraightDownOrUpKeepsWhatIsUpInThePicture) {
  Rig r;
  for (const double z : {-1.0, 1.0}) {
    for (const osg::Vec3d& up : {osg::Vec3d(1, 0, 0), osg::Vec3d(0, -1, 0), osg::Vec3d(0.6, 0.8, 0)}) {
      const osg::Matrixd camera = camera_at({1, 2, 3}, {1, 2, 3 + z}, up);
      r->setByMatrix(camera);
      expect_near(rig::look_of(r->getMatrix()), {0, 0, z}, 1e-9);
      expect_near(rig::up_of(r->getMatrix()), up, 1e-9);
    }
  }
}

TEST(ManipulatorPose, YawAndPitchAreAsTheHeaderSays) {
  Rig r;
  r->setPose({1.0, 2.0, 3.0}, 0.0, 0.0);
  expect_near(rig::look_of(r->getMatrix()), {1, 0, 0}, 1e-12);
  r->look(0.5 * std::numbers::pi, 0.0);
  expect_near(rig::look_of(r->getMatrix()), {0, 1, 0}, 1e-12);
  r->look(0.0, 10.0);  // no farther than straight up
  expect_near(rig::look_of(r->getMatrix()), {0, 0, 1}, 1e-12);
  EXPECT_THROW(r->setPose({NAN, 0.0, 0.0}, 0.0, 0.0), roam::Error);
  EXPECT_THROW(r->look(0.0, INFINITY), roam::Error);
}

TEST(ManipulatorPose, IsRefusedOutsideAllSpace) {
  Rig r(room(), {}, roam::Mode::ghost);
  r->setPose({0.0, 0.0, 2.0}, 0.0, 0.0);
  for (const Vec3& far : {Vec3(2e9, 0.0, 2.0), Vec3(0.0, 0.0, 1e200)}) {
    EXPECT_THROW(r->setPose(far, 0.0, 0.0), roam::Error);
    EXPECT_THROW(r->setFeet(2.0 * far, 0.0, 0.0), roam::Error);
    r->setByMatrix(camera_at(osg::Vec3d(far.x, far.y, far.z), osg::Vec3d()));
    EXPECT_EQ(r->eye(), Vec3(0.0, 0.0, 2.0));
  }
  EXPECT_EQ(r->problem(), "");
}

TEST(ManipulatorPose, FeetUnderALowCeilingCrouchThere) {
  Mesh m = floor_mesh();
  scenes::add_floor(m, -10.0, -10.0, 10.0, 10.0, 1.3);
  Rig r(m, {}, roam::Mode::walk);
  r->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
  EXPECT_TRUE(r->walker()->crouched());
  EXPECT_NEAR(r->walker()->feet().z, 0.0, near_ground);
}

TEST(ManipulatorPose, AMatrixThatIsNoCameraChangesNothing) {
  Rig r(room(), {}, roam::Mode::fly);
  r->setPose({0.0, 0.0, 2.0}, 0.0, 0.0);
  const osg::Matrixd before = r->getMatrix();
  osg::Matrixd bad = before;
  bad(3, 1) = NAN;
  r->setByMatrix(bad);
  r->setByMatrix(osg::Matrixd(0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_TRUE(r->getMatrix() == before);
}

TEST(ManipulatorPose, TheGraphIsTheSceneMinusTheOrigin) {
  Mesh m = room();
  const Vec3 far(4.5e6, 5.1e6, 300.0);
  shift(m, far);
  Rig r;
  r->setOrigin({far.x, far.y, far.z});
  r->setSpace(std::make_shared<const roam::World>(build(m)));
  r->setPose(far + Vec3(1.0, -2.0, 2.0), 0.0, 0.0);
  expect_near(rig::eye_of(r->getMatrix()), {1, -2, 2}, 1e-9);
  EXPECT_FALSE(r->held());
  r->setByMatrix(osg::Matrixd::translate(2, 0, 2));
  EXPECT_NEAR(r->eye().x, far.x + 2.0, 1e-9);
  // A home position is told in the graph's frame, and stays where it is in the scene.
  r->setHomePosition({1, 1, 2}, {3, 1, 2}, {0, 0, 1});
  r->setOrigin({far.x + 1.0, far.y, far.z});
  r->home(0.0);
  EXPECT_NEAR(r->eye().x, far.x + 1.0, 1e-9);
  expect_near(rig::eye_of(r->getMatrix()), {0, 1, 2}, 1e-9);
}

TEST(ManipulatorPose, ACameraInAWallGoesToTheNearestSafePlace) {
  const Mesh m = room();
  for (const roam::Mode mode : {roam::Mode::fly, roam::Mode::walk}) {
    Rig r(m, {}, mode);
    Random random(2);
    for (int i = 0; i < 300; ++i) {
      const osg::Vec3d eye(random.between(-5.2, 5.2), random.between(-5.2, 5.2), random.between(-0.2, 3.2));
      r->setByMatrix(osg::Matrixd::translate(eye));
      ASSERT_FALSE(r->held());
      const roam::Walker& w = *r->walker();
      EXPECT_GE(Judge(m).distance(w.body(), w.position(), 1.0), w.settings().radius - 1e-6);
      EXPECT_GE(eye_distance(r, m), r->leastEyeDistance() - 1e-6);
      // Where a walking body would fall out of the scene, it stands on the nearest floor that it finds instead.
      EXPECT_LE(glm::length(r->eye() - Vec3(eye.x(), eye.y(), eye.z())), mode == roam::Mode::walk ? 9.0 : 4.0);
      if (eye.x() > -4.6 && eye.x() < 4.6 && eye.y() > -4.6 && eye.y() < 4.6 && eye.z() > 0.0 && eye.z() < 3.0) {
        // Its eye was free in the room: it stays in the room.
        EXPECT_LT(std::max(std::abs(w.position().x), std::abs(w.position().y)), 5.0);
      }
    }
  }
}

TEST(ManipulatorPose, ACameraDeepInACloggedPlaceIsFreedAllTheSame) {
  // Walls every 0.3 m over 12 m: no checked way leads out of them.
  Mesh m;
  for (int i = 0; i <= 40; ++i) add_wall(m, -6.0 + 0.3 * i, -6.0, -6.0 + 0.3 * i, 6.0, -6.0, 6.0);
  Rig r(m, {}, roam::Mode::fly);
  r->setByMatrix(osg::Matrixd::translate(0.1, 0.2, 0.3));
  EXPECT_FALSE(r->held());
  const roam::Walker& w = *r->walker();
  EXPECT_GE(Judge(m).distance(w.body(), w.position(), 1.0), w.settings().radius - 1e-6);
  EXPECT_LT(glm::length(w.position()), 12.0);
}

TEST(ManipulatorPose, SettingsAreCheckedWhenTheyAreSet) {
  Rig r(room(), {}, roam::Mode::walk);
  EXPECT_THROW(r->setSettings({.radius = -1.0}), roam::Error);
  EXPECT_THROW(r->setSpeed(NAN), roam::Error);
  EXPECT_THROW(osg::ref_ptr<osgRoam::Manipulator>(new osgRoam::Manipulator(nullptr, {.height = 0.1})), roam::Error);
  EXPECT_DOUBLE_EQ(r->settings().radius, 0.3);
  r->setSpeed(1e9);
  EXPECT_DOUBLE_EQ(r->speed(), osgRoam::Manipulator::greatest_speed);
  EXPECT_DOUBLE_EQ(r->settings().speed, r->speed());
  for (const double speed : {5000.0, 0.001}) {  // good for a walker, but no speed that a wheel could set
    r->setSettings({.speed = speed});
    EXPECT_DOUBLE_EQ(r->speed(), std::clamp(speed, osgRoam::Manipulator::least_speed, 1000.0));
  }
  EXPECT_THROW(r->setSettings({.radius = 0.2, .speed = 2e4}), roam::Error);
  EXPECT_DOUBLE_EQ(r->settings().radius, 0.3);
}

TEST(ManipulatorPose, OtherSettingsKeepTheFeet) {
  Rig r(room(), {}, roam::Mode::walk);
  r->setFeet({1.0, 1.0, 0.0}, 0.0, 0.0);
  r.frames(0.5);
  r->setSettings({.radius = 0.2, .height = 1.0, .eye = 0.9});
  EXPECT_NEAR(r->walker()->feet().z, 0.0, near_ground);
  EXPECT_NEAR(r->eye().z, 0.9, near_ground);
  EXPECT_DOUBLE_EQ(r->walker()->settings().radius, 0.2);
}

TEST(ManipulatorPose, HomeIsWhereItWasSet) {
  Rig r(room(), {}, roam::Mode::fly);
  r->setHomePose({1.0, 2.0, 2.0}, 0.5, -0.25);
  r->home(0.0);
  EXPECT_NEAR(glm::length(r->eye() - Vec3(1.0, 2.0, 2.0)), 0.0, 1e-9);
  EXPECT_NEAR(r->yaw(), 0.5, 1e-12);
  EXPECT_NEAR(r->pitch(), -0.25, 1e-12);
  r->setPose({-2.0, -2.0, 2.0}, 0.0, 0.0);
  r.press(rig::Adapter::KEY_Home);
  EXPECT_NEAR(glm::length(r->eye() - Vec3(1.0, 2.0, 2.0)), 0.0, 1e-9);
  EXPECT_GT(r.viewer.redraws, 0);
}

osg::ref_ptr<osg::Group> box_scene() {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->addChild(new osg::ShapeDrawable(new osg::Box(osg::Vec3(10.0f, 0.0f, -0.5f), 20.0f, 20.0f, 1.0f)));
  return group;
}

TEST(ManipulatorPose, AComputedHomeSeesTheWholeNode) {
  Rig r;
  osg::ref_ptr<osg::Group> scene = box_scene();
  r->setNode(scene);
  EXPECT_EQ(r->getNode(), scene.get());
  r->home(0.0);
  const osg::Vec3d center(scene->getBound().center());
  expect_near(rig::look_of(r->getMatrix()), {0, 1, 0}, 1e-9);
  EXPECT_GT((rig::eye_of(r->getMatrix()) - center).length(), scene->getBound().radius());
}

TEST(ManipulatorPose, ACloneIsAnotherBodyAtTheSamePlace) {
  Rig r(room(), {.radius = 0.25}, roam::Mode::fly);
  r->setPose({1.0, 2.0, 2.0}, 0.5, 0.25);
  r->controls().rebind("forward = Z");
  osg::ref_ptr<osg::Object> clone = r->clone(osg::CopyOp::SHALLOW_COPY);
  auto* copy = dynamic_cast<osgRoam::Manipulator*>(clone.get());
  ASSERT_NE(copy, nullptr);
  EXPECT_STREQ(copy->className(), "Manipulator");
  EXPECT_STREQ(copy->libraryName(), "osgRoam");
  expect_near(rig::eye_of(copy->getMatrix()), rig::eye_of(r->getMatrix()), 1e-9);
  EXPECT_DOUBLE_EQ(copy->settings().radius, 0.25);
  EXPECT_EQ(copy->controls().text(), r->controls().text());
  ASSERT_NE(copy->walker(), nullptr);
  EXPECT_NE(copy->walker(), r->walker());
  r.down('z');
  r.frames(0.5);
  EXPECT_GT((rig::eye_of(copy->getMatrix()) - rig::eye_of(r->getMatrix())).length(), 0.1);
}

TEST(ManipulatorPose, IsOneOfTheSetOfAKeySwitchManipulator) {
  const Mesh m = room();
  Rig r(m, {}, roam::Mode::fly);
  osg::ref_ptr<osgGA::KeySwitchMatrixManipulator> all = new osgGA::KeySwitchMatrixManipulator;
  osg::ref_ptr<osgGA::TrackballManipulator> trackball = new osgGA::TrackballManipulator;
  all->addMatrixManipulator('1', "Trackball", trackball);
  all->addMatrixManipulator('2', "Flight", new osgGA::FlightManipulator);
  all->addMatrixManipulator('3', "Roam", r.manipulator);
  osg::ref_ptr<osg::Group> scene = box_scene();
  all->setNode(scene);
  const auto hand = [&] { r.deliver(r.viewer, *all); };
  const auto press = [&](int key) {
    r.queue->keyPress(key, r.time, key);
    r.queue->keyRelease(key, r.time, key);
    hand();
  };
  all->selectMatrixManipulator(0);

  // A camera of another one that is in a wall comes to a safe place, looking the same way.
  const osg::Matrixd in_wall = camera_at({4.9, 1.0, 1.5}, {0.0, 1.0, 1.0});
  trackball->setByMatrix(in_wall);
  press('3');
  EXPECT_EQ(all->getCurrentMatrixManipulator(), r.manipulator.get());
  EXPECT_FALSE(r->held());
  EXPECT_GE(eye_distance(r, m), r->leastEyeDistance() - 1e-6);
  expect_near(rig::look_of(all->getMatrix()), rig::look_of(in_wall), 1e-6);

  // Keys go to ours, and what was down when another one took over is not down when ours comes back.
  const auto frames = [&](double seconds) {
    for (double t = 0.0; t < seconds; t += frame) {
      r.time += frame;
      r.queue->frame(r.time);
      hand();
    }
  };
  frames(0.1);
  const double before = r->eye().x;
  r.queue->keyPress('w', r.time, 'w');
  hand();
  frames(0.5);
  EXPECT_LT(r->eye().x, before - 0.3);
  press('1');
  expect_near(rig::eye_of(all->getMatrix()), rig::eye_of(r->getMatrix()), 1e-6);
  r.queue->keyRelease('w', r.time, 'w');
  hand();
  frames(2.0);
  press('3');
  const Vec3 still = r->eye();
  frames(1.0);
  EXPECT_LT(glm::length(r->eye() - still), 1e-9);

  osg::ref_ptr<osg::ApplicationUsage> usage = new osg::ApplicationUsage;
  all->getUsage(*usage);
  EXPECT_EQ(usage->getKeyboardMouseBindings().count("3"), 1u);
  EXPECT_EQ(usage->getKeyboardMouseBindings().count("W, Up "), 1u);
}

TEST(ManipulatorPose, PlacementsAreToldToTheStepCallback) {
  Rig r;
  int placements = 0;
  Vec3 last(0.0);
  r->setStepCallback([&](const roam::StepReport& report, double seconds) {
    if (seconds == 0.0) {
      ++placements;
      last = report.to;
    }
  });
  r->setSpace(std::make_shared<const roam::World>(build(room())));
  EXPECT_EQ(placements, 1);
  r->setPose({1.0, 1.0, 2.0}, 0.0, 0.0);
  EXPECT_EQ(placements, 2);
  EXPECT_DOUBLE_EQ(last.x, 1.0);
  r->setMode(roam::Mode::walk);
  EXPECT_EQ(placements, 3);
  r->setSettings({.radius = 0.2});
  EXPECT_EQ(placements, 4);
}

}  // namespace
