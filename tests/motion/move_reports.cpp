// What a body keeps of ground that moves, and what its report tells.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "moving_stage.h"
#include "roam/filtered.h"

namespace {

using namespace moving;

TEST(MoveReports, KeepsTheVelocityOfTheGroundInTheAir) {
  Stage stage(ground());
  const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.5});
  stage.scene.space.set_velocity(id, {{4.0, 0.0, 0.0}});
  stage.run(0.5);
  const double seen = walker.position().x - stage.scene.space.pose(id).position.x;
  stage.advance();
  stage.step(walker, {.jump = true});
  ASSERT_TRUE(walker.report().has(roam::EventKind::jumped));
  int frames = 0;
  while (!walker.grounded() && ++frames < 120) {
    stage.advance();
    stage.step(walker);
  }
  EXPECT_GT(frames, 20);
  EXPECT_EQ(walker.stance().object, id);
  EXPECT_NEAR(walker.position().x - stage.scene.space.pose(id).position.x, seen, 1e-6);
  // Where the plate stops under it, it flies on.
  stage.advance();
  stage.step(walker, {.jump = true});
  stage.scene.space.set_velocity(id, {});
  const double begin = walker.position().x;
  for (int i = 0; i < 12; ++i) {
    stage.advance();
    stage.step(walker);
  }
  EXPECT_NEAR(walker.position().x - begin, 4.0 * 12 * dt, 0.01);
}

TEST(MoveReports, ThrowsABodyHigherThatJumpsFromARisingLift) {
  double tops[2] = {};
  for (const int rising : {0, 1}) {
    Stage stage(ground());
    const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 1.0}});
    Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 1.0});
    stage.scene.space.set_velocity(lift, {{0.0, 0.0, 2.0 * rising}});
    stage.run(0.2);
    stage.advance();
    const double begin = walker.feet().z;
    stage.step(walker, {.jump = true});
    stage.scene.space.set_velocity(lift, {});
    for (int i = 0; i < 60; ++i) {
      stage.step(walker);
      tops[rising] = std::max(tops[rising], walker.feet().z - begin);
    }
  }
  const double v = std::sqrt(2.0 * 9.81 * 0.5);
  EXPECT_NEAR(tops[0], 0.5, 0.01);
  EXPECT_NEAR(tops[1], (v + 2.0) * (v + 2.0) / (2.0 * 9.81) - 2.0 * dt, 0.01);  // which has been gone already
}

TEST(MoveReports, LetsABodyJumpAsHighAsEverFromWhatRises) {
  for (const double rising : {2.0, 5.0}) {
    Stage stage(ground());
    const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 1.0}});
    Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 1.0});
    stage.scene.space.set_velocity(lift, {{0.0, 0.0, rising}});
    stage.run(0.5);
    double top = 0.0;
    for (int i = 0; i < 50; ++i) {
      stage.advance();
      stage.step(walker, {.jump = i == 0});
      top = std::max(top, walker.feet().z - stage.scene.space.pose(lift).position.z);
    }
    EXPECT_NEAR(top, 0.5, 0.005);
  }
}

TEST(MoveReports, TellTheVelocityInTheSceneAndThePaceOnTheGround) {
  Stage stage(ground());
  const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.5});
  stage.scene.space.set_velocity(id, {{6.0, 0.0, 0.0}});
  stage.run(0.2, {.velocity = {0.0, 1.0, 0.0}});
  EXPECT_NEAR(glm::length(walker.velocity() - Vec3(6.0, 1.0, 0.0)), 0.0, 1e-6);
  EXPECT_NEAR(glm::length(walker.pace() - Vec3(0.0, 1.0, 0.0)), 0.0, 1e-6);
  stage.step(walker);
  EXPECT_NEAR(glm::length(walker.velocity()), 0.0, 1e-6);
}

TEST(MoveReports, TellTheVelocityOverAllMovementsSinceTheLastStep) {
  for (const int calls : {1, 2, 3}) {
    Stage stage(ground());
    const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
    Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.5});
    stage.scene.space.set_velocity(id, {{6.0, 0.0, 0.0}});
    stage.step(walker);
    for (int i = 0; i < calls; ++i) stage.advance();
    stage.step(walker, {}, 0.0);
    stage.step(walker);
    EXPECT_NEAR(glm::length(walker.velocity() - Vec3(6.0, 0.0, 0.0)), 0.0, 1e-6) << calls;
    stage.advance();
    walker.set_mode(Mode::ghost);
    walker.step({}, dt);
    EXPECT_EQ(walker.velocity(), Vec3(0.0)) << "a ghost does not ride";
  }
}

TEST(MoveReports, HoldTheGapToWhatOnlyPassesABodyThatIsMoved) {
  constexpr double beside = 0.35;  // m, of the passing face from the axis
  for (const bool first : {false, true}) {
    for (const bool stays : {false, true}) {
      Stage stage(ground());
      Mesh wall;
      scenes::add_box(wall, {-0.5, -0.01, -1.0}, {0.5, 0.01, 1.0});
      const auto add_wall = [&] { return stage.scene.add(wall, {{0.0, 20.0, 1.0}}); };
      ObjectId passing = first ? add_wall() : 0;
      const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
      if (!first) passing = add_wall();
      Walker& walker = stage.add({.radius = 0.3}, Mode::walk, {0.0, 0.0, 0.5});
      stage.scene.space.set_velocity(lift, {{1.0, 0.0, 0.0}});
      stage.advance();
      stage.step(walker, {.jump = true});
      for (int i = 0; i < 12; ++i) {
        stage.advance();
        stage.step(walker);
      }
      const Vec3 place = walker.position() + Vec3(dt, 0.0, 0.0);
      const double face = beside + 0.01;
      stage.scene.space.set_pose(passing, {place + (stays ? Vec3(0.0, face + 1.5, 0.0) : Vec3(-2.0, face, 0.0))});
      stage.scene.space.set_velocity(passing, {stays ? Vec3(0.0, -1.5 / dt, 0.0) : Vec3(4.0 / dt, 0.0, 0.0)});
      stage.step(walker, {}, 0.0);
      ASSERT_TRUE(roam::move_instances(stage.scene.space, stage.list, dt).empty());
      const roam::StepReport& r = walker.report();
      ASSERT_GT(r.to.x, r.from.x);
      EXPECT_NEAR(r.least_axis_clearance, beside, 2.5e-3 + 0.25 * 0.05) << first << stays;
      EXPECT_LE(r.least_gap, beside - 0.3 + 1e-6) << first << stays;
      double least = r.axis_clearance;
      for (const roam::Segment& s : r.segments) least = std::min(least, s.axis_clearance);
      EXPECT_EQ(r.least_axis_clearance, least);
    }
  }
}

