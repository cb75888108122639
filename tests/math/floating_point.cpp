// The core in every floating-point environment of a host: the same bits, no signal, and the environment as it was.

#include <gtest/gtest.h>
#include <tbb/parallel_for.h>

#include <cstdint>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clutter.h"
#include "motion/carrying.h"
#include "roam/instances.h"
#include "roam/move_instances.h"
#include "roam/opening.h"
#include "roam/patchwork.h"
#include "roam/route.h"
#include "roam/standing.h"
#include "roam/walker.h"
#include "roam/wander.h"
#include "roam/world.h"
#include "same_bits.h"
#include "world/nearby.h"

namespace {

using roam::Vec3;
using same_bits::Bits;
using same_bits::expect_same;

struct Query {
  roam::Body body;
  Vec3 from{0.0}, motion{0.0};
};

struct Case {
  const char* name;
  Vec3 centre;
  double reach;
};
const Case cases[] = {{"at the origin", {0.0, 0.0, 0.0}, 1.0}, {"far away", {6.4e6, -3.1e6, 812.0}, 0.05}};

std::vector<Query> queries_about(const Vec3& centre, int count) {
  clutter::Random random(5);
  std::vector<Query> queries;
  for (int i = 0; i < count; ++i) {
    Query q;
    q.body = i % 3 == 0 ? roam::Body{0.0, 0.0} : roam::Body{random.between(0.05, 0.7), i % 3 == 1 ? 0.0 : 0.6};
    q.from = centre + random.in_box(5.0);
    // Now and then longer than one piece, and of subnormal length.
    q.motion = random.direction() * (i % 17 == 0 ? 150.0 : i % 13 == 0 ? 1e-310 : random.between(0.1, 8.0));
    queries.push_back(q);
  }
  return queries;
}

roam::Mesh clutter_at(const Vec3& centre, int count = 900) {
  clutter::Random random(7);
  roam::Mesh mesh = clutter::make(random, {.count = count, .half = 5.0, .small = 0.05, .large = 3.0, .centre = centre});
  return mesh;
}

/// Everything that a space answers.
void ask(const roam::Space& space, const std::vector<Query>& queries, double reach, Bits& bits) {
  roam::Vicinity vicinity;
  roam::Contact contacts[16];
  for (const Query& q : queries) {
    bits(space.sweep(q.body, q.from, q.motion));
    const std::size_t count = space.contacts(q.body, q.from, q.motion, reach, contacts);
    for (std::size_t i = 0; i < count; ++i) bits(contacts[i]);
    bits(space.clearance(q.body, q.from, q.motion, reach));
    bits(space.clearance(q.body, q.from, reach));
    bits(space.floor_clearance(q.body, q.from, reach, {.slope_degrees = 40.0}));
    bits(space.gap_bound(q.body, q.from, q.motion, reach));
    const roam::FirstImpact first = space.first_impact(q.body, q.from, q.motion);
    bits(first.time);
    bits(space.completed({q.body, q.from, q.motion}, first));
    bits(roam::Nearby::sweep(space, vicinity, {q.body, q.from, q.motion}));
    bits(roam::Nearby::gap_bound(space, vicinity, {q.body, q.from, q.motion}, reach));
  }
}

TEST(FloatingPoint, SweepsOfOneTriangle) {
  const roam::Mesh mesh = clutter_at(Vec3(0.0));
  const std::vector<Query> queries = queries_about(Vec3(0.0), static_cast<int>(mesh.triangles.size()));
  std::vector<roam::Triangle> triangles;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles.push_back(mesh.triangle(i));
  expect_same([&](Bits& bits) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const roam::SweepResult swept = roam::sweep(queries[i].body, queries[i].from, queries[i].motion, triangles[i]);
      bits(swept.time);
      bits(swept.point);
      bits(swept.distance);
      bits(roam::sweep(queries[i].body, queries[i].from, queries[i].motion, triangles[i], 0.7).time);
      bits(roam::proximity(queries[i].body, queries[i].from, triangles[i]));
    }
  });
}

TEST(FloatingPoint, QueriesOfAWorld) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    const roam::Mesh mesh = clutter_at(c.centre);
    const std::vector<Query> queries = queries_about(c.centre, 300);
    for (const bool lossless : {false, true}) {
      const roam::World world = roam::World::build({&mesh, 1}, {.threads = 0, .lossless = lossless, .progress = {}});
      expect_same([&](Bits& bits) { ask(world, queries, c.reach, bits); });
    }
  }
}

