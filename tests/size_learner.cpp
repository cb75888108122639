// Learning the size of a body while it roams: at an opening a smaller one, over a crack a larger foot, and neither
// where there is nothing to learn.
#include "roam/size_learner.h"

#include <gtest/gtest.h>

#include <glm/geometric.hpp>

#include "roam/route.h"
#include "roam/world.h"
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
  Walk(const World& world, const WalkerSettings& settings, const roam::LearnLimits& limits = {})
      : learner(known(settings), limits), walker(world, settings, Mode::walk, centre(settings, 1.0)) {
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
  const World world = corridor({.door = 0.6});
  const Walk walk(world, person(0.4), {.radius_min = 0.3});
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

TEST(SizeLearner, TakesALargerFootWhereTheBodyFellAndGoesOnFromWhereItStood) {
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

TEST(SizeLearner, NoFootCarriesOverAPit) {
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

TEST(SizeLearner, RefusesLimitsThatAreNone) {
  EXPECT_THROW(SizeLearner(Profile(), {}), roam::Error) << "a profile without a radius";
  Profile profile = known(person(0.3));
  EXPECT_THROW(SizeLearner(profile, {.radius_min = 0.0}), roam::Error);
  EXPECT_THROW(SizeLearner(profile, {.support_max = -1.0}), roam::Error);
  EXPECT_THROW(SizeLearner(profile, {.patience = -1.0}), roam::Error);
}

}  // namespace
