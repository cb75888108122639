// Looking, the wheel, going by double click, pilots.
#include <glm/geometric.hpp>

#include "osg_rig.h"
#include "roam/patchwork.h"
#include "roam/route.h"

namespace {

using namespace scenes;
using rig::Adapter;
using rig::Rig;

constexpr double quarter = 1.5707963267948966;

/// A floor with a wall across it at x = 8 and a box of 1 m at (4, 0).
Mesh yard() {
  Mesh m = floor_mesh();
  add_wall(m, 8.0, -10.0, 8.0, 10.0, 0.0, 5.0);
  add_box(m, {3.5, -0.5, 0.0}, {4.5, 0.5, 1.0});
  return m;
}

struct StandingInYard : Rig {
  explicit StandingInYard(const Mesh& mesh = yard(), roam::Mode mode = roam::Mode::walk) : Rig(mesh, {}, mode) {
    manipulator->setFeet({0.0, 0.0, 0.0}, 0.0, 0.0);
    frames(0.5);
  }
  [[nodiscard]] Vec3 at() const { return manipulator->walker()->position(); }
};

TEST(ManipulatorMouse, DraggingLooks) {
  Rig r;
  r->look(0.0, 0.0);
  r.mouse(100, 300);  // no button: nothing
  r.mouse(300, 300);
  EXPECT_EQ(r->yaw(), 0.0);
  r.push(400, 300);
  r.mouse(400 + 299.5, 300);
  EXPECT_NEAR(r->yaw(), -0.5 * quarter, 2e-3);  // half a height of the window to the right
  EXPECT_EQ(r->pitch(), 0.0);
  r.mouse(400 + 299.5, 300 - 149.75);
  EXPECT_NEAR(r->pitch(), 0.25 * quarter, 2e-3);  // up in the window, where y grows downwards
  r.let_go(700, 150);
  r.mouse(100, 100);
  EXPECT_NEAR(r->yaw(), -0.5 * quarter, 2e-3);
  r->setLookSpeed(2.0 * quarter);
  r->look(0.0, 0.0);
  r.push(400, 300);
  r.mouse(400 - 299.5, 300);
  EXPECT_NEAR(r->yaw(), quarter, 4e-3);
}

TEST(ManipulatorMouse, UpIsUpWhicheverWayTheWindowCounts) {
  Rig r;
  r.queue = new osgGA::EventQueue(Adapter::Y_INCREASING_UPWARDS);
  r.queue->getCurrentEventState()->setWindowRectangle(0, 0, 800, 600);
  r->look(0.0, 0.0);
  r.push(400, 300);
  r.mouse(400, 400);
  EXPECT_GT(r->pitch(), 0.1);
}

TEST(ManipulatorMouse, LookingEndsAtTheZenith) {
  Rig r;
  r.push(400, 599);
  for (int i = 0; i < 20; ++i) {
    r.mouse(400, 0);
    r.push(400, 599);
  }
  EXPECT_DOUBLE_EQ(r->pitch(), quarter);
}

TEST(ManipulatorMouse, GrabbedItLooksWheneverItMovesAndNeverLeavesTheWindow) {
  Rig r;
  r->look(0.0, 0.0);
  r->setMouseGrab(true);
  r.frame(frame);
  EXPECT_EQ(r.viewer.warps, 1);
  const float x0 = r.viewer.warp_x, y0 = r.viewer.warp_y;
  EXPECT_NEAR(x0, 399.5, 0.51);
  // To the right by one pixel at a time, over ten windows; a warp arrives a few events late, as it does.
  double x = std::floor(x0);
  const double y = std::floor(y0);
  int late = 0, warps = r.viewer.warps, moves = 0;
  double turned = 0.0, yaw = r->yaw();
  r.mouse(float(x), float(y));
  for (; moves < 8000; ++moves) {
    x += 1.0;
    ASSERT_LT(x, 800.0);
    r.mouse(float(x), float(y));
    r.frame(0.001);
    turned -= std::remainder(r->yaw() - yaw, 4.0 * quarter);
    yaw = r->yaw();
    if (r.viewer.warps > warps) {
      warps = r.viewer.warps;
      late = 3;
    } else if (late > 0 && --late == 0) {
      x = std::floor(x0);
      r.mouse(float(x), float(y));  // what the window says of the warp
    }
  }
  EXPECT_GT(warps, 20);
  EXPECT_NEAR(turned, moves * quarter / 600.0, 0.01 * turned);
  EXPECT_NEAR(r->pitch(), 0.0, 1e-12);
}

TEST(ManipulatorMouse, EscapeLeavesTheGrab) {
  Rig r;
  r->setMouseGrab(true);
  r.frame(frame);
  r.down(Adapter::KEY_Escape);
  EXPECT_TRUE(r.taken);
  EXPECT_FALSE(r->mouseGrab());
  r.up(Adapter::KEY_Escape);
  const double yaw = r->yaw();
  r.mouse(100, 100);
  r.mouse(300, 100);
  EXPECT_EQ(r->yaw(), yaw);
  r.down('m');
  EXPECT_TRUE(r->mouseGrab());
}

TEST(ManipulatorMouse, TheWheelChangesTheSpeed) {
  StandingInYard r;
  const auto turn = [&](int notches, Adapter::ScrollingMotion motion) {
    for (int i = 0; i < notches; ++i) {
      r.time += 0.05;
      r.wheel(motion);
    }
  };
  turn(3, Adapter::SCROLL_UP);
  EXPECT_NEAR(r->speed(), 1.4 * 1.25 * 1.25 * 1.25, 1e-9);
  turn(3, Adapter::SCROLL_DOWN);
  EXPECT_NEAR(r->speed(), 1.4, 1e-9);
  r.time += 0.05;
  r.queue->mouseScroll2D(0.0f, 0.5f, r.time);
  r.deliver();
  EXPECT_GT(r->speed(), 1.5);
  turn(200, Adapter::SCROLL_UP);
  EXPECT_DOUBLE_EQ(r->speed(), osgRoam::Manipulator::greatest_speed);
  turn(200, Adapter::SCROLL_DOWN);
  EXPECT_DOUBLE_EQ(r->speed(), osgRoam::Manipulator::least_speed);
  r->setSpeed(2.0);
  r.down('d');
  r.frames(1.0);
  EXPECT_NEAR(r.at().y, -2.0, 1e-3);
}

TEST(ManipulatorMouse, TwoFingersChangeTheSpeedNoFasterThanAWheel) {
  StandingInYard r;
  r.time += 1.0;
  // A swipe on a touchpad: 60 notches in half a second.
  for (int i = 0; i < 60; ++i) {
    r.time += 0.5 / 60;
    r.wheel(Adapter::SCROLL_UP);
  }
  EXPECT_LT(r->speed(), 1.4 * std::pow(1.25, 14.0));
  EXPECT_GT(r->speed(), 1.4 * std::pow(1.25, 8.0));
}

TEST(ManipulatorMouse, TwoFingersSidewaysDragNothing) {
  StandingInYard r;
  r.frame(frame);
  const double yaw = r->yaw();
  constexpr unsigned sideways = 6;  // a button of X11
  r.queue->mouseButtonPress(100.0f, 100.0f, sideways, r.time);
  r.deliver();
  EXPECT_FALSE(r.taken);
  r.queue->mouseMotion(300.0f, 100.0f, r.time);
  r.deliver();
  EXPECT_EQ(r->yaw(), yaw);
}

/// The pixel in which a point of the scene is seen.
osg::Vec2d pixel(const Rig& r, const Vec3& p) {
  osg::Matrixd projection;
  projection.makePerspective(60.0, 800.0 / 600.0, 0.1, 1000.0);
  const osg::Vec3d seen = osg::Vec3d(p.x, p.y, p.z) * r.manipulator->getInverseMatrix() * projection;
  return {0.5 * (seen.x() + 1.0) * 799.0, 0.5 * (1.0 - seen.y()) * 599.0};
}

TEST(ManipulatorMouse, ADoubleClickGoesThere) {
  for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly}) {
    StandingInYard r(yard(), mode);
    r->setFeet({0.0, 0.0, mode == roam::Mode::walk ? 0.0 : 1.0}, 0.0, -0.2);
    const Vec3 floor(3.0, 2.0, 0.0);
    const osg::Vec2d at = pixel(r, floor);
    r.double_click(float(at.x()), float(at.y()));
    EXPECT_TRUE(r->going());
    r.frame(frame);
    EXPECT_TRUE(r.viewer.continuous);
    r.frames(5.0);
    EXPECT_FALSE(r->going());
    EXPECT_LT(glm::length(r->walker()->feet() - floor), 0.05) << to_string(mode);
    EXPECT_FALSE(r.viewer.continuous);
  }
}

