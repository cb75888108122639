// Instances that move carry bodies, push them and stop for them, and at no instant does anything touch more than it
// may.

#include "roam/move_instances.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "posed_scenes.h"
#include "roam/filtered.h"

namespace {

using posed::Scene;
using roam::Mesh;
using roam::Mode;
using roam::ObjectId;
using roam::Pose;
using roam::Stopped;
using roam::Vec3;
using roam::Walker;
using roam::WalkerSettings;

constexpr double dt = 1.0 / 60.0;

/// Where a body was some seconds after a call began; `height` and `radius` as they were then.
struct At {
  Vec3 place;
  double height, radius;
};
At at_time(const roam::StepReport& r, double time) {
  At at{r.from, r.height, r.radius};
  double begin = 0.0;
  for (const roam::Segment& c : r.segments) {
    at.height = c.height;
    at.radius = c.radius;
    if (c.time >= time) {
      const double part = c.time > begin ? std::max(0.0, time - begin) / (c.time - begin) : 1.0;
      at.place += part * (c.position - at.place);
      return at;
    }
    at.place = c.position;
    begin = c.time;
  }
  return at;
}

/// A scene that moves, the bodies in it, and the judge of both.
struct Stage {
  Scene scene;
  std::vector<std::unique_ptr<Walker>> walkers;
  std::vector<Walker*> list;
  int samples = 8;  ///< instants of each movement that are judged

  explicit Stage(Mesh still) : scene(std::move(still)) {}

  Walker& add(const WalkerSettings& settings, Mode mode, const Vec3& feet) {
    walkers.push_back(std::make_unique<Walker>(scene.space, settings, mode, feet + Vec3(0.0, 0.0, 1.0)));
    walkers.back()->place_feet(feet);
    list.push_back(walkers.back().get());
    return *walkers.back();
  }

  /// The triangles as they are after a part of a movement.
  [[nodiscard]] Mesh posed(const std::vector<Pose>& from, double part) const {
    Mesh all = scene.still;
    for (std::size_t i = 0; i < scene.parts.size(); ++i) {
      const Pose& to = scene.space.pose(scene.ids[i]);
      posed::append(all, scene.parts[i],
                    {from[i].position + part * (to.position - from[i].position),
                     from[i].heading + part * (to.heading - from[i].heading)});
    }
    return all;
  }

  /// Moves the instances. Judges every body at many instants where one instance alone moves.
  std::vector<Stopped> advance(double seconds = dt) {
    std::vector<Pose> poses;
    int moving = 0;
    for (const ObjectId id : scene.ids) {
      poses.push_back(scene.space.pose(id));
      const roam::Velocity& v = scene.space.velocity(id);
      moving += v.linear != Vec3(0.0) || v.turning != 0.0 ? 1 : 0;
    }
    std::vector<Vec3> before;
    for (const Walker* w : list) before.push_back(w->position());
    std::vector<Stopped> stopped = roam::move_instances(scene.space, list, seconds);
    const double moved = stopped.empty() ? seconds : stopped[0].time;
    for (int i = 0; i <= samples; ++i) {
      if (moving != 1 && i != samples) continue;
      const double part = double(i) / samples;
      const Mesh all = posed(poses, part);
      const scenes::Judge judge(all);
      for (std::size_t k = 0; k < list.size(); ++k) {
        const Walker& w = *list[k];
        if (w.mode() == Mode::ghost || w.held()) continue;
        const bool was_moved = w.position() != before[k];
        const At at =
            was_moved ? at_time(w.report(), part * moved) : At{w.position(), w.body().height(), w.body().radius};
        const double distance = judge.distance(roam::Body::capsule(at.radius, at.height), at.place, at.radius + 0.1);
        EXPECT_GE(distance, at.radius - 1.1e-6) << "body " << k << " at " << part << " of the movement";
        if (was_moved) {
          EXPECT_GE(distance, std::min(w.report().least_gap, 0.1) + at.radius - 1.1e-6);
        }
      }
    }
    return stopped;
  }
  void step(Walker& walker, const roam::WalkerInput& input = {}, double seconds = dt) {
    const roam::StepReport& r = walker.step(input, seconds);
    const Mesh all = scene.whole();
    EXPECT_GE(scenes::margin(scenes::Judge(all), r), -1e-7);
  }
  void run(double seconds, const roam::WalkerInput& input = {}) {
    for (double t = 0.0; t < seconds - 0.5 * dt; t += dt) {
      advance();
      for (Walker* w : list) step(*w, input);
    }
  }
};

Mesh ground() {
  Mesh m;
  scenes::add_floor(m, -50.0, -50.0, 50.0, 50.0, 0.0);
  return m;
}

/// A plate of 4 m by 4 m and 0.2 m, its top at 0, about its origin.
Mesh plate() {
  Mesh m;
  scenes::add_box(m, {-2.0, -2.0, -0.2}, {2.0, 2.0, 0.0});
  return m;
}

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

TEST(MoveInstances, KeepsTheVelocityOfTheGroundInTheAir) {
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

TEST(MoveInstances, ThrowsABodyHigherThatJumpsFromARisingLift) {
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

TEST(MoveInstances, LetsABodyJumpAsHighAsEverFromWhatRises) {
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

TEST(MoveInstances, TellTheVelocityInTheSceneAndThePaceOnTheGround) {
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

/// A door leaf of 1 m by 2.1 m, 4 cm thick, its hinge at the origin.
Mesh door() {
  Mesh m;
  scenes::add_box(m, {0.0, -0.02, 0.02}, {1.0, 0.02, 2.1});
  return m;
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

/// A car of 12 m by 3 m by 2.5 m with walls, floor at 0, seats in rows.
Mesh car() {
  Mesh m;
  scenes::add_box(m, {-6.0, -1.5, 0.0}, {6.0, 1.5, 2.5});
  for (int i = 0; i < 4; ++i) scenes::add_box(m, {-4.0 + 2.0 * i, -1.5, 0.0}, {-3.4 + 2.0 * i, -0.5, 0.45});
  return m;
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
