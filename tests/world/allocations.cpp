// Where memory runs out, a call of a space throws: a changed space is as it was or as it should be, and never free
// where it was solid. Instrumented builds have an operator new of their own.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <optional>

#include "fallible_calls.h"
#include "roam/filtered.h"
#include "roam/instances.h"
#include "roam/patchwork.h"
#include "walker_scenes.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

using namespace roam;

constexpr Body small_ball{0.2, 0.0};
const Query along_x{small_ball, {-9.0, 0.0, 0.0}, {18.0, 0.0, 0.0}};

Mesh wall_at(double x, const char* name = "a wall with a name that is too long for no allocation") {
  Mesh mesh;
  mesh.name = name;
  scenes::add_wall(mesh, x, -4.0, x, 4.0, -4.0, 4.0);
  return mesh;
}

std::string bits_of(const Impact& impact) {
  return Bits() << impact.time << impact.distance << impact.point << impact.normal << impact.triangle << impact.object
                << impact.hit << impact.unknown;
}
std::string bits_of(const Clearance& near) {
  return Bits() << near.distance << near.point << near.normal << near.triangle << near.object << near.found;
}

TEST(WorldAllocations, BatchesAndNamesThrowWhereverOneFails) {
  const World world = scenes::build(wall_at(0.0));
  std::vector<Query> queries(300, along_x);
  for (std::size_t i = 0; i < queries.size(); ++i) queries[i].from.y = 0.02 * static_cast<double>(i);
  std::vector<Query> wrong = queries;
  wrong[250].body.radius = -1.0;
  std::vector<Impact> impacts(queries.size());
  std::vector<Clearance> clearances(queries.size());
  std::vector<double> gaps(queries.size());
  fail_calls({
      {"sweep, clearance and gap_bound",
       [&] {
         world.sweep(queries, impacts);
         world.clearance(queries, 12.0, clearances);
         world.gap_bound(queries, 12.0, gaps);
         return bits_of(impacts[0]) + bits_of(clearances[299]) + std::string(Bits() << gaps[0] << gaps[299]);
       }},
      {"a wrong query in a batch", [&] { return refusal_of([&] { world.sweep(wrong, impacts); }); }},
      {"a wrong query", [&] { return refusal_of([&] { static_cast<void>(world.sweep(wrong[250])); }); }},
      {"object", [&] { return world.object(0).name; }},
  });
}

TEST(WorldAllocations, AFilterIgnoresAsBeforeWhereverOneFails) {
  const std::array<Mesh, 3> meshes{wall_at(-3.0), wall_at(0.0), wall_at(3.0)};
  const World world = World::build(meshes);
  std::optional<Filtered> space;
  const std::array<HalfSpace, 2> halves{HalfSpace{{1.0, 0.0, 0.0}, -5.0}, HalfSpace{{-1.0, 0.0, 0.0}, 1.0}};
  const std::array<ObjectId, 2> others{1, 2};
  // Without either, another wall is nearest.
  const auto begin = [&] {
    space.emplace(world);
    space->ignore_beyond(std::span(halves).last(1));
    space->ignore(1);
  };
  begin();
  const std::string before = bits_of(space->sweep(along_x));
  ASSERT_EQ(space->sweep(along_x).object, 2U);
  const auto again = [&](bool failed) {
    const Impact met = space->sweep(along_x);
    EXPECT_EQ(met.hit, failed);
    if (failed) {
      EXPECT_EQ(bits_of(met), before);
    }
    begin();
  };
  fail_calls({
      {"ignore_only",
       [&] {
         space->ignore_only(others);
         return std::string();
       },
       again},
      {"ignore_beyond",
       [&] {
         space->ignore_beyond(halves);
         return std::string();
       },
       again},
      {"a copy",
       [&] {
         const Filtered copy(*space);
         return bits_of(copy.sweep(along_x));
       },
       [&](bool) { EXPECT_EQ(bits_of(space->sweep(along_x)), before); }},
      {"ignore",
       [&] {
         space->ignore(2);
         return std::string();
       },
       again},
  });
}

