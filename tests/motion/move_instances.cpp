// Instances that move carry bodies, push them and stop for them, and at no instant does anything touch more than it
// may.

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "motion/instance_motion.h"
#include "moving_stage.h"
#include "roam/filtered.h"

namespace {

using namespace moving;

TEST(MoveInstances, LiftsABodyAndLetsItDown) {
  Stage stage(ground());
  const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {0.5, 0.3, 0.5});
  ASSERT_EQ(walker.stance().object, lift);
  const double above = walker.feet().z - 0.5;
  stage.scene.space.set_velocity(lift, {{0.0, 0.0, 1.5}});
  stage.run(2.0);
  EXPECT_NEAR(walker.feet().z - stage.scene.space.pose(lift).position.z, above, 1e-3);
  EXPECT_NEAR(stage.scene.space.pose(lift).position.z, 3.5, 1e-9);
  EXPECT_EQ(walker.stance().ground_velocity, Vec3(0.0, 0.0, 1.5));
  EXPECT_EQ(walker.report().ground_velocity, Vec3(0.0, 0.0, 1.5));
  EXPECT_FALSE(walker.report().has(roam::EventKind::fell));
  stage.scene.space.set_velocity(lift, {{0.0, 0.0, -1.5}});
  stage.run(1.5);
  EXPECT_NEAR(walker.feet().z, 1.25 + above, 1e-3);
  EXPECT_TRUE(walker.grounded());
  stage.scene.space.set_velocity(lift, {});
  stage.run(0.1);
  EXPECT_EQ(walker.report().ground_velocity, Vec3(0.0));
}

TEST(MoveInstances, CarriesABodySidewaysAndRound) {
  Stage stage(ground());
  const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {1.2, 0.3, 0.5});
  const Vec3 seen = stage.scene.space.pose(id).to_instance(walker.feet());
  stage.scene.space.set_velocity(id, {{2.0, -1.0, 0.3}, 0.7});
  stage.run(3.0);
  const Pose& pose = stage.scene.space.pose(id);
  EXPECT_NEAR(glm::length(pose.to_instance(walker.feet()) - seen), 0.0, 2e-3);
  EXPECT_GT(pose.position.x, 5.9);
  const Vec3 velocity = walker.report().ground_velocity;
  EXPECT_NEAR(glm::length(velocity - stage.scene.space.velocity(id).at(pose, walker.feet())), 0.0, 1e-9);
}

TEST(MoveInstances, CarriesABodyAlongAWallIntoACorner) {
  for (const double lean : {-0.1, 0.0, 0.1}) {
    Mesh m = ground();
    scenes::add_quad(m, {3.0, -5.0, 0.0}, {3.0, 2.0, 0.0}, {3.0 + 4.0 * lean, 2.0, 4.0}, {3.0 + 4.0 * lean, -5.0, 4.0});
    scenes::add_wall(m, -5.0, 2.0, 5.0, 2.0, 0.0, 4.0);
    Stage stage(m);
    const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
    Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.5});
    stage.scene.space.set_velocity(id, {{1.0, 0.5, 0.0}});
    stage.run(3.2);
    EXPECT_GT(walker.position().x, 2.4) << lean;
    EXPECT_NEAR(walker.position().y, 1.6, 0.02) << lean;
    stage.run(0.8);
    EXPECT_NEAR(walker.position().y, 1.7, 2e-3) << lean;
    EXPECT_NEAR(walker.feet().z, 0.5, 2e-3) << lean;
    EXPECT_EQ(walker.stance().object, id) << lean;
  }
}

TEST(MoveInstances, LetsABodyDownOntoASlopeOnWhichItStands) {
  for (const double degrees : {10.0, 20.0, 40.0}) {
    const double rise = 50.0 * std::tan(degrees * std::numbers::pi / 180.0);
    Mesh m;
    scenes::add_quad(m, {-50.0, -50.0, -rise}, {50.0, -50.0, rise}, {50.0, 50.0, rise}, {-50.0, 50.0, -rise});
    Stage stage(m);
    const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 1.5}});
    Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 1.5});
    stage.scene.space.set_velocity(lift, {{0.0, 0.0, -1.5}});
    stage.run(2.0);
    EXPECT_TRUE(walker.grounded());
    EXPECT_LT(walker.feet().z, 0.2) << degrees;
    EXPECT_NEAR(walker.position().x, 0.0, 1e-3) << degrees;
  }
}

