// Learning the size of a body while it roams: at an opening a smaller one, over a crack a larger foot, and neither
// where there is nothing to learn.
#include "roam/size_learner.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "roam/route.h"
#include "roam/world.h"
#include "support_scenes.h"
#include "train_scenes.h"

namespace {

using roam::Lesson;
using roam::Mode;
using roam::Outcome;
using roam::Profile;
using roam::SizeLearner;
using roam::Vec3;
using roam::Walker;
using roam::WalkerSettings;
using roam::World;

Profile known(const WalkerSettings& settings) {
  Profile profile;
  profile.radius = settings.radius;
  profile.height = settings.height;
  profile.step = settings.step;
  return profile;
}

/// A walk through the corridor by a body that takes whatever it learns.
struct Walk {
  Walk(const World& world, const WalkerSettings& settings)
      : learner(known(settings)), walker(world, settings, Mode::walk, centre(settings, 1.0)) {
    const Vec3 wish(1.4, 0.0, 0.0);
    for (int i = 0; i < 60 * 20 && walker.position().x < 9.0; ++i) {
      const roam::StepReport& report = walker.step({.velocity = wish}, 1.0 / 60.0);
      least_gap = std::min(least_gap, report.least_gap);
      smallest = std::min(smallest, walker.body().radius);
      if (const auto lesson = learner.watch(walker, wish, 1.0 / 60.0)) {
        lessons.push_back(*lesson);
        learner.take(walker, *lesson);
      }
      if (walker.feet().z < -1.5) break;
    }
  }
  static Vec3 centre(const WalkerSettings& settings, double x) { return {x, 0.0, 0.5 * settings.height + 0.01}; }
  [[nodiscard]] bool arrived() const { return walker.position().x >= 9.0; }