TEST(ManipulatorMouse, TwoClicksAreADoubleClickWhereNobodySaysSo) {
  const auto clicks = [](double apart, float moved, unsigned int button) {
    StandingInYard r;
    r->look(0.0, -0.3);
    for (int i = 0; i < 2; ++i) {
      const float x = 600.0f + static_cast<float>(i) * moved;
      r.queue->mouseButtonPress(x, 350, button, r.time);
      r.deliver();
      EXPECT_TRUE(r.taken);
      r.time += 0.05;
      r.queue->mouseButtonRelease(x, 350, button, r.time);
      r.deliver();
      r.time += apart - 0.05;
    }
    return r->going();
  };
  EXPECT_TRUE(clicks(0.2, 0.0f, 1));
  EXPECT_TRUE(clicks(0.3, 3.0f, 1));
  EXPECT_FALSE(clicks(0.6, 0.0f, 1));
  EXPECT_FALSE(clicks(0.2, 30.0f, 1));
  EXPECT_FALSE(clicks(0.2, 0.0f, 3));
}

TEST(ManipulatorMouse, InvertedTheMouseLooksDownWhenItGoesUp) {
  Rig r;
  r->look(0.0, 0.0);
  r->setLookInverted(true);
  EXPECT_TRUE(r->lookInverted());
  r.push(400, 300);
  r.mouse(400, 200);
  EXPECT_LT(r->pitch(), -0.1);
}