TEST(MoveInstances, LetsABodyWalkOnWhatMoves) {
  Stage stage(ground());
  const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.25}});
  Walker& walker = stage.add({}, Mode::walk, {-1.5, 0.0, 0.25});
  stage.scene.space.set_velocity(id, {{0.0, 3.0, 0.0}});
  stage.run(2.0, {.velocity = {1.0, 0.0, 0.0}});
  EXPECT_NEAR(walker.position().x, 0.5, 0.01);
  EXPECT_NEAR(walker.position().y, 6.0, 0.01);
  // It steps off onto the ground, which stands still.
  stage.run(3.0, {.velocity = {1.0, 0.0, 0.0}});
  EXPECT_EQ(walker.stance().object, 0U);
  EXPECT_EQ(walker.report().ground_velocity, Vec3(0.0));
}

TEST(MoveInstances, PushesABodyThatADoorMeets) {
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    Stage stage(ground());
    const ObjectId id = stage.scene.add(door(), {});
    Walker& walker = stage.add({}, mode, {0.7, 0.6, 0.01});
    stage.scene.space.set_velocity(id, {{}, 1.5});
    stage.run(1.0);
    const Pose& pose = stage.scene.space.pose(id);
    EXPECT_NEAR(pose.heading, 1.5, 1e-9);
    EXPECT_LT(walker.position().x, 0.5);
    EXPECT_GT(pose.to_instance(walker.position()).y, 0.3);
    EXPECT_FALSE(walker.held());
  }
}

TEST(MoveInstances, StopsADoorThatWouldCrushABody) {
  Mesh m = ground();
  scenes::add_wall(m, 0.0, 1.0, 5.0, 1.0, 0.0, 3.0);
  scenes::add_wall(m, 0.2, 0.4, 0.2, 1.0, 0.0, 3.0);
  Stage stage(m);
  const ObjectId id = stage.scene.add(door(), {});
  Walker& walker = stage.add({}, Mode::walk, {0.6, 0.6, 0.0});
  stage.scene.space.set_velocity(id, {{}, 1.0});
  bool stopped = false;
  for (int i = 0; i < 120; ++i) {
    for (const Stopped& stop : stage.advance()) {
      stopped = true;
      EXPECT_EQ(stop.instance, id);
      EXPECT_EQ(stop.walker, 0U);
      EXPECT_LT(stop.time, dt);
    }
    stage.step(walker);
  }
  EXPECT_TRUE(stopped);
  EXPECT_FALSE(walker.held());
  const double heading = stage.scene.space.pose(id).heading;
  EXPECT_GT(heading, 0.1);
  EXPECT_LT(heading, 1.2);
  // The other way it is free.
  stage.scene.space.set_velocity(id, {{}, -1.0});
  for (int i = 0; i < 20; ++i) EXPECT_TRUE(stage.advance().empty());
  EXPECT_LT(stage.scene.space.pose(id).heading, heading - 0.3);
}

TEST(MoveInstances, SqueezesABodyOutAlongAWallThatIsNotTooSteep) {
  for (const double degrees : {25.0, 45.0, 58.0, 62.0}) {
    // Five centimetres before a wall along `t`, and half a millimetre before a piston that goes along x.
    const double angle = degrees * std::numbers::pi / 180.0;
    const Vec3 t(std::cos(angle), std::sin(angle), 0.0), away(-t.y, t.x, 0.0);
    const Vec3 from = -0.35 * away - 0.3 * t, to = -0.35 * away + 10.0 * t;
    Mesh wall, piston;
    scenes::add_wall(wall, from.x, from.y, to.x, to.y, -3.0, 3.0);
    scenes::add_box(piston, {-0.1, -5.0, -2.0}, {0.0, 5.0, 2.0});
    Stage stage(wall);
    const ObjectId id = stage.scene.add(piston, {{-0.3005, 0.0, 0.0}});
    Walker& walker = stage.add({}, Mode::fly, {0.0, 0.0, -0.9});
    bool stopped = false;
    for (int i = 0; i < 80; ++i) {
      // In the end it moves by less than a skin at a time.
      stage.scene.space.set_velocity(id, {{i < 60 ? 0.5 : 0.005, 0.0, 0.0}});
      stopped |= !stage.advance().empty();
      ASSERT_NEAR(walker.position().x - stage.scene.space.pose(id).position.x, 0.3005, 1.2e-3)
          << degrees << " at " << i;
    }
    EXPECT_EQ(stopped, degrees > 60.0) << degrees;
    EXPECT_NEAR(glm::dot(walker.position(), away), -0.05, 2e-3) << degrees;
  }
}