TEST(FloatingPoint, RefusesWhatIsNotFinite) {
  const roam::World world;
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Vec3 nowhere(nan, 0.0, 0.0);
  const roam::WalkerSettings wrong{.radius = nan};
  const roam::SizeRegion region{{nowhere, nowhere}, 0.2, 0.0, "nowhere"};
  const std::vector<std::function<void()>> calls{
      [&] { static_cast<void>(world.sweep({0.3}, nowhere, Vec3(1.0))); },
      [&] { static_cast<void>(world.sweep({-0.3}, Vec3(0.0), Vec3(1.0))); },
      [&] { roam::check(wrong); },
      [&] {
        roam::check({&region, 1}, {});
      },
      [&] { roam::check(roam::WalkerSettings::sphere(nan)); },
      [&] { roam::check(roam::WalkerSettings::person(nan, 1.7)); },
  };
  expect_same([&](Bits& bits) {
    std::uint64_t refused = 0;
    for (const auto& call : calls) {
      try {
        call();
      } catch (const roam::Error&) {
        ++refused;
      }
    }
    bits(refused);
  });
}

TEST(FloatingPoint, QueriesOfAPatchwork) {
  const std::vector<Query> queries = queries_about(Vec3(0.0), 200);
  const roam::Mesh mesh = clutter_at(Vec3(0.0));
  const roam::Box there{Vec3(-8.0), Vec3(8.0)}, unknown{Vec3(1.0, 2.0, 3.0), Vec3(2.5, 3.5, 4.5)};
  const roam::Body body{0.3, 0.5};
  const Vec3 place(0.1, 0.2, 0.3);
  expect_same([&](Bits& bits) {
    roam::Patchwork patchwork;
    const roam::PatchId patch = patchwork.expect(there);
    static_cast<void>(patchwork.expect(unknown));
    static_cast<void>(patchwork.update(body, place));
    patchwork.deliver(patch, roam::World::build({&mesh, 1}));
    static_cast<void>(patchwork.update(body, place));
    ask(patchwork, queries, 0.5, bits);
  });
}

/// The answers of a world tell how it was built.
TEST(FloatingPoint, BuildingAWorld) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    // Many tiles, so that all threads build some.
    const roam::Mesh mesh = clutter_at(c.centre, 60000);
    const std::vector<Query> queries = queries_about(c.centre, 30);
    expect_same([&](Bits& bits) {
      const roam::World world = roam::World::build({&mesh, 1});
      bits(world.largest_error());
      bits(world.bounds().lower);
      bits(world.bounds().upper);
      ask(world, queries, c.reach, bits);
    });
  }
}

/// Tasks of TBB have the environment of their arena: a host may have made one in its own.
TEST(FloatingPoint, BuildingAWorldInATaskOfTheHost) {
  const roam::Mesh mesh = clutter_at(Vec3(0.0), 20000);
  const std::vector<Query> queries = queries_about(Vec3(0.0), 30);
  expect_same([&](Bits& bits) {
    std::vector<std::optional<roam::World>> worlds(4);
    tbb::task_arena arena;
    arena.execute([&] {
      tbb::parallel_for(std::size_t{0}, worlds.size(), [&](std::size_t i) {
        worlds[i] = roam::World::build({&mesh, 1});
      });
    });
    for (const auto& world : worlds) ask(*world, queries, 0.5, bits);
  });
}