TEST(WorldAllocations, InstancesAreAsBeforeWhereverOneFails) {
  const World world = scenes::build(wall_at(4.0));
  const auto door = std::make_shared<World>(scenes::build(wall_at(0.0), true));
  std::optional<Instances> space(std::in_place, world);
  ObjectId first = no_object;
  const auto with_one = [&](bool) {
    space.emplace(world);
    first = space->add(door, {{-4.0, 0.0, 0.0}, 0.0}, "first");
  };
  with_one(false);
  const auto time = [&] { return space->sweep(along_x).time; };
  const double as_made = time();
  const auto moved = [&](double x) {
    Instances other(world);
    other.add(door, {{x, 0.0, 0.0}, 0.0});
    return other.sweep(along_x).time;
  };
  const double ahead = moved(-6.0), behind = moved(5.0);
  const auto judged = [&](double done, std::size_t count) {
    return [&, done, count](bool failed) {
      EXPECT_EQ(time(), failed ? as_made : done);
      if (failed) {
        EXPECT_EQ(space->pose(first).position.x, -4.0);
      }
      EXPECT_EQ(space->instances().size(), failed ? 1U : count);
      with_one(failed);
    };
  };
  fail_calls({
      {"add",
       [&] {
         space->add(door, {{-6.0, 0.0, 0.0}, 0.0}, "an instance with a name that is too long for no allocation");
         return std::string();
       },
       judged(ahead, 2)},
      {"set_pose",
       [&] {
         space->set_pose(first, {{-6.0, 0.0, 0.0}, 0.0});
         return std::string();
       },
       judged(ahead, 1)},
      {"remove",
       [&] {
         space->remove(first);
         return std::string();
       },
       judged(behind, 0)},
      {"a wrong number", [&] { return refusal_of([&] { space->remove(17); }); }},
      {"instances", [&] { return std::string(Bits() << space->instances().size()); }},
      {"object",
       [&] {
         return space->object(space->sweep(along_x).triangle).name + " of the instances, too long for no allocation";
       }},
      {"all from the beginning",
       [&] {
         Instances other(world);
         const ObjectId one = other.add(door, {{-6.0, 0.0, 0.0}, 0.0}, "door");
         other.set_velocity(one, {{0.0, 1.0, 0.0}, 0.0});
         return bits_of(other.sweep(along_x));
       }},
  });
}

/// Coarse and fine walls, unknown and failed boxes, in four updates.
struct Course {
  static inline const Box box{Vec3(-5.0), Vec3(5.0)};

  std::string run() {
    updates = 0;
    space.emplace();
    const PatchId coarse = space->expect(box);
    update();
    space->deliver(coarse, scenes::build(wall_at(-1.0)));
    update();
    const PatchId left = space->expect({Vec3(-5.0), Vec3(0.0, 5.0, 5.0)}, coarse);
    const PatchId right = space->expect({Vec3(0.0, -5.0, -5.0), Vec3(5.0)}, coarse);
    space->deliver(left, scenes::build(wall_at(-2.0)));
    space->fail(right, "a reason that is too long for no allocation");
    update();
    space->deliver(right, scenes::build(wall_at(2.0)));
    update();
    const Impact fine = space->sweep(along_x);
    space->forget(left);
    update();
    const Impact forgotten = space->sweep(along_x);
    return bits_of(fine) + bits_of(forgotten) + space->object_name(fine.triangle) +
           space->object_name(forgotten.triangle);
  }
  void update() {
    space->update(small_ball, along_x.from);
    ++updates;
  }

  /// The latest time at which along_x may touch after the first update: at the coarse wall.
  static constexpr double latest = (9.0 - 1.0 - small_ball.radius) / 18.0 + 1e-3;
  std::optional<Patchwork> space;
  int updates = 0;  ///< that have ended
};

TEST(WorldAllocations, APatchworkIsSolidWhereItWasWhereverOneFails) {
  Course course;
  fail_calls({{"expect, deliver, fail, forget and update", [&] { return course.run(); },
               [&](bool failed) {
                 if (course.updates == 0) return course.space.reset();
                 const Impact met = course.space->sweep(along_x);
                 EXPECT_TRUE(met.hit && met.time <= Course::latest);
                 bool usable = true;
                 try {
                   course.space->update(small_ball, along_x.from);
                 } catch (const Error&) {
                   usable = false;
                 }
                 const Impact then = course.space->sweep(along_x);
                 EXPECT_TRUE(then.hit && (usable || (then.unknown && then.time == 0.0)));
                 EXPECT_TRUE(usable || failed);
                 course.space.reset();
               }}});
}

}  // namespace
#endif