TEST(MoveReports, KeepAReportWithinItsRoom) {
  Stage stage(ground());
  const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {0.5, 0.0, 0.5});
  stage.scene.space.set_velocity(id, {{8.0, 0.0, 0.0}});
  EXPECT_TRUE(stage.advance(1.0).empty());
  EXPECT_LE(walker.report().segments.size(), 2U);  // straight on
  EXPECT_NEAR(walker.report().elapsed, 1.0, 1e-12);
  EXPECT_NEAR(glm::length(walker.velocity() - Vec3(8.0, 0.0, 0.0)), 0.0, 1e-6);
  stage.scene.space.set_velocity(id, {{1.0, 0.0, 0.0}, 1.0});
  EXPECT_TRUE(stage.advance(0.5).empty());
  EXPECT_LE(walker.report().segments.total(), walker.report().segments.size());
  EXPECT_EQ(walker.report().segments.back().position, walker.position());
}

TEST(MoveReports, GoOnInTimeWhereTwoInstancesPushOneBody) {
  Stage stage(ground());
  Mesh along_y, along_x;
  scenes::add_box(along_y, {-0.1, -1.0, 0.0}, {0.1, 1.0, 2.0});
  scenes::add_box(along_x, {-1.0, -0.1, 0.0}, {1.0, 0.1, 2.0});
  const ObjectId one = stage.scene.add(along_y, {{-0.5, 0.0, 0.0}});
  const ObjectId other = stage.scene.add(along_x, {{0.0, -0.5, 0.0}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.0});
  stage.scene.space.set_velocity(one, {{2.0, 0.0, 0.0}});
  stage.scene.space.set_velocity(other, {{0.0, 2.0, 0.0}});
  EXPECT_TRUE(
      roam::move_instances(stage.scene.space, stage.list, 0.2).empty());  // one after the other: not judged in time
  const auto& segments = walker.report().segments;
  EXPECT_GT(walker.position().x, 0.1);
  EXPECT_GT(walker.position().y, 0.1);
  ASSERT_GE(segments.size(), 2U);
  for (std::size_t i = 1; i < segments.size(); ++i) EXPECT_GE(segments[i].time, segments[i - 1].time) << i;
  EXPECT_LE(segments.back().time, 0.2);
}

TEST(MoveReports, KeepThePaceOfABodyThatIsBlockedInATrain) {
  Stage stage(ground());
  const ObjectId train = stage.scene.add(car(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.8, 0.5});
  stage.scene.space.set_velocity(train, {{10.0, 0.0, 0.0}});
  const roam::WalkerInput wish{.velocity = {0.0, 2.0, 0.0}, .acceleration = 4.0, .braking = 4.0};
  stage.run(2.0, wish);
  ASSERT_TRUE(walker.report().blocked);
  EXPECT_LT(glm::length(walker.pace()), 0.1);
  stage.advance();
  EXPECT_LT(glm::length(walker.pace()), 0.1);
}

TEST(MoveReports, TellNoFallOfAHopOnALiftThatGoesDown) {
  Stage stage(ground());
  const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 30.0}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 30.0});
  stage.scene.space.set_velocity(lift, {{0.0, 0.0, -4.0}});
  stage.run(0.5);
  for (int i = 0; i < 60; ++i) {
    stage.advance();
    stage.step(walker, {.jump = i == 0});
    ASSERT_FALSE(walker.report().has(roam::EventKind::fell)) << i;
  }
  EXPECT_EQ(walker.stance().object, lift);
}

TEST(MoveReports, ForgetATrainWhenTheDiscCarries) {
  Mesh m;  // slats, which carry a foot and no body
  for (int i = 0; i < 40; ++i) scenes::add_floor(m, 4.0 + 0.5 * i, -5.0, 4.02 + 0.5 * i, 5.0, 0.0);
  scenes::add_floor(m, -50.0, -50.0, 50.0, 50.0, -9.0);
  Stage stage(m);
  const ObjectId id = stage.scene.add(plate(), {{1.9, 0.0, 0.0}});
  Walker& walker = stage.add({.radius = 0.2, .support_radius = 0.4}, Mode::walk, {1.0, 0.0, 0.0});
  stage.scene.space.set_velocity(id, {{0.0, 0.01, 0.0}});
  stage.run(3.5, {.velocity = {1.4, 0.0, 0.0}});
  ASSERT_GT(walker.position().x, 4.5);
  ASSERT_TRUE(walker.grounded());
  EXPECT_EQ(walker.stance().object, 0U);
  EXPECT_EQ(walker.report().ground_velocity, Vec3(0.0));
}

}  // namespace