TEST(ManipulatorMouse, GoingStopsBeforeTheWallThatWasClicked) {
  StandingInYard r;
  const osg::Vec2d at = pixel(r, {8.0, 3.0, 1.5});
  r.double_click(float(at.x()), float(at.y()));
  r.frames(5.0);
  EXPECT_FALSE(r->going());
  EXPECT_NEAR(r.at().x, 7.7, 0.02);
  EXPECT_NEAR(r.at().y, 3.0, 0.1);
}

TEST(ManipulatorMouse, GoingEndsWhenItIsBlocked) {
  StandingInYard r;
  r->goTo({7.0, 0.0, 0.0}, {0.0, 0.0, 1.0});  // behind the box
  r.frames(0.3);
  EXPECT_TRUE(r->going());
  r.frames(3.0);
  EXPECT_FALSE(r->going());
  EXPECT_LT(r.at().x, 3.3);
}

TEST(ManipulatorMouse, GoingEndsAtTheFirstKeyThatMoves) {
  for (const int key : {'w', 's', 'e', ' '}) {
    StandingInYard r;
    r->goTo({0.0, 9.0, 0.0}, {0.0, 0.0, 1.0});
    r.frames(0.2);
    EXPECT_TRUE(r->going());
    r.down(Adapter::KEY_Shift_L);
    r.frames(0.05);
    EXPECT_TRUE(r->going());
    r.down(key);
    r.frames(0.05);
    EXPECT_FALSE(r->going()) << key;
  }
  StandingInYard r;
  r->goTo({0.0, 9.0, 0.0}, {0.0, 0.0, 1.0});
  r->finishAnimation();
  EXPECT_FALSE(r->going());
}

