// What goes wrong inside the viewer's loop stays there, and is said.
#include <glm/geometric.hpp>

#include "osg_rig.h"

namespace {

using namespace scenes;
using rig::Rig;

TEST(ManipulatorFailures, ASpaceThatFailsStopsTheBodyAndSaysWhy) {
  struct Failing final : roam::Space {
    roam::SpaceFacts facts() const override { return {.bounds = {Vec3(-1.0), Vec3(1.0)}}; }
    roam::Object object(roam::TriangleId) const override { return {}; }
    roam::FirstImpact find_first(const roam::Query&, roam::Vicinity*) const override {
      if (broken) throw roam::Error("the disk is gone");
      return {};
    }
    void find_near(const roam::Query&, roam::Collector&, roam::Vicinity*) const override {
      if (broken) throw roam::Error("the disk is gone");
    }
    bool broken = false;
  };
  const auto space = std::make_shared<Failing>();
  Rig r;
  r->setSpace(std::shared_ptr<const roam::Space>(space));
  r.down('w');
  r.frames(0.5);
  const Vec3 before = r->eye();
  space->broken = true;
  r.frames(0.5);
  EXPECT_EQ(r->problem(), "the disk is gone");
  EXPECT_TRUE(r->held());
  space->broken = false;
  r.frames(0.5);
  EXPECT_EQ(r->eye(), before);
  r->setPose({0.0, 0.0, 0.0}, 0.0, 0.0);
  EXPECT_EQ(r->problem(), "");
  r.frames(0.5);
  EXPECT_GT(glm::length(r->eye()), 0.5);
}

TEST(ManipulatorFailures, ACallbackThatThrowsDoesNotReachTheViewer) {
  Rig r(floor_mesh(), {}, roam::Mode::walk);
  r->setStepCallback([](const roam::StepReport&, double) { throw roam::Error("the trace is full"); });
  r.down('w');
  EXPECT_NO_THROW(r.frames(0.1));
  EXPECT_EQ(r->problem(), "the trace is full");
  r->setPose({0.0, 0.0, 3.0}, 0.0, 0.0);
  r->setStepCallback([](const roam::StepReport&, double) { throw 1; });
  EXPECT_NO_THROW(r.frames(0.1));
  EXPECT_NE(r->problem(), "");
  EXPECT_TRUE(r->held());
}

TEST(ManipulatorFailures, ACallbackMayReplaceItselfAndLivesUntilItReturns) {
  Rig r(floor_mesh(), {}, roam::Mode::walk);
  osgRoam::Manipulator* m = r.manipulator.get();
  int lived = 0;
  // What a callback captures is there for as long as it runs.
  const auto lives = [&lived](auto replace) {
    const auto captured = std::make_shared<int>();
    return [&lived, captured, seen = std::weak_ptr<int>(captured), replace](const auto&...) {
      const std::weak_ptr<int> still = seen;
      int& count = lived;
      replace();
      count += !still.expired();
      return false;
    };
  };
  r->setStepCallback(lives([m] { m->setStepCallback(nullptr); }));
  r.frames(0.1);
  EXPECT_EQ(lived, 1);
  r->setCommandCallback(lives([m] { m->setCommandCallback(nullptr); }));
  r->controls().add("own", "F2", "", osgRoam::Controls::Kind::pressed);
  r.press(rig::Adapter::KEY_F2);
  EXPECT_EQ(lived, 2);
  r->setSpaceUpdate(lives([m] { m->setSpaceUpdate(nullptr); }));
  r.frames(0.1);
  EXPECT_EQ(lived, 3);
}

TEST(ManipulatorFailures, APilotMayChangeTheBodyAndTheSpaceThatItFliesIn) {
  Rig r(floor_mesh(), {}, roam::Mode::fly);
  osgRoam::Manipulator* m = r.manipulator.get();
  int calls = 0;
  r->setPilot([&](roam::Walker& walker, double seconds) {
    const roam::StepReport* report = &walker.step({}, seconds);
    roam::WalkerSettings settings = m->settings();
    settings.height = ++calls % 2 == 0 ? 1.8 : 1.7;
    m->setSettings(settings);
    if (calls == 20) m->setSpace(nullptr);
    return report;
  });
  r.frames(1.0);
  EXPECT_EQ(calls, 20);
  EXPECT_EQ(r->problem(), "");
  EXPECT_TRUE(r->held());
}

TEST(ManipulatorFailures, APilotThatEndsMayBeFollowedByAnother) {
  Rig r(floor_mesh(), {}, roam::Mode::fly);
  osgRoam::Manipulator* m = r.manipulator.get();
  int steps = 0;
  r->setPilot([&](roam::Walker&, double) -> const roam::StepReport* {
    m->setPilot([&steps](roam::Walker& walker, double seconds) {
      ++steps;
      return &walker.step({}, seconds);
    });
    return nullptr;
  });
  r.frames(0.5);
  EXPECT_TRUE(r->piloted());
  EXPECT_GT(steps, 20);
}

TEST(ManipulatorFailures, ASpaceThatFailedWhenItCameIsTriedAgainByAPlacement) {
  bool broken = true;
  const auto fail = [&](const roam::Body&, const Vec3&) {
    if (broken) throw roam::Error("the disk is gone");
  };
  Rig r;
  r->setSpace(std::make_shared<const roam::World>());
  r->setSpaceUpdate(fail);
  r->setSettings({.radius = 0.2});
  EXPECT_EQ(r->problem(), "the disk is gone");
  EXPECT_TRUE(r->held());
  r->setPose({1.0, 2.0, 3.0}, 0.0, 0.0);
  EXPECT_EQ(r->problem(), "the disk is gone");
  broken = false;
  r->setPose({1.0, 2.0, 3.0}, 0.0, 0.0);
  EXPECT_EQ(r->problem(), "");
  EXPECT_FALSE(r->held());
  EXPECT_EQ(r->eye(), Vec3(1.0, 2.0, 3.0));
}

TEST(ManipulatorFailures, AnUpdateMayTakeTheSpaceAway) {
  const auto places = {+[](Rig& r) {
                         r->setPose({0.0, 0.0, 3.0}, 0.0, 0.0);
                       },
                       +[](Rig& r) { r.frames(0.1); }, +[](Rig& r) { r->setSettings({.radius = 0.2}); }};
  for (const auto& place : places) {
    Rig r(floor_mesh(), {}, roam::Mode::walk);
    osgRoam::Manipulator* m = r.manipulator.get();
    Vec3 seen(0.0);
    r->setSpaceUpdate([m, &seen](const roam::Body&, const Vec3& where) {
      m->setSpace(nullptr);
      seen = where;
    });
    place(r);
    EXPECT_TRUE(r->held());
    EXPECT_EQ(r->problem(), "");
    EXPECT_EQ(r->walker(), nullptr);
  }
}

TEST(ManipulatorFailures, OfAPilotThatChangesTheBodyOnlyThePlacementIsTold) {
  Rig r(floor_mesh(), {}, roam::Mode::fly);
  osgRoam::Manipulator* m = r.manipulator.get();
  r->setPilot([&](roam::Walker& walker, double seconds) {
    const roam::StepReport* report = &walker.step({}, seconds);
    m->setSettings(m->settings());
    return report;
  });
  int steps = 0, placements = 0;
  r->setStepCallback([&](const roam::StepReport& report, double seconds) {
    ++(seconds > 0.0 ? steps : placements);
    EXPECT_EQ(report.has(roam::EventKind::placed), seconds == 0.0);
  });
  r.frames(0.5);
  EXPECT_GT(placements, 0);
  EXPECT_EQ(steps, 0);
}

}  // namespace