TEST(MoveInstances, StopsALiftUnderACeiling) {
  Mesh m = ground();
  scenes::add_floor(m, -3.0, -3.0, 3.0, 3.0, 4.0);
  Stage stage(m);
  const ObjectId lift = stage.scene.add(plate(), {{0.0, 0.0, 0.5}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.5});
  stage.scene.space.set_velocity(lift, {{0.0, 0.0, 1.0}});
  bool stopped = false;
  for (int i = 0; i < 200; ++i) {
    stopped |= !stage.advance().empty();
    stage.step(walker);
  }
  EXPECT_TRUE(stopped);
  EXPECT_FALSE(walker.held());
  EXPECT_NEAR(stage.scene.space.pose(lift).position.z, 4.0 - 1.8, 0.02);
  EXPECT_EQ(walker.report().ground_velocity, Vec3(0.0));
}

TEST(MoveInstances, SweepsABodyOffWhatPassesUnderABridge) {
  Mesh m = ground();
  scenes::add_wall(m, 5.0, -3.0, 5.0, 3.0, 1.0, 4.0);
  Stage stage(m);
  const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.9}});
  Walker& walker = stage.add({}, Mode::walk, {1.0, 0.0, 0.9});
  stage.scene.space.set_velocity(id, {{3.0, 0.0, 0.0}});
  stage.run(4.0);
  EXPECT_NEAR(stage.scene.space.pose(id).position.x, 12.0, 1e-9);
  EXPECT_LT(walker.position().x, 4.8);
  EXPECT_EQ(walker.stance().object, 0U);
}

TEST(MoveInstances, TakesAFastTrainWithEverybodyInIt) {
  Stage stage(ground());
  const ObjectId train = stage.scene.add(car(), {{-40.0, 0.0, 0.5}});
  clutter::Random random(31);
  for (int i = 0; i < 3; ++i) stage.add({.radius = 0.25}, Mode::walk, {-43.0 + 2.0 * i, 0.6, 0.5});
  stage.samples = 3;
  for (int frame = 0; frame < 150; ++frame) {
    stage.scene.space.set_velocity(train, {{std::min(60.0, 0.5 * frame), 0.0, 0.0}, frame > 75 ? 0.3 : 0.0});
    ASSERT_TRUE(stage.advance().empty()) << "frame " << frame;
    for (Walker* w : stage.list) {
      const Vec3 wish = 2.0 * random.in_box(1.0);
      stage.step(*w, {.velocity = {wish.x, wish.y, 0.0}, .jump = random.unit() < 0.1});
      const Vec3 seen = stage.scene.space.pose(train).to_instance(w->position());
      ASSERT_LT(std::abs(seen.x), 6.0);
      ASSERT_LT(std::abs(seen.y), 1.5);
      ASSERT_FALSE(w->held());
    }
  }
}

TEST(MoveInstances, NeverLetsAnythingTouchInARandomScene) {
  long stops = 0, carried = 0;
  for (int seed = 0; seed < 6; ++seed) {
    clutter::Random random(40 + seed);
    Mesh m;
    scenes::add_box(m, {-6.0, -6.0, 0.0}, {6.0, 6.0, 4.0});
    for (int i = 0; i < 5; ++i) {
      const Vec3 at(random.between(-5.0, 5.0), random.between(-5.0, 5.0), 0.0);
      scenes::add_box(m, at, at + Vec3(random.between(0.1, 2.0), random.between(0.1, 2.0), random.between(0.1, 3.0)));
    }
    Stage stage(m);
    stage.samples = 2;
    for (int i = 0; i < 4; ++i) {
      stage.scene.add(i % 2 == 0 ? plate() : door(),
                      {{random.between(-3.0, 3.0), random.between(-3.0, 3.0), random.between(0.2, 2.0)},
                       random.between(-3.0, 3.0)});
    }
    for (int i = 0; i < 4; ++i) {
      stage.add({.radius = random.between(0.1, 0.35)}, i < 3 ? Mode::walk : Mode::fly,
                {random.between(-5.0, 5.0), random.between(-5.0, 5.0), 2.1});
    }
    for (int frame = 0; frame < 240; ++frame) {
      // One instance at a time, so that every instant can be judged.
      for (std::size_t k = 0; k < stage.scene.ids.size(); ++k) {
        const bool mine = static_cast<std::size_t>(frame / 40) % stage.scene.ids.size() == k;
        roam::Velocity v;
        if (mine && frame % 40 == 0) v = {1.5 * random.in_box(1.0), random.between(-1.5, 1.5)};
        if (!mine || frame % 40 == 0) stage.scene.space.set_velocity(stage.scene.ids[k], v);
      }
      stops += static_cast<long>(stage.advance().size());
      for (Walker* w : stage.list) {
        carried += w->report().ground_velocity != Vec3(0.0) ? 1 : 0;
        const Vec3 wish = 3.0 * random.in_box(1.0);
        stage.step(*w, {.velocity = wish, .jump = random.unit() < 0.05});
      }
      if (HasFailure()) FAIL() << "seed " << seed << " frame " << frame;
    }
  }
  EXPECT_GT(stops, 10);
  EXPECT_GT(carried, 100);
}