TEST(FloatingPoint, StepsOfWalkers) {
  for (const Case& c : cases) {
    SCOPED_TRACE(c.name);
    roam::Mesh mesh = clutter_at(c.centre, 60);
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (const Vec3& corner : {Vec3(-9, -9, 0.011), Vec3(9, -9, 0.3), Vec3(0.1, 12, -0.2)}) {
      mesh.vertices.push_back(c.centre + corner);
    }
    mesh.triangles.push_back({first, first + 1, first + 2});
    const roam::World world = roam::World::build({&mesh, 1});
    clutter::Random random(9);
    std::vector<Vec3> ways, wishes;
    for (int i = 0; i < 150; ++i) ways.push_back(random.direction());
    for (const Vec3& way : ways) wishes.push_back(1.7 * way);
    const std::vector<Vec3> starts{c.centre + Vec3(0.3, 0.4, 1.7), c.centre + Vec3(-1.3, 0.9, 2.7), c.centre};
    const roam::SizeRegion narrow{{c.centre - Vec3(1.0), c.centre + Vec3(1.0)}, 0.2, 0.0, "narrow"};
    constexpr double dt = 1.0 / 60.0;
    expect_same([&](Bits& bits) {
      for (const roam::Mode mode : {roam::Mode::walk, roam::Mode::fly, roam::Mode::ghost}) {
        for (const Vec3& start : starts) {
          roam::Walker walker(world, {}, mode, start);
          bits(walker.report());
          walker.set_regions({&narrow, 1});
          for (std::size_t i = 0; i < wishes.size(); ++i) {
            const Vec3& wish = wishes[i];
            bits(walker.step({.velocity = wish, .jump = wish.z > 1.0, .crouch = wish.z < -1.0}, dt));
            bits(walker.velocity());
            bits(walker.pace());
            if (const auto opening = roam::measure_opening(walker, ways[i])) bits(opening->width);
            bits(walker.feet());
            bits(walker.eye());
            bits(walker.body().half_height);
            bits(walker.rise_speed());
            bits(walker.fall_limit());
          }
          static_cast<void>(walker.resize(0.25, 0.4));
          bits(walker.report());
          bits(walker.place_feet(start));
          bits(walker.place(start));
          bits(walker.set_mode(roam::Mode::walk));
        }
      }
      bits(roam::wish_velocity({}, starts[0], true));
      bits(roam::WalkerSettings::person(0.31, 1.7).eye);
      bits(static_cast<std::uint64_t>(
          roam::carrying(world, {starts[0]}, {.radius = 0.4, .slope_degrees = 45.0}, starts[0])));
    });
  }
}

TEST(FloatingPoint, PosesOfInstances) {
  const roam::Mesh mesh = clutter_at(Vec3(0.0), 40);
  const roam::World world = roam::World::build({&mesh, 1});
  const auto door = std::make_shared<const roam::World>(roam::World::build({&mesh, 1}));
  clutter::Random random(4);
  std::vector<roam::Pose> poses;
  for (int i = 0; i < 20; ++i) poses.push_back({7.0 * random.direction(), 0.3 * i});
  expect_same([&](Bits& bits) {
    roam::Instances space(world);
    const roam::ObjectId id = space.add(door, poses[0]);
    for (const roam::Pose& pose : poses) {
      space.set_pose(id, pose);
      bits(pose.to_scene({0.1, 0.2, 0.3}));
      bits(pose.to_instance({0.1, 0.2, 0.3}));
      bits(roam::Velocity{{0.1, 0.2, 0.3}, 0.7}.at(pose, {1.1, 1.2, 1.3}));
      bits(space.sweep({.radius = 0.2}, {-6.0, -6.0, 1.0}, {12.0, 11.0, 0.3}).time);
    }
    roam::Walker walker(space, roam::WalkerSettings::sphere(0.2), roam::Mode::fly, {0.7, 0.6, 9.3});
    roam::Walker* const met[] = {&walker};
    space.set_pose(id, {{0.1, 0.2, 0.3}, 0.1});
    space.set_velocity(id, {{0.3, 0.2, 7.1}, 0.7});
    bits(static_cast<std::uint64_t>(roam::move_instances(space, met, 0.9).size()));
    bits(walker.report());
  });
}

TEST(FloatingPoint, Routes) {
  const roam::Mesh mesh = clutter_at(Vec3(0.0), 40);
  const roam::World world = roam::World::build({&mesh, 1});
  const std::vector<Vec3> way{{-6.0, -6.0, 1.0}, {0.1, 0.7, 0.3}, {6.0, 6.0, -1.0}};
  expect_same([&](Bits& bits) {
    roam::Walker walker(world, roam::WalkerSettings::sphere(0.2), roam::Mode::fly, way[0]);
    const roam::RouteResult result = roam::follow(walker, way);
    bits(result.length);
    bits(result.simulated);
    bits(result.least_axis_clearance);
    bits(result.end);
    const roam::WalkerSettings person;
    for (const Vec3& place : roam::standing(way, person)) bits(place);
    if (const auto place = roam::place_to_stand(world, person, way[1], 2.0)) bits(*place);
    const std::vector<Vec3> floors = roam::floor_samples({&mesh, 1});
    for (const Vec3& floor : floors) bits(floor);
    if (const auto start = roam::wander_start(world, person, roam::Mode::walk, floors, 3)) bits(start->room);
    bits(roam::open_direction(world, way[0], 9.3).yaw);
    roam::Wander wander(walker, {.seconds = 0.7});
    while (!wander.done()) {
      wander.look();
      bits(wander.advance());
    }
    bits(wander.result().length);
  });
}

}  // namespace
