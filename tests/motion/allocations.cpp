// Where memory runs out, a call of a walker throws and has changed nothing. Instrumented builds have an operator new of
// their own.
#include <gtest/gtest.h>

#include <array>
#include <optional>

#include "fallible_calls.h"
#include "moving_stage.h"
#include "roam/standing.h"
#include "roam/wander.h"
#include "walker_judged.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

using roam::SizeRegion;

TEST(WalkerAllocations, AWalkerIsMadeOrRefusedWhereverOneFails) {
  const scenes::World world = scenes::build(scenes::floor_mesh());
  const std::vector<SizeRegion> regions{
      {{{-1, -1, -1}, {1, 1, 3}}, 0.2, 0.0, "a reason that is too long for no allocation"}};
  fail_calls({{"Walker, its copy and its steps", [&] {
                 scenes::Walker walker(world, {}, scenes::Mode::walk, {0, 0, 1});
                 walker.set_regions(regions);
                 scenes::Walker copy(walker);
                 copy.resize(0.25, 0.4);
                 copy.set_mode(scenes::Mode::fly);
                 for (int i = 0; i < 9; ++i) copy.step({{1, 0, 0}}, scenes::frame);
                 walker = copy;
                 return std::string(Bits() << walker.position());
               }}});
}

TEST(WalkerAllocations, RegionsStayAsTheyWereWhereverOneFails) {
  const scenes::World world = scenes::build(scenes::floor_mesh());
  scenes::Walker walker(world, {}, scenes::Mode::walk, {0, 0, 1});
  const auto region = [](double radius) {
    return SizeRegion{{{-1, -1, -1}, {1, 1, 3}}, radius, 0.0, "a reason that is too long for no allocation"};
  };
  const std::vector<SizeRegion> before{region(0.2)}, wanted{region(0.25), region(0.1)};
  walker.set_regions(before);
  fail_calls({{"set_regions",
               [&] {
                 walker.set_regions(wanted);
                 return std::string("set");
               },
               [&](bool failed) {
                 ASSERT_EQ(walker.regions().size(), failed ? 1U : 2U);
                 EXPECT_EQ(walker.regions()[0].radius, failed ? 0.2 : 0.25);
                 EXPECT_EQ(walker.regions()[0].why, wanted[0].why);
                 walker.set_regions(before);
               }}});
}

std::string bits_of(const roam::RouteResult& result) {
  return Bits() << result.outcome << result.waypoints << result.steps << result.length << result.least_gap << result.end
                << result.events.size();
}

TEST(WalkerAllocations, RoutesAndSearchesThrowWhereverOneFails) {
  scenes::Mesh mesh = scenes::floor_mesh();
  scenes::add_wall(mesh, 3.0, -2.0, 3.0, 1.0, 0.0, 3.0);
  const scenes::World world = scenes::build(mesh);
  const roam::WalkerSettings person;
  const std::array<roam::Vec3, 3> path{{{0, 0, 0.9}, {2, 1.5, 0.9}, {5, 0, 0.9}}};
  std::optional<scenes::Walker> walker(std::in_place, world, person, scenes::Mode::walk, path[0]);
  const scenes::Judge judge(mesh);
  const auto stands_free = [&](bool) {
    ASSERT_FALSE(walker->held());
    EXPECT_GE(judge.distance(walker->body(), walker->position(), 1.0), walker->body().radius - 1e-6);
    walker.emplace(world, person, scenes::Mode::walk, path[0]);
  };
  fail_calls({
      {"follow", [&] { return bits_of(roam::follow(*walker, path)); }, stands_free},
      {"Route and its copy",
       [&] {
         roam::Route route(*walker, path);
         for (int i = 0; i < 90; ++i) route.advance();
         roam::Route copy(route);
         while (!copy.done()) copy.advance();
         return bits_of(copy.result());
       },
       stands_free},
      {"Wander and its copy",
       [&] {
         roam::Wander wander(*walker, {.seconds = 3.0});
         for (int i = 0; i < 60; ++i) wander.advance();
         roam::Wander copy(wander);
         while (!copy.done()) copy.advance();
         return bits_of(copy.result());
       },
       stands_free},
      {.name = "wander_start",
       .bits =
           [&] {
             const auto floors = roam::floor_samples({&mesh, 1}, 16);
             const auto start = roam::wander_start(world, person, scenes::Mode::walk, floors, 4);
             return std::string(Bits() << start->place << start->room << start->on_top);
           }},
      {"standing and place_to_stand",
       [&] {
         const auto place = roam::place_to_stand(world, person, {3.1, 0.5, 0.5}, 2.0);
         return std::string(Bits() << place.value() << roam::standing(path, person)[1]);
       }},
      {"body settings that are wrong",
       [&] { return refusal_of([&] { roam::check(roam::WalkerSettings{.radius = -1.0}); }); }},
  });
}

TEST(WalkerAllocations, InstancesMoveWithTheirBodiesOrNotWhereverOneFails) {
  using namespace moving;
  std::optional<Stage> stage;
  const auto begin = [&](bool = false) {
    Mesh ground;
    scenes::add_floor(ground, -9.0, -9.0, 9.0, 9.0, 0.0);
    scenes::add_wall(ground, 2.5, -4.0, 2.5, 4.0, 0.0, 3.0);
    stage.emplace(ground);
    Mesh plate, door;
    scenes::add_box(plate, {-2.0, -2.0, -0.2}, {2.0, 2.0, 0.0});
    scenes::add_wall(door, 0.0, -1.0, 0.0, 1.0, 0.2, 2.0);
    const ObjectId lift = stage->scene.add(plate, {{0.0, 0.0, 0.5}});
    const ObjectId gate = stage->scene.add(door, {{-4.0, 0.0, 0.0}});
    stage->add({}, Mode::walk, {0.5, 0.3, 0.5});
    stage->add({}, Mode::walk, {-3.5, 0.0, 0.0});
    stage->scene.space.set_velocity(lift, {{0.1, 0.0, 1.5}, 0.1});
    stage->scene.space.set_velocity(gate, {{3.0, 0.0, 0.0}, 0.0});
  };
  begin();
  fail_calls({{"move_instances",
               [&] {
                 const auto stopped = roam::move_instances(stage->scene.space, stage->list, 0.1);
                 Bits bits;
                 bits << stopped.size();
                 for (const auto& walker : stage->walkers) bits << walker->position() << walker->velocity();
                 return std::string(bits);
               },
               [&](bool) {
                 // Nobody is in anything, then and after the next step.
                 for (int step = 0; step < 2; ++step) {
                   const Mesh all = stage->scene.whole();
                   const scenes::Judge judge(all);
                   for (const auto& walker : stage->walkers) {
                     EXPECT_FALSE(walker->held());
                     EXPECT_GE(judge.distance(walker->body(), walker->position(), 1.0), walker->body().radius - 2e-6);
                     EXPECT_EQ(walker->report().to, walker->position());
                     walker->step({}, dt);
                   }
                 }
                 begin();
               }}});
}

}  // namespace
#endif