TEST(MoveInstances, MeetBodiesOfAnySizeFromAnyDistance) {
  long moved = 0, stops = 0;
  for (int seed = 0; seed < 3000; ++seed) {
    clutter::Random random(11000 + seed);
    const auto some = [&](double least, double most) { return least * std::pow(most / least, random.unit()); };
    const double radius = some(0.05, 3.0), away = some(0.1, 100.0), half = some(0.05, 2.0);
    Stage stage(Mesh{});
    Walker& walker = stage.add(WalkerSettings::person(radius, radius * random.between(2.0, 6.0)), Mode::fly, Vec3(0.0));
    Mesh block;
    const Vec3 at(away, 0.0, 0.0);
    scenes::add_box(block, at - Vec3(half), at + Vec3(half));
    const double heading = random.between(-3.0, 3.0);
    const Vec3 beside = walker.position() + random.between(1.0, 3.0) * (radius + half) * random.direction();
    const Pose pose{beside - Pose{Vec3(0.0), heading}.to_scene(at), heading};
    const ObjectId id = stage.scene.add(block, pose);
    stage.scene.space.set_velocity(id, {some(0.01, 3.0) * (radius + half) * random.direction(),
                                        random.between(-3.0, 3.0) * (radius + half) / (away + half)});
    if (!stage.scene.space.fits(walker.body(), walker.position())) continue;
    for (int frame = 0; frame < 8; ++frame) {
      const Vec3 before = walker.position();
      stops += static_cast<long>(stage.advance(0.15).size());
      moved += walker.position() != before ? 1 : 0;
      if (HasFailure())
        FAIL() << "seed " << seed << " frame " << frame << " radius " << radius << ", " << away << " m away";
    }
  }
  EXPECT_GT(moved, 1000);
  EXPECT_GT(stops, 20);
}

TEST(MoveInstances, AreNotStoppedByABodyOutOfTheirReach) {
  for (const double reach : {0.0, 1.0, 100.0}) {
    Stage stage(Mesh{});
    Mesh bar;
    scenes::add_box(bar, {-0.5, -0.05, -0.05}, {0.5, 0.05, 0.05});
    const ObjectId id = stage.scene.add(bar, {});
    stage.add({.clearance_reach = reach}, Mode::fly, {3.0, 0.0, -0.9});
    stage.scene.space.set_velocity(id, {{}, 1000.0});
    EXPECT_TRUE(roam::move_instances(stage.scene.space, stage.list, 1.0).empty()) << reach;
    EXPECT_EQ(stage.scene.space.pose(id).heading, 1000.0);
  }
}

TEST(MoveInstances, BoundTheArcOfWhatTurnsAndMovesAtOnce) {
  clutter::Random random(33);
  for (int i = 0; i < 2000; ++i) {
    const auto some = [&](double least, double most) {
      return least * std::pow(most / least, random.unit()) * random.direction();
    };
    roam::walking::InstanceMotion shift;
    shift.from = {some(0.1, 10.0), random.between(-3.0, 3.0)};
    shift.to = {shift.from.position + some(1e-3, 10.0), shift.from.heading + random.between(-1.0, 1.0)};
    const Vec3 point = shift.from.position + some(1e-2, 10.0), way = some(1e-3, 10.0);
    const Vec3 begin = shift.from.to_instance(point), end = shift.to.to_instance(point + way);
    const double bulge = shift.bulge(point, way);
    for (double t = 0.0; t <= 1.0; t += 0.125) {
      const Pose pose{shift.from.position + t * (shift.to.position - shift.from.position),
                      shift.from.heading + t * (shift.to.heading - shift.from.heading)};
      const Vec3 chord = begin + t * (end - begin);
      ASSERT_LE(glm::length(pose.to_instance(point + t * way) - chord), bulge + 1e-12) << i << " at " << t;
    }
  }
}