TEST(ManipulatorMouse, GoingComesToRestBesideTheSurface) {
  Rig r(floor_mesh(), {.radius = 0.25}, roam::Mode::fly);
  r->setPose({0.0, 0.0, 5.0}, 0.0, 0.0);
  const double skin = r->walker()->skin();
  for (const Vec3& normal : {Vec3(1.0, 0.0, 0.0), Vec3(0.0, 0.0, 1.0), Vec3(0.6, 0.0, 0.8)}) {
    const Vec3 point(-3.0, 1.0, 2.0);
    r->goTo(point, normal);
    r.frames(5.0);
    EXPECT_FALSE(r->going());
    const roam::Body body = r->walker()->body();
    const double support = body.radius + body.half_height * std::abs(normal.z);
    EXPECT_NEAR(glm::dot(r->walker()->position() - point, normal) - support, 2.0 * skin, 1e-3 + 2.0 * skin);
  }
  EXPECT_THROW(r->goTo({1.0, 1.0, 1.0}, Vec3(0.0)), roam::Error);
  EXPECT_THROW(r->goTo({1.0, 1.0, 1.0}, Vec3(0.0, 0.0, 2.0)), roam::Error);
  EXPECT_THROW(r->goTo({1.0, 1.0, 1.0}, Vec3(0.0, 0.0, NAN)), roam::Error);
  EXPECT_THROW(r->goTo({1.0, INFINITY, 1.0}, Vec3(0.0, 0.0, 1.0)), roam::Error);
  EXPECT_THROW(r->goTo({1e200, 0.0, 1.0}, Vec3(-1.0, 0.0, 0.0)), roam::Error);
  EXPECT_FALSE(r->going());
}

TEST(ManipulatorMouse, NobodyGoesWhoCanNot) {
  Rig r;
  r->goTo({5.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  EXPECT_FALSE(r->going()) << "without a space";
  r->setSpace(std::make_shared<const roam::World>());
  EXPECT_FALSE(r->going());
  r->setPilot([](roam::Walker& walker, double seconds) { return &walker.step({}, seconds); });
  r->goTo({5.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  EXPECT_FALSE(r->going()) << "with a pilot";
}

TEST(ManipulatorMouse, AClickIntoTheSkyGoesNowhere) {
  StandingInYard r;
  r->look(0.0, 1.0);
  r.double_click(400, 100);
  EXPECT_FALSE(r->going());
}

TEST(ManipulatorMouse, APilotMovesTheBodyInRealTimeAndAtItsEndThePersonDoes) {
  for (const double dt : {0.004, 1.0 / 60.0, 0.07}) {
    StandingInYard r(floor_mesh());
    const Vec3 path[] = {r.at(), r.at() + Vec3(3.0, 4.0, 0.0)};
    roam::Route route(*r->walker(), path, {.speed = 2.0});
    r->placed();
    double told = 0.0;
    r->setStepCallback([&](const roam::StepReport&, double seconds) { told += seconds; });
    r->setPilot([&](roam::Walker&, double) { return route.done() ? nullptr : &route.advance(); });
    r.down('s');  // the person's keys move nothing now
    r.frames(1.0, dt);
    EXPECT_TRUE(r->piloted());
    EXPECT_NEAR(glm::length(r.at() - path[0]), 2.0, 0.2);
    EXPECT_NEAR(told, 1.0, 1.0 / 60.0 + dt);
    EXPECT_NEAR(glm::length(r->eye() - r.at() - Vec3(0.0, 0.0, 0.7)), 0.0, 0.02);
    r.frames(2.0, dt);
    EXPECT_FALSE(r->piloted());
    EXPECT_EQ(route.result().outcome, roam::Outcome::reached);
    EXPECT_LT(r.at().x, 3.0);  // the person went back since
  }
}

TEST(ManipulatorMouse, APatchworkIsTakenIntoUseBetweenTheFrames) {
  const auto space = std::make_shared<roam::Patchwork>();
  const roam::PatchId tile = space->expect({Vec3(-20.0, -10.0, -1.0), Vec3(20.0, 10.0, 6.0)});
  space->update();
  Rig r;
  r->setMode(roam::Mode::walk);
  r->setPose({0.0, 0.0, 1.6}, 0.0, 0.0);
  r->setSpace(space);
  EXPECT_TRUE(r->held());
  r.frames(0.2);
  EXPECT_TRUE(r.viewer.continuous) << "who draws on demand only has to look for what comes all the same";
  r.down('w');
  r.frames(0.5);
  EXPECT_NEAR(r->eye().x, 0.0, 1e-9);
  EXPECT_TRUE(r->report().met_unknown);
  EXPECT_TRUE(r.viewer.continuous);
  space->deliver(tile, build(yard()));
  r.frames(1.0);
  EXPECT_FALSE(r->held());
  EXPECT_NEAR(r->eye().x, 1.4, 0.05);
}

}  // namespace
