// The space that the body moves in: given, built from the graph, exchanged.
#include <glm/geometric.hpp>
#include <osg/Shape>
#include <osg/ShapeDrawable>
#include <thread>

#include "osgRoam/Triangles.h"
#include "osg_rig.h"

namespace {

using namespace scenes;
using rig::Rig;

/// A room of 10 m by 10 m by 3 m with its middle at the origin of the floor.
Mesh wide_room() {
  Mesh m;
  add_box(m, {-5.0, -5.0, 0.0}, {5.0, 5.0, 3.0});
  return m;
}

osg::ref_ptr<osg::Group> lone_box() {
  osg::ref_ptr<osg::Group> group = new osg::Group;
  group->addChild(new osg::ShapeDrawable(new osg::Box(osg::Vec3(10.0f, 0.0f, -0.5f), 20.0f, 20.0f, 1.0f)));
  return group;
}

void finish_building(Rig& r) {
  while (r->building()) {
    r.frame(frame);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
}

void expect_close(const osg::Vec3d& a, const osg::Vec3d& b, double tolerance) {
  EXPECT_LE((a - b).length(), tolerance) << a.x() << " " << a.y() << " " << a.z();
}

TEST(ManipulatorSpace, WithoutASpaceTheBodyIsHeldAndMayLook) {
  Rig r;
  EXPECT_EQ(r->walker(), nullptr);
  EXPECT_TRUE(r->held());
  r->setPose({1.0, 2.0, 3.0}, 0.0, 0.0);
  r.down('w');
  r.frames(1.0);
  expect_close(rig::eye_of(r->getMatrix()), {1, 2, 3}, 0.0);
  r.up('w');
  r.push(400, 300);
  r.mouse(300, 300);
  EXPECT_GT(r->yaw(), 0.0);
  r->setSpace(std::make_shared<const roam::World>());
  EXPECT_FALSE(r->held());
  expect_close(rig::eye_of(r->getMatrix()), {1, 2, 3}, 1e-9);
  r->setSpace(nullptr);
  EXPECT_EQ(r->walker(), nullptr);
  expect_close(rig::eye_of(r->getMatrix()), {1, 2, 3}, 1e-9);
}

TEST(ManipulatorSpace, AnotherSpaceFindsTheBodyWhereItIs) {
  Rig r(wide_room(), {}, roam::Mode::fly);
  r->setPose({1.0, 2.0, 2.0}, 0.3, 0.1);
  Mesh other = wide_room();
  add_wall(other, 1.1, -5.0, 1.1, 5.0, 0.0, 3.0);
  r->setSpace(std::make_shared<const roam::World>(build(other)));
  EXPECT_FALSE(r->held());
  EXPECT_NEAR(r->eye().x, 0.8, 0.01);
  EXPECT_DOUBLE_EQ(r->yaw(), 0.3);
  EXPECT_GE(Judge(other).distance(r->walker()->body(), r->walker()->position(), 1.0), 0.3 - 1e-6);
}

TEST(ManipulatorSpace, OnFootAComputedHomeIsAPlaceToStand) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  Rig r;
  r->setMode(roam::Mode::walk);
  r->setNode(scene);
  r->home(0.0);
  r->buildSpace(*scene);
  EXPECT_TRUE(r->held());
  while (r->building()) {
    EXPECT_LE(r->buildProgress(), 1.0);
    r.frame(frame);
    EXPECT_TRUE(!r->building() || r.viewer.continuous);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ASSERT_NE(r->walker(), nullptr);
  r.frames(1.0);
  EXPECT_TRUE(r->walker()->grounded());
  EXPECT_NEAR(r->walker()->position().x, 10.0, 1.0);
  EXPECT_NEAR(r->eye().z, 1.6, near_ground);
}

TEST(ManipulatorSpace, WhoIsPutBackFromBelowTheSceneIsNotHeld) {
  Mesh m;
  add_floor(m, -2.0, -2.0, 2.0, 2.0, 0.0);
  Rig r(m, {}, roam::Mode::walk);
  r->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
  int put_back = 0;
  r->setStepCallback([&](const roam::StepReport& report, double) { put_back += report.put_back; });
  r.down('w');
  for (int i = 0; i < 600; ++i) {
    r.frame(frame);
    EXPECT_FALSE(r->held());
  }
  EXPECT_GT(put_back, 0);
}

TEST(ManipulatorSpace, WhoIsHeldIsHeldInEveryMode) {
  const auto space = std::make_shared<roam::Patchwork>();
  space->expect({Vec3(-20.0), Vec3(20.0)});
  Rig r;
  r->setSpace(space);
  r.frames(0.1);
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly, roam::Mode::walk}) {
    r->setMode(mode);
    EXPECT_TRUE(r->held());
    r.frames(0.1);
    EXPECT_TRUE(r->held());
  }
  r->setMode(roam::Mode::ghost);
  EXPECT_FALSE(r->held());
}