  SizeLearner learner;
  Walker walker;
  std::vector<Lesson> lessons;
  double least_gap = 1.0;
  double smallest = 10.0;
};

World corridor(const CorridorOptions& options) {
  const roam::Mesh mesh = corridor_mesh(options);
  return World::build({&mesh, 1});
}

WalkerSettings person(double radius) {
  WalkerSettings settings;
  settings.radius = radius;
  settings.height = 1.8;
  return settings;
}

TEST(SizeLearner, TakesASmallerBodyAtADoorAndItsOwnBehindIt) {
  const World world = corridor({.door = 0.6});
  for (const WalkerSettings& settings : {person(0.4), WalkerSettings::sphere(0.4)}) {
    const Walk walk(world, settings);
    ASSERT_EQ(walk.lessons.size(), 1U);
    EXPECT_EQ(walk.lessons[0].kind, Lesson::Kind::narrower);
    EXPECT_NEAR(walk.lessons[0].region.radius, 0.97 * 0.3, 0.005);
    EXPECT_TRUE(walk.arrived());
    EXPECT_GE(walk.least_gap, -1e-6);
    EXPECT_DOUBLE_EQ(walk.smallest, walk.lessons[0].region.radius);
    EXPECT_DOUBLE_EQ(walk.walker.body().radius, 0.4) << "behind the door it is what it was";
    EXPECT_TRUE(walk.learner.changed());
    ASSERT_EQ(walk.learner.profile().regions.size(), 1U);
    EXPECT_EQ(walk.learner.profile().method, "roaming");
    EXPECT_DOUBLE_EQ(walk.learner.profile().radius, 0.4);
  }
}

TEST(SizeLearner, WhatWasLearnedServesTheNextWalk) {
  const World world = corridor({.door = 0.6});
  const Walk first(world, person(0.4));
  Walker second(world, person(0.4), Mode::walk, Walk::centre(person(0.4), 1.0));
  second.set_regions(first.learner.profile().regions);
  const std::vector<Vec3> way{Walk::centre(person(0.4), 1.0), Walk::centre(person(0.4), 9.0)};
  EXPECT_EQ(roam::follow(second, way).outcome, Outcome::reached);
}

TEST(SizeLearner, OffersNothingThatIsSmallerThanItMayBe) {
  const World world = corridor({.door = 1.9 * SizeLearner::radius_min});
  const Walk walk(world, person(0.4));
  EXPECT_TRUE(walk.lessons.empty());
  EXPECT_FALSE(walk.arrived());
  EXPECT_FALSE(walk.learner.changed());
}

TEST(SizeLearner, OffersNothingAtAClosedWall) {
  const World world = corridor({.door = 0.02});
  const Walk walk(world, person(0.4));
  EXPECT_TRUE(walk.lessons.empty());
  EXPECT_FALSE(walk.arrived());
}

TEST(SizeLearner, TakesALargerDiscWhereTheBodyFellAndGoesOnFromWhereItStood) {
  const World world = corridor({.split = 0.8});
  for (const WalkerSettings& settings : {person(0.25), WalkerSettings::sphere(0.25)}) {
    const Walk walk(world, settings);
    ASSERT_GE(walk.lessons.size(), 1U);
    EXPECT_EQ(walk.lessons[0].kind, Lesson::Kind::support);
    EXPECT_GT(walk.lessons[0].support_radius, 0.4);
    EXPECT_LT(walk.lessons[0].support_radius, 0.44);
    EXPECT_EQ(walk.lessons.size(), 1U);
    EXPECT_TRUE(walk.arrived());
    EXPECT_GE(walk.least_gap, -1e-6);
    EXPECT_DOUBLE_EQ(walk.learner.profile().support_radius, walk.lessons[0].support_radius);
  }
}

/// A walk along +x over what lies at x = 0, by a body that takes every foot that it is offered.
struct Crossing {
  Crossing(const roam::Mesh& mesh, const WalkerSettings& settings, const Vec3& start, double speed, double goal)
      : world(scenes::build(mesh)), learner(known(settings)), walker(world, settings, Mode::walk, start) {
    const Vec3 wish(speed, 0.0, 0.0);
    for (int i = 0; i < 60 * 20 && walker.position().x < goal; ++i) {
      walker.step({.velocity = wish}, 1.0 / 60.0);
      falls += walker.report().has(roam::EventKind::fell) || walker.report().put_back ? 1 : 0;
      if (const auto lesson = learner.watch(walker, wish, 1.0 / 60.0)) {
        lessons.push_back(*lesson);
        learner.take(walker, *lesson);
      }
    }
    arrived = walker.position().x >= goal;
  }
  World world;
  SizeLearner learner;
  Walker walker;
  std::vector<Lesson> lessons;
  int falls = 0;
  bool arrived = false;
};

TEST(SizeLearner, ADiscThatIsOfferedCarriesOnRampsToo) {
  for (const double degrees : {-25.0, -10.0, 15.0, 25.0}) {
    for (const double width : {0.7, 1.1}) {
      for (const double speed : {0.7, 1.4, 7.0}) {
        roam::Mesh mesh = scenes::split(width);
        scenes::turn(mesh, 25.0);
        scenes::tilt(mesh, degrees);
        const double rise = std::tan(degrees * std::numbers::pi / 180.0);
        const Crossing c(mesh, person(0.25), {-1.5, 0.0, 0.95 + 0.1 - 1.5 * rise}, speed, 2.5);
        ASSERT_EQ(c.lessons.size(), 1U) << degrees << " " << width << " " << speed;
        EXPECT_EQ(c.lessons[0].kind, Lesson::Kind::support);
        EXPECT_LE(c.falls, 1) << degrees << " " << width << " " << speed;
        EXPECT_TRUE(c.arrived) << degrees << " " << width << " " << speed;
      }
    }
  }
}

TEST(SizeLearner, LooksOverALowKerbAsTheWalkerDoes) {
  // Behind a kerb that is higher than a step the gap goes on; the walker sees it, for it looks over 0.25 m.
  roam::Mesh mesh;
  scenes::add_floor(mesh, -20.0, -10.0, 0.0, 10.0, 0.0);
  scenes::add_wall(mesh, 0.6, -10.0, 0.6, 10.0, -50.0, 0.2);
  scenes::add_floor(mesh, 1.2, -10.0, 20.0, 10.0, 0.0);
  scenes::add_floor(mesh, -20.0, -10.0, 20.0, 10.0, -50.0);
  WalkerSettings settings = person(0.2);
  settings.step = 0.1;
  const Crossing c(mesh, settings, {-1.5, 0.0, 0.95}, 1.0, 0.5);
  ASSERT_EQ(c.lessons.size(), 1U);
  EXPECT_NEAR(c.lessons[0].support_radius, 0.62, 0.01);
  EXPECT_EQ(c.falls, 1);
}

TEST(SizeLearner, LearnsOfAFallOutOfTheScene) {
  roam::Mesh mesh;
  scenes::add_floor(mesh, -20.0, -10.0, 0.0, 10.0, 0.0);
  scenes::add_floor(mesh, 0.8, -10.0, 20.0, 10.0, 0.0);
  const Crossing c(mesh, person(0.25), {-1.5, 0.0, 0.95}, 1.4, 2.0);
  ASSERT_EQ(c.lessons.size(), 1U);
  EXPECT_NEAR(c.lessons[0].support_radius, 0.42, 0.01);
  EXPECT_TRUE(c.arrived);
}

TEST(SizeLearner, OffersNoDiscForTheEndOfTheFloorNorForAStepDown) {
  roam::Mesh edge;
  scenes::add_floor(edge, -20.0, -10.0, 0.0, 10.0, 0.0);
  roam::Mesh ledge = edge;
  scenes::add_floor(ledge, -20.0, -10.0, 20.0, 10.0, -1.5);
  for (const roam::Mesh& mesh : {edge, ledge}) {
    const Crossing c(mesh, person(0.25), {-1.5, 0.0, 0.95}, 1.4, 2.0);
    EXPECT_TRUE(c.lessons.empty());
    EXPECT_GT(c.falls, 0);
  }
}

TEST(SizeLearner, NoDiscCarriesOverAPit) {
  const World world = corridor({.split = 3.0});
  const Walk walk(world, person(0.25));
  EXPECT_TRUE(walk.lessons.empty());
  EXPECT_FALSE(walk.arrived());
}

TEST(SizeLearner, SaysEachThingOnceWhileItLasts) {
  const World world = corridor({.door = 0.6});
  SizeLearner learner(known(person(0.4)));
  Walker walker(world, person(0.4), Mode::walk, Walk::centre(person(0.4), 4.0));
  int offers = 0;
  for (int i = 0; i < 600; ++i) {
    walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
    offers += learner.watch(walker, {1.4, 0.0, 0.0}, 1.0 / 60.0) ? 1 : 0;
  }
  EXPECT_EQ(offers, 1);
  for (int i = 0; i < 60; ++i) {
    walker.step({.velocity = {-1.4, 0.0, 0.0}}, 1.0 / 60.0);
    EXPECT_FALSE(learner.watch(walker, {-1.4, 0.0, 0.0}, 1.0 / 60.0));
  }
  for (int i = 0; i < 300; ++i) {
    walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
    offers += learner.watch(walker, {1.4, 0.0, 0.0}, 1.0 / 60.0) ? 1 : 0;
  }
  EXPECT_EQ(offers, 2) << "it came again";
}

TEST(SizeLearner, RefusesAProfileOutOfRange) {
  EXPECT_THROW(SizeLearner{Profile()}, roam::Error) << "a profile without a radius";
  Profile profile = known(person(0.3));
  for (const double wrong : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Profile bad = profile;
    bad.support_radius = wrong;
    EXPECT_THROW(SizeLearner{bad}, roam::Error);
    bad = profile;
    bad.radius = wrong;
    EXPECT_THROW(SizeLearner{bad}, roam::Error);
  }
  profile.regions.push_back({.bounds = {{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}}, .radius = 0.2});
  EXPECT_NO_THROW(SizeLearner{profile});
  profile.regions[0].radius = -1.0;
  EXPECT_THROW(SizeLearner{profile}, roam::Error);
}

TEST(SizeLearner, ALessonThatIsRefusedChangesNothing) {
  const World world = corridor({});
  const WalkerSettings low{.radius = 0.2, .height = 0.5, .eye = 0.4, .step = 0.2, .crouch_height = 0.45};
  const roam::Box place{{1.0, -1.0, 0.0}, {2.0, 1.0, 2.0}};
  Lesson narrower, support;
  narrower.region = {.bounds = place, .radius = -1.0};
  // The radius of this profile, 0.3 m, is none for a body 0.5 m high.
  support.kind = Lesson::Kind::support;
  support.support_radius = 0.5;
  for (const Lesson& lesson : {narrower, support}) {
    Profile profile = known(person(0.3));
    profile.regions.push_back({.bounds = place, .radius = 0.2});
    SizeLearner learner(profile);
    Walker walker(world, low, Mode::walk, {1.0, 0.0, 0.26});
    const Vec3 before = walker.position();
    EXPECT_THROW(learner.take(walker, lesson), roam::Error);
    EXPECT_EQ(learner.profile().regions.size(), 1U);
    EXPECT_EQ(learner.profile().regions[0].support_radius, 0.0);
    EXPECT_EQ(learner.profile().support_radius, 0.0);
    EXPECT_FALSE(learner.changed());
    EXPECT_TRUE(walker.regions().empty());
    EXPECT_EQ(walker.settings().support_radius, low.support_radius);
    EXPECT_EQ(walker.position(), before);
  }
}

}  // namespace
