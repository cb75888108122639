// What keys do, alone, together, and when they are let go.
#include <array>
#include <glm/geometric.hpp>

#include "osg_standing.h"

namespace {

using namespace scenes;
using rig::Adapter;
using rig::plain;
using rig::Rig;
using rig::Standing;

TEST(ManipulatorKeys, EachKeyGoesItsWay) {
  const std::pair<int, Vec3> ways[] = {{'w', {1, 0, 0}},
                                       {'s', {-1, 0, 0}},
                                       {'a', {0, 1, 0}},
                                       {'d', {0, -1, 0}},
                                       {'e', {0, 0, 1}},
                                       {'q', {0, 0, -1}},
                                       {Adapter::KEY_Up, {1, 0, 0}},
                                       {Adapter::KEY_KP_Right, {0, -1, 0}},
                                       {Adapter::KEY_Page_Up, {0, 0, 1}},
                                       {Adapter::KEY_Page_Down, {0, 0, -1}}};
  for (const auto& [key, way] : ways) {
    Standing r(roam::Mode::fly);
    const Vec3 before = r.at();
    r.down(key);
    EXPECT_TRUE(r.taken);
    r.frames(1.0);
    EXPECT_LT(glm::length(r.at() - before - 1.4 * way), 1e-6) << key;
    r.up(key);
    r.frames(1.0);
    EXPECT_LT(glm::length(r.at() - before - 1.4 * way), 1e-6) << key;
  }
}

TEST(ManipulatorKeys, DoWhatTheirCommandsDoByName) {
  Standing r;
  std::string called;
  r->setCommandCallback([&](const std::string& name) { called = name; });
  r->controls().add("plan", "L", "shows a plan", osgRoam::Controls::Kind::pressed);
  EXPECT_TRUE(r->run("plan"));
  EXPECT_EQ(called, "plan");
  int jumps = 0;
  r->setStepCallback(
      [&](const roam::StepReport& report, double) { jumps += report.has(roam::EventKind::jumped) ? 1 : 0; });
  EXPECT_TRUE(r->run("jump"));
  r.frames(1.0);
  EXPECT_EQ(jumps, 1);
  r->setHomePose({5.0, 0.0, 1.6}, 0.0, 0.0);
  EXPECT_TRUE(r->run("home"));
  EXPECT_NEAR(r.at().x, 5.0, 1e-6);
  EXPECT_TRUE(r->run("gravity"));
  EXPECT_EQ(r->mode(), roam::Mode::fly);
  for (const char* no_press : {"forward", "look", "release", "nothing"}) EXPECT_FALSE(r->run(no_press)) << no_press;
}

TEST(ManipulatorKeys, FlyingGoesWhereOneLooksAndWalkingStaysLevel) {
  for (const roam::Mode mode : {roam::Mode::fly, roam::Mode::walk}) {
    Standing r(mode);
    r->look(0.0, 0.5);
    const Vec3 before = r.at();
    r.down('w');
    r.frames(1.0);
    const Vec3 gone = r.at() - before;
    EXPECT_NEAR(glm::length(gone), 1.4, 1e-3);
    EXPECT_NEAR(gone.z, mode == roam::Mode::fly ? 1.4 * std::sin(0.5) : 0.0, 1e-3);
  }
}

TEST(ManipulatorKeys, TwoKeysAreNoFasterThanOne) {
  Standing r;
  r.down('w');
  r.down('d');
  r.frames(1.0);
  EXPECT_NEAR(glm::length(r.at() - Vec3(0.0, 0.0, r.at().z)), 1.4, 1e-3);
  EXPECT_NEAR(r.at().x, -r.at().y, 1e-3);
}

TEST(ManipulatorKeys, KeyRepeatChangesNothing) {
  Standing quiet, repeating;
  quiet.down('w');
  repeating.down('w');
  for (int i = 0; i < 60; ++i) {
    quiet.frame(frame);
    repeating.down('w');
    repeating.down('w');
    repeating.frame(frame);
  }
  EXPECT_EQ(quiet.at(), repeating.at());
  int jumps = 0;
  repeating->setStepCallback([&](const roam::StepReport& report, double) { jumps += report.has(EventKind::jumped); });
  for (int i = 0; i < 120; ++i) {
    repeating.down(' ');
    repeating.frame(frame);
  }
  EXPECT_EQ(jumps, 1);
}

TEST(ManipulatorKeys, ShiftAndItsLetterAreTheLetterHurried) {
  Standing r;
  r.down(Adapter::KEY_Shift_L);
  r.down('W', 'w');
  r.frames(1.0);
  EXPECT_NEAR(r.at().x, 7.0, 1e-3);
  r.up(Adapter::KEY_Shift_L);
  const double before = r.at().x;
  r.frames(1.0);  // W is down still, now without Shift
  EXPECT_NEAR(r.at().x - before, 1.4, 1e-3);
  r.up('w', 'w');
  r.frames(0.5);
  EXPECT_NEAR(r.at().x - before, 1.4, 1e-3);
}

TEST(ManipulatorKeys, WhereNoUnmodifiedKeyIsToldTheKeyItselfCounts) {
  Standing r;
  r.down('W', 0);
  r.frames(1.0);
  r.up('w', 0);  // Shift was let go in between
  r.frames(1.0);
  EXPECT_NEAR(r.at().x, 1.4, 1e-3);
}

TEST(ManipulatorKeys, CtrlIsSlow) {
  Standing r;
  r.down(Adapter::KEY_Control_L);
  r.down('w');
  r.frames(1.0);
  EXPECT_NEAR(r.at().x, 1.4 * osgRoam::Manipulator::slow_factor, 1e-3);
}

TEST(ManipulatorKeys, AltLetsGoOfAllKeys) {
  for (const int key :
       {int(Adapter::KEY_Alt_L), int(Adapter::KEY_Alt_R), int(Adapter::KEY_Super_L), int(Adapter::KEY_Meta_L)}) {
    Standing r;
    r.down('w');
    r.frames(0.5);
    r->setMouseGrab(true);
    r.down(key);  // and the window manager keeps the rest to itself
    const Vec3 before = r.at();
    r.frames(1.0);
    EXPECT_EQ(r.at(), before);
    EXPECT_FALSE(r->down("forward"));
    EXPECT_FALSE(r->mouseGrab());
  }
}

TEST(ManipulatorKeys, KeysGoneWithTheWindowAreLetGo) {
  Standing r;
  r.down('w');
  r.queue->closeWindow(r.time);
  r.deliver();
  const Vec3 before = r.at();
  r.frames(1.0);
  EXPECT_EQ(r.at(), before);
  r.down('w');
  r->releaseKeys();
  r.frames(1.0);
  EXPECT_EQ(r.at(), before);
}

TEST(ManipulatorKeys, WhatAnotherHandlerHasTakenIsLeftToItButLettingGoIsSeen) {
  Standing r;
  const auto handled = [&](bool press) {
    const osg::ref_ptr<Adapter> event =
        press ? r.queue->keyPress('s', r.time, 's') : r.queue->keyRelease('s', r.time, 's');
    event->setHandled(true);
    r.deliver();
  };
  handled(true);
  const Vec3 before = r.at();
  r.frames(0.5);
  EXPECT_EQ(r.at(), before);
  r.down('s');
  handled(false);
  r.frames(0.5);
  EXPECT_EQ(r.at(), before);
}

TEST(ManipulatorKeys, AJumpIsEquallyHighAtAnyFrameRate) {
  for (const double dt : {0.002, 0.01, 1.0 / 60.0, 0.04, 0.1, 0.2}) {
    Standing r;
    const double ground = r->walker()->feet().z;
    double top = 0.0;
    r->setStepCallback([&](const roam::StepReport& report, double) {
      for (const roam::Segment& c : report.segments) top = std::max(top, c.position.z - 0.5 * c.height - ground);
    });
    r.press(' ');
    r.frames(1.0, dt);
    EXPECT_NEAR(top, 0.5, 0.01) << dt;
    EXPECT_TRUE(r->walker()->grounded());
  }
}

TEST(ManipulatorKeys, AJumpAskedForJustBeforeLandingIsMade) {
  Standing r;
  r.press(' ');
  r.frames(0.5);
  ASSERT_FALSE(r->walker()->grounded());  // 0.64 s in the air
  r.press(' ');
  int jumps = 0;
  r->setStepCallback([&](const roam::StepReport& report, double) { jumps += report.has(EventKind::jumped); });
  r.frames(1.0);
  EXPECT_EQ(jumps, 1);
  r.frames(2.0);
  EXPECT_EQ(jumps, 1);
}

TEST(ManipulatorKeys, CrouchingLastsAsLongAsItsKey) {
  Standing r;
  r.down('c');
  r.frames(1.0);
  EXPECT_TRUE(r->walker()->crouched());
  EXPECT_LT(r->eye().z, 1.0);
  r.up('c');
  r.frames(1.0);
  EXPECT_FALSE(r->walker()->crouched());
  EXPECT_NEAR(r->eye().z, 1.6, near_ground);
}

TEST(ManipulatorKeys, GravityAndGhostAreSwitches) {
  Standing r(roam::Mode::fly);
  r.press('g');
  EXPECT_EQ(r->mode(), roam::Mode::walk);
  r.frames(2.0);
  EXPECT_TRUE(r->walker()->grounded());
  r.press('n');
  EXPECT_EQ(r->mode(), roam::Mode::ghost);
  r.down('q');
  r.frames(1.0);
  EXPECT_LT(r->walker()->feet().z, -1.0);
  r.up('q');
  r.press('n');  // back to what it was, and out of the ground
  EXPECT_EQ(r->mode(), roam::Mode::walk);
  r.frames(1.0);
  EXPECT_FALSE(r->held());
  EXPECT_GE(Judge(plain()).distance(r->walker()->body(), r.at(), 1.0), 0.3 - 1e-6);
  r.press('g');
  EXPECT_EQ(r->mode(), roam::Mode::fly);
}

TEST(ManipulatorKeys, AViewersOwnCommandsAreCalledOnceAPress) {
  Standing r;
  std::vector<std::string> called;
  r->controls().add("record", "R, Ctrl+F", "records", osgRoam::Controls::Kind::pressed);
  r->setCommandCallback([&](const std::string& name) { called.push_back(name); });
  r.down('r');
  EXPECT_TRUE(r.taken);
  r.down('r');
  r.up('r');
  r.press('f');
  r.down(Adapter::KEY_Control_R);
  r.press('f');
  r.press('g');  // the manipulator's own
  EXPECT_EQ(called, (std::vector<std::string>{"record", "record"}));
}

TEST(ManipulatorKeys, KeysThatDoNothingAreLeftToOthers) {
  Standing r;
  for (const int key : {int('1'), int('x'), int(Adapter::KEY_F12), int(Adapter::KEY_Escape)}) {
    for (int pass = 0; pass < 2; ++pass) {  // StatusHandler passes each event on before the viewer does
      r.down(key);
      EXPECT_FALSE(r.taken) << key;
    }
  }
}

TEST(ManipulatorKeys, TheViewerIsKeptDrawingWhileABodyFallsThatWasPlacedInTheAir) {
  Standing r;
  r->setFeet({0.0, 0.0, 3.0}, 0.0, 0.0);
  r->init(*r.queue->getCurrentEventState(), r.viewer);
  r.frame(frame);  // which a viewer that draws on demand draws once
  for (int i = 0; i < 200 && r.viewer.continuous; ++i) r.frame(frame);
  EXPECT_FALSE(r.viewer.continuous);
  EXPECT_NEAR(r.at().z, 0.9, 1e-2);
}

TEST(ManipulatorKeys, OtherKeysWorkAfterRebinding) {
  Standing r;
  r->controls().rebind("forward = Z");
  r.down('w');
  EXPECT_FALSE(r.taken);
  r.frames(0.5);
  EXPECT_LT(std::abs(r.at().x), 1e-6);
  r.down('z');
  EXPECT_TRUE(r->down("forward"));
  r.frames(0.5);
  EXPECT_NEAR(r.at().x, 0.7, 1e-3);
}

TEST(ManipulatorKeys, TheViewerIsKeptDrawingWhileAnythingMovesAndNoLonger) {
  Standing r;
  EXPECT_FALSE(r.viewer.continuous);
  r.down('w');
  r.frame(frame);
  EXPECT_TRUE(r.viewer.continuous);
  r.up('w');
  r.frames(1.0);
  EXPECT_FALSE(r.viewer.continuous);
  r.press(' ');
  r.frame(frame);
  r.frame(frame);
  EXPECT_TRUE(r.viewer.continuous);  // in the air
  r.frames(2.0);
  EXPECT_FALSE(r.viewer.continuous);
}

TEST(ManipulatorKeys, AGhostAtRestLetsTheViewerRestInAWallToo) {
  Mesh m = floor_mesh();
  add_box(m, {1.0, -3.0, 0.0}, {9.0, 3.0, 3.0});
  Rig r(m, {}, roam::Mode::ghost);
  r->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
  r.frame(frame);
  for (int i = 0; i < 3; ++i) {
    r.down('w');
    r.frame(frame);
    EXPECT_TRUE(r.viewer.continuous);
    r.frames(0.5);
    r.up('w');
    r.frames(0.5);
    EXPECT_FALSE(r.viewer.continuous) << r->eye().x;
  }
  EXPECT_GT(r->eye().x, 1.5);
}

}  // namespace