TEST(ManipulatorSpace, OnFootANewFloorLeavesAloneWhoHasMovedFromTheComputedHome) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  const auto world = std::make_shared<const roam::World>(roam::World());
  const auto floor = std::make_shared<const roam::World>(osgRoam::buildWorld(*scene));
  using Move = std::function<void(Rig&)>;
  const auto moved_home = [&](const Move& move) {
    Rig r;
    r->setMode(roam::Mode::walk);
    r->setNode(scene);
    r->setSpace(world);
    r->home(0.0);
    move(r);
    const Vec3 before = r->eye();
    r->setSpace(floor);
    return glm::length(r->eye() - before) > 1.0;
  };
  EXPECT_TRUE(moved_home([](Rig&) {}));
  EXPECT_TRUE(moved_home([](Rig& r) { r->look(1.0, 0.2); })) << "who only looks has not moved";
  const Vec3 away(40.0, 0.0, 3.0);
  EXPECT_FALSE(moved_home([&](Rig& r) { r->setPose(away, 0.0, 0.0); }));
  EXPECT_FALSE(moved_home([&](Rig& r) { r->setFeet(away, 0.0, 0.0); }));
  EXPECT_FALSE(moved_home([&](Rig& r) { r->setByMatrix(osg::Matrixd::translate(40.0, 0.0, 3.0)); }));
  EXPECT_FALSE(moved_home([&](Rig& r) { r->goTo(away, {0.0, 0.0, 1.0}); }));
  EXPECT_FALSE(moved_home([](Rig& r) { r->placed(); }));
  EXPECT_FALSE(moved_home([](Rig& r) {
    r.frame(frame);
    r.down('w');
    r.frame(frame);
  }));
}

TEST(ManipulatorSpace, OneLineBuildsTheWorldOfTheScene) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  osg::ref_ptr<osgRoam::Manipulator> m = new osgRoam::Manipulator(scene.get());
  Rig r;
  r.manipulator = m;
  EXPECT_TRUE(m->building());
  finish_building(r);
  ASSERT_NE(m->walker(), nullptr);
  EXPECT_EQ(static_cast<const roam::World&>(*m->space()).stats().triangles, 12u);
  EXPECT_EQ(m->problem(), "");
}

TEST(ManipulatorSpace, ASpaceIsBuiltWithTheOriginThatTheGraphHasOrNotAtAll) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  const osg::Vec3d far(4.5e6, 5.1e6, 300.0);
  Rig r;
  r.manipulator = new osgRoam::Manipulator(scene.get(), {}, roam::Mode::fly, far);
  EXPECT_EQ(r->origin(), far);
  const auto refuses = [&] {
    EXPECT_THROW(r->setOrigin({1.0, 0.0, 0.0}), roam::Error);
    EXPECT_EQ(r->origin(), far);
    EXPECT_NO_THROW(r->setOrigin(far));
  };
  refuses();
  finish_building(r);
  refuses();
  EXPECT_NEAR(r->space()->bounds().center().x, far.x() + 10.0, 0.1);
  osg::ref_ptr<osg::Object> clone = r->clone(osg::CopyOp::SHALLOW_COPY);
  EXPECT_THROW(dynamic_cast<osgRoam::Manipulator&>(*clone).setOrigin({}), roam::Error);
  // A space of one's own is in the scene's frame whatever the graph is moved by.
  r->setSpace(std::make_shared<const roam::World>(build(wide_room())));
  EXPECT_NO_THROW(r->setOrigin({1.0, 0.0, 0.0}));
  EXPECT_THROW(osg::ref_ptr<osgRoam::Manipulator>(new osgRoam::Manipulator(nullptr, {}, roam::Mode::fly, {NAN, 0, 0})),
               roam::Error);
}