TEST(MoveInstances, FreesAHeldBodyWhenWhatHoldsItGoes) {
  Mesh thicket;
  for (int i = -20; i <= 20; ++i) {
    scenes::add_wall(thicket, 0.1 * i, -2.0, 0.1 * i, 2.0, 0.0, 3.0);
    scenes::add_wall(thicket, -2.0, 0.1 * i, 2.0, 0.1 * i, 0.0, 3.0);
  }
  Stage stage(Mesh{});
  const ObjectId id = stage.scene.add(thicket, {});
  Walker& walker = stage.add({}, Mode::fly, {0.0, 0.0, 1.0});
  ASSERT_TRUE(walker.held());
  stage.scene.space.set_velocity(id, {{0.0, 3.0, 0.0}});
  for (int i = 0; i < 120; ++i) {
    roam::move_instances(stage.scene.space, stage.list, dt);
    walker.step({}, dt);
  }
  EXPECT_FALSE(walker.held());
}

TEST(MoveInstances, MoveFarFromTheirOrigin) {
  Stage stage(ground());
  Mesh far = door();
  scenes::shift(far, {3e6, 0.0, 0.0});
  const ObjectId id = stage.scene.space.add(posed::shared(far), {{0.0, 5e6, 0.0}});
  Walker& walker = stage.add({}, Mode::walk, {0.0, 0.0, 0.0});
  stage.scene.space.set_velocity(id, {{}, 1.0});
  EXPECT_TRUE(roam::move_instances(stage.scene.space, stage.list, 1.0).empty());
  EXPECT_FALSE(walker.held());
  stage.scene.space.set_velocity(id, {{1e9, 0.0, 0.0}});
  EXPECT_THROW(roam::move_instances(stage.scene.space, stage.list, 10.0), roam::Error);
}

TEST(MoveInstances, LeavesGhostsAndThoseWhoIgnoreADoor) {
  Stage stage(ground());
  const ObjectId id = stage.scene.add(door(), {});
  Walker& ghost = stage.add({}, Mode::ghost, {0.7, 0.5, 0.0});
  roam::Filtered open(stage.scene.space);
  open.ignore(id);
  Walker through(open, {}, Mode::walk, {0.7, 0.5, 1.0});
  Walker* const both[] = {&ghost, nullptr, &through};
  const Vec3 a = ghost.position(), b = through.position();
  stage.scene.space.set_velocity(id, {{}, 1.5});
  EXPECT_TRUE(roam::move_instances(stage.scene.space, both, 1.0).empty());
  EXPECT_EQ(ghost.position(), a);
  EXPECT_EQ(through.position(), b);
}

TEST(MoveInstances, RefusesWhatCannotBe) {
  Stage stage(ground());
  Stage other(ground());
  const ObjectId id = stage.scene.add(door(), {});
  stage.scene.space.set_velocity(id, {{1.0, 0.0, 0.0}});
  Walker* const stranger[] = {&other.add({}, Mode::walk, {0.0, 0.0, 0.0})};
  EXPECT_THROW(roam::move_instances(stage.scene.space, stranger, dt), roam::Error);
  Walker* const twice[] = {&stage.add({}, Mode::walk, {5.0, 0.0, 0.0}), stage.list[0]};
  EXPECT_THROW(roam::move_instances(stage.scene.space, twice, dt), roam::Error);
  EXPECT_THROW(roam::move_instances(stage.scene.space, {}, -1.0), roam::Error);
  EXPECT_THROW(roam::move_instances(stage.scene.space, {}, std::numeric_limits<double>::infinity()), roam::Error);
  EXPECT_EQ(stage.scene.space.pose(id).position, Vec3(0.0));
  EXPECT_TRUE(roam::move_instances(stage.scene.space, {}, 2.0).empty());
  EXPECT_EQ(stage.scene.space.pose(id).position, Vec3(2.0, 0.0, 0.0));
}

TEST(MoveInstances, GivesTheSameBitsAgain) {
  const auto run = [] {
    Stage stage(ground());
    stage.samples = 1;
    const ObjectId id = stage.scene.add(plate(), {{0.0, 0.0, 0.3}});
    Walker& walker = stage.add({}, Mode::walk, {0.5, 0.0, 0.3});
    stage.scene.space.set_velocity(id, {{1.0, 0.2, 0.1}, 0.5});
    stage.run(1.0, {.velocity = {0.3, 0.4, 0.0}});
    return walker.position();
  };
  EXPECT_EQ(run(), run());
}

}  // namespace