TEST(ManipulatorSpace, ADestroyedManipulatorEndsItsBuilding) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  for (int i = 0; i < 20; ++i) osg::ref_ptr<osgRoam::Manipulator>(new osgRoam::Manipulator(scene.get()));
}

TEST(ManipulatorSpace, ACloneTakesIntoUseWhatItsPatchworkGets) {
  const auto space = std::make_shared<roam::Patchwork>();
  const roam::PatchId tile = space->expect({Vec3(-20.0), Vec3(20.0)});
  Rig r;
  r->setSpace(space);
  osg::ref_ptr<osg::Object> clone = r->clone(osg::CopyOp::SHALLOW_COPY);
  r.manipulator = dynamic_cast<osgRoam::Manipulator*>(clone.get());
  EXPECT_TRUE(r->held());
  space->deliver(tile, roam::World());
  r.frames(0.1);
  EXPECT_FALSE(r->held());
}

TEST(ManipulatorSpace, APatchworkIsUpdatedWhicheverTypeThePointerHas) {
  const auto patchwork = std::make_shared<roam::Patchwork>();
  const auto comes = [&](const auto& pointer) {
    const Vec3 middle(100.0 * static_cast<double>(patchwork->stats().patches), 0.0, 0.0);
    Rig r;
    r->setPose(middle, 0.0, 0.0);
    r->setSpace(pointer);
    const roam::PatchId tile = patchwork->expect({middle - Vec3(20.0), middle + Vec3(20.0)});
    r.frames(0.1);
    const bool waited = r->held();
    patchwork->deliver(tile, roam::World());
    r.frames(0.1);
    return waited && !r->held();
  };
  EXPECT_TRUE(comes(patchwork));
  EXPECT_TRUE(comes(std::shared_ptr<roam::Space>(patchwork)));
  EXPECT_FALSE(comes(std::shared_ptr<const roam::Space>(patchwork))) << "that one is the caller's to update";
  EXPECT_FALSE(comes(std::shared_ptr<const roam::Patchwork>(patchwork)));
}

TEST(ManipulatorSpace, AnUpdateOfOnesOwnIsForgottenWithItsSpace) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  Rig r(wide_room(), {}, roam::Mode::fly);
  int updates = 0;
  r->setSpaceUpdate([&](const roam::Body&, const Vec3&) { ++updates; });
  r.frame(frame);
  EXPECT_GT(updates, 0);
  r->buildSpace(*scene);
  finish_building(r);
  updates = 0;
  r.frames(0.1);
  EXPECT_EQ(updates, 0);
  r->setSpaceUpdate([&](const roam::Body&, const Vec3&) { ++updates; });
  r->setSpace(std::make_shared<roam::World>());
  EXPECT_EQ(updates, 0);
}

TEST(ManipulatorSpace, AnotherSpaceEndsTheBuilding) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  Rig r;
  r->buildSpace(*scene);
  const auto own = std::make_shared<const roam::World>();
  r->setSpace(own);
  EXPECT_FALSE(r->building());
  r.frames(0.1);
  EXPECT_EQ(r->space(), own);
}

TEST(ManipulatorSpace, ACallbackMayExchangeASpaceThatWasJustBuilt) {
  osg::ref_ptr<osg::Group> scene = lone_box();
  const auto own = std::make_shared<const roam::World>();
  Rig r;
  osgRoam::Manipulator* m = r.manipulator.get();
  r->buildSpace(*scene);
  r->setStepCallback([&](const roam::StepReport&, double) {
    m->setStepCallback(nullptr);
    m->setSpace(own);
  });
  finish_building(r);
  EXPECT_EQ(r->space(), own);
  EXPECT_NO_THROW(r->setOrigin({1.0, 0.0, 0.0}));
}

TEST(ManipulatorSpace, ACrouchedBodyKeepsItsFeetInAnotherSpace) {
  Mesh low;
  add_box(low, {-5.0, -5.0, 0.0}, {5.0, 5.0, 1.3});
  const auto world = std::make_shared<const roam::World>(build(low));
  Rig r(low, {}, roam::Mode::walk);
  r->setFeet({1.0, 2.0, 0.01}, 0.0, 0.0);
  r.frames(0.5);
  ASSERT_TRUE(r->walker()->crouched());
  const Vec3 feet = r->walker()->feet();
  r->setSpace(world);
  EXPECT_FALSE(r->held());
  EXPECT_LT(glm::length(r->walker()->feet() - feet), 0.01) << r->walker()->feet().z;
  osg::ref_ptr<osg::Object> clone = r->clone(osg::CopyOp::SHALLOW_COPY);
  const auto& other = dynamic_cast<osgRoam::Manipulator&>(*clone);
  EXPECT_FALSE(other.held());
  EXPECT_LT(glm::length(other.walker()->feet() - feet), 0.01);
}

/// A smaller body in all of the room.
roam::SizeRegion everywhere(double radius) {
  return {{roam::Vec3(-5.0, -5.0, -1.0), roam::Vec3(5.0, 5.0, 4.0)}, radius, 0.0, "a narrow room"};
}

TEST(ManipulatorSpace, RegionsStayWithTheBodyWhateverSpaceAndSettingsItGets) {
  Rig r;
  const roam::SizeRegion small = everywhere(0.2);
  r->setRegions({&small, 1});
  EXPECT_EQ(r->regions().size(), 1u) << "without a space";
  r->setPose({0.0, 0.0, 2.0}, 0.0, 0.0);
  const auto expect_small = [&](const char* when) {
    ASSERT_NE(r->walker(), nullptr);
    ASSERT_EQ(r->walker()->regions().size(), 1u) << when;
    EXPECT_EQ(r->walker()->body().radius, 0.2) << when;
  };
  r->setSpace(std::make_shared<const roam::World>(build(wide_room())));
  expect_small("a space");
  r->setSpace(std::make_shared<const roam::World>(build(wide_room())));
  expect_small("another space");
  roam::WalkerSettings settings;
  settings.radius = 0.4;
  r->setSettings(settings);
  expect_small("other settings");
  osg::ref_ptr<osg::Group> scene = lone_box();
  r->buildSpace(*scene);
  finish_building(r);
  expect_small("a space that was built");
  osg::ref_ptr<osgRoam::Manipulator> copy = new osgRoam::Manipulator(*r);
  EXPECT_EQ(copy->walker()->body().radius, 0.2) << "a copy";
  r->setRegions({});
  r.frames(0.1);
  EXPECT_EQ(r->walker()->body().radius, 0.4);
}

TEST(ManipulatorSpace, ABodyIsPutAsLargeAsItIsThere) {
  Mesh narrow = wide_room();
  for (const double y : {-0.25, 0.25}) add_wall(narrow, -5.0, y, 5.0, y, 0.0, 3.0);
  Rig r;
  const roam::SizeRegion small = everywhere(0.2);
  r->setRegions({&small, 1});
  r->setPose({0.0, 0.0, 2.0}, 0.0, 0.0);
  r->setSpace(std::make_shared<const roam::World>(build(narrow)));
  EXPECT_FALSE(r->held());
  expect_close(rig::eye_of(r->getMatrix()), {0, 0, 2}, 1e-9);
}

TEST(ManipulatorSpace, RegionsThatTheSettingsDoNotAllowAreRefused) {
  Rig r(wide_room(), {}, roam::Mode::fly);
  const roam::SizeRegion small = everywhere(0.2), bad = everywhere(2.0);
  r->setRegions({&small, 1});
  EXPECT_THROW(r->setRegions({&bad, 1}), roam::Error);
  EXPECT_EQ(r->regions()[0].radius, 0.2);
  EXPECT_EQ(r->walker()->regions()[0].radius, 0.2);
  roam::WalkerSettings low = r->settings();
  low.radius = 0.1;
  low.height = low.eye = low.crouch_height = 0.3;  // lower than the region's body is wide
  EXPECT_THROW(r->setSettings(low), roam::Error);
  EXPECT_EQ(r->settings().radius, 0.3);
  EXPECT_EQ(r->walker()->settings().height, 1.8);
}

}  // namespace
