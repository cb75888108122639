// What all spaces have in common: first impacts without their contact, batches, objects, and spaces of one's own.

#include "roam/space.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <vector>

#include "first_impacts.h"
#include "roam/collector.h"
#include "roam/patchwork.h"

namespace {

using clutter::Random;
using first_impacts::queries;
using roam::Body;
using roam::Clearance;
using roam::Contact;
using roam::FirstImpact;
using roam::Impact;
using roam::Mesh;
using roam::Patchwork;
using roam::Query;
using roam::Space;
using roam::Vec3;
using roam::World;

constexpr double half = 6.0;  // m

/// Objects that lie among each other.
std::vector<Mesh> objects(std::uint64_t seed, int count) {
  Random random(seed);
  std::vector<Mesh> meshes;
  for (int i = 0; i < count; ++i) meshes.push_back(clutter::make(random, {.count = 40 + 30 * i, .half = half}));
  return meshes;
}

/// One patch of two objects, one of three, and a box of which nothing has come.
struct Patches {
  Patchwork space;

  Patches() {
    const roam::Box box{Vec3(-20.0), Vec3(20.0)};
    const auto first = space.expect(box), second = space.expect(box);
    space.deliver(first, World::build(objects(1, 2)));
    space.deliver(second, World::build(objects(2, 3)));
    (void)space.expect({{1.0, 1.0, 1.0}, {4.0, 3.0, 5.0}});
    space.update();
  }
};

TEST(FirstImpact, OfAWorldIsTheSweepWithoutItsContact) {
  for (const bool lossless : {false, true}) {
    const World world = World::build(objects(3, 4), {.threads = 0, .lossless = lossless, .progress = {}});
    const auto tally = first_impacts::compare(world, queries(4, half, 3000));
    EXPECT_GT(tally.hits, 500);
    EXPECT_GT(tally.at_start, 100);
    EXPECT_GT(tally.misses, 500);
  }
}

TEST(FirstImpact, OfAPatchworkIsTheSweepWithoutItsContact) {
  const Patches patches;
  const auto tally = first_impacts::compare(patches.space, queries(5, half, 3000));
  EXPECT_GT(tally.hits, 500);
  EXPECT_GT(tally.at_start, 100);
  EXPECT_GT(tally.unknown, 100);
}

TEST(FirstImpact, IsNotCompletedAfterAChange) {
  World world = World::build(objects(6, 1));
  const World other = World::build(objects(6, 1));
  for (const Query& q : queries(7, half, 200)) {
    const FirstImpact first = world.first_impact(q);
    if (!first.hit) {
      EXPECT_FALSE(other.completed(q, first).hit);
      continue;
    }
    EXPECT_THROW((void)other.completed(q, first), roam::Error);
    const World moved = std::move(world);  // is the same one
    EXPECT_TRUE(course::same(moved.completed(q, first), moved.sweep(q)));
    return;
  }
  FAIL() << "nothing was met";
}

TEST(Objects, AreNamedByEveryHit) {
  const World world = World::build(objects(8, 5));
  std::array<long, 5> met{};
  std::array<Contact, 8> contacts;
  for (const Query& q : queries(9, half, 2000)) {
    const Impact impact = world.sweep(q);
    ASSERT_EQ(impact.object, impact.hit ? world.object(impact.triangle).id : roam::no_object);
    if (impact.hit) ++met[impact.object];
    for (std::size_t i = world.contacts(q, 0.5, contacts); i-- > 0;) {
      ASSERT_EQ(contacts[i].object, world.object(contacts[i].triangle).id);
    }
    const Clearance near = world.clearance(q, 1.0);
    ASSERT_EQ(near.object, near.found ? world.object(near.triangle).id : roam::no_object);
    const Clearance floor = world.floor_clearance(q.body, q.from, 1.0, {.slope_degrees = 40.0});
    ASSERT_EQ(floor.object, floor.found ? world.object(floor.triangle).id : roam::no_object);
  }
  for (const long times : met) EXPECT_GT(times, 10);
}

TEST(Objects, OfAPatchworkAreThoseOfThePatch) {
  const Patches patches;
  const std::array<World, 2> worlds{World::build(objects(1, 2)), World::build(objects(2, 3))};
  long known = 0, unknown = 0;
  std::array<Contact, 8> contacts;
  const auto judge = [&](const auto& answer) {
    ++(answer.unknown ? unknown : known);
    const auto patch = static_cast<std::size_t>(Patchwork::patch(answer.triangle)) - 1;
    ASSERT_EQ(answer.object, answer.unknown
                                 ? roam::no_object
                                 : worlds.at(patch).object(Patchwork::triangle_in_patch(answer.triangle)).id);
  };
  for (const Query& q : queries(10, half, 1000)) {
    const Impact impact = patches.space.sweep(q);
    if (impact.hit) judge(impact);
    const Clearance near = patches.space.clearance(q, 1.0);
    if (near.found) judge(near);
    ASSERT_FALSE(HasFatalFailure());
    for (std::size_t i = patches.space.contacts(q, 0.3, contacts); i-- > 0;) {
      ASSERT_NO_FATAL_FAILURE(judge(contacts[i]));
    }
  }
  EXPECT_GT(known, 500);
  EXPECT_GT(unknown, 100);
}

TEST(Batches, AreAnsweredAsOneByOne) {
  const World world = World::build(objects(11, 3));
  const Patches patches;
  for (const Space* space : {static_cast<const Space*>(&world), static_cast<const Space*>(&patches.space)}) {
    for (const int count : {0, 1, 50, 2000}) {
      const std::vector<Query> all = queries(12, half, count);
      std::vector<Impact> impacts(all.size());
      std::vector<Clearance> clearances(all.size());
      std::vector<double> gaps(all.size());
      space->sweep(all, impacts);
      space->clearance(all, 0.7, clearances);
      space->gap_bound(all, 0.7, gaps);
      for (std::size_t i = 0; i < all.size(); ++i) {
        SCOPED_TRACE(i);
        ASSERT_TRUE(course::same(impacts[i], space->sweep(all[i])));
        const Clearance one = space->clearance(all[i], 0.7);
        ASSERT_TRUE(course::same(clearances[i].distance, one.distance));
        ASSERT_EQ(clearances[i].found, one.found);
        ASSERT_EQ(clearances[i].triangle, one.triangle);
        ASSERT_TRUE(course::same(gaps[i], space->gap_bound(all[i], 0.7)));
      }
    }
  }
}

TEST(Batches, AreRefusedAsAWhole) {
  const World world = World::build(objects(13, 1));
  std::vector<Query> all = queries(14, half, 500);
  std::vector<Impact> impacts(all.size());
  EXPECT_THROW(world.sweep(all, std::span(impacts).first(499)), roam::Error);
  all[321].motion.y = std::numeric_limits<double>::quiet_NaN();
  all[400].body.radius = -1.0;
  try {
    world.sweep(all, impacts);
    FAIL() << "it was answered";
  } catch (const roam::Error& error) {
    EXPECT_NE(std::string(error.what()).find("query 321"), std::string::npos) << error.what();
  }
  for (const Impact& impact : impacts) ASSERT_FALSE(impact.hit);
  std::vector<double> gaps(all.size());
  EXPECT_THROW(world.gap_bound(std::span(all).first(300), -1.0, std::span(gaps).first(300)), roam::Error);
}

/// A space of one's own: triangles in a list, and no index.
class List final : public Space {
 public:
  explicit List(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) triangles_.push_back(mesh.triangle(i));
  }
  [[nodiscard]] roam::SpaceFacts facts() const override { return {}; }
  [[nodiscard]] roam::Object object(roam::TriangleId) const override { return {0, "list"}; }

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, roam::Vicinity*) const override {
    FirstImpact first;
    double deepest = 0.0;
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const roam::SweepResult met = roam::sweep(query.body, query.from, query.motion, triangles_[i]);
      if (!met.hit || met.time > first.time) continue;
      if (first.hit && met.time == first.time && !(met.time == 0.0 && met.distance < deepest)) continue;
      first.hit = true;
      first.time = met.time;
      first.triangle = i;
      deepest = met.distance;
    }
    return first;
  }
  void find_near(const Query& query, roam::Collector& collector, roam::Vicinity*) const override {
    for (std::size_t i = 0; i < triangles_.size(); ++i) collector.offer(query, triangles_[i], i);
  }

 private:
  std::vector<roam::Triangle> triangles_;
};

TEST(ASpaceOfOnesOwn, AnswersAsALosslessWorldDoes) {
  constexpr double stored = 2e-5;  // m: what a lossless world may be off by, twice
  Random random(15);
  Mesh mesh = clutter::make(random, {.count = 350, .half = half});
  // How a triangle without area lies depends on how it is stored.
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const auto& v = mesh.vertices;
    return glm::length(glm::cross(v[t[1]] - v[t[0]], v[t[2]] - v[t[0]])) < 1e-3;
  });
  const World world = World::build({&mesh, 1}, {.threads = 0, .lossless = true, .progress = {}});
  const List list(mesh);
  std::array<Contact, 300> of_list, of_world;
  long hits = 0, near = 0, floors = 0;
  for (const Query& q : queries(16, half, 600)) {
    const Impact a = list.sweep(q), b = world.sweep(q);
    if (a.hit != b.hit || std::abs(a.time - b.time) * glm::length(q.motion) > stored) {
      // A way that is as good as flat along something.
      ASSERT_LT(std::abs(list.clearance({q.body, q.from, a.time * q.motion}, 1.0).distance), 2.0 * stored);
      ASSERT_LT(std::abs(world.clearance({q.body, q.from, b.time * q.motion}, 1.0).distance), 2.0 * stored);
    } else if (a.hit) {
      ++hits;
      // What it touches is where the world has it.
      ASSERT_NEAR(a.distance, world.clearance({q.body, q.from + a.time * q.motion}, 1.0).distance, 2.0 * stored);
      ASSERT_NEAR(glm::length(a.normal), 1.0, 1e-9);
      ASSERT_EQ(list.first_impact(q).triangle, a.triangle);
    }
    ASSERT_NEAR(list.clearance(q, 1.0).distance, world.clearance(q, 1.0).distance, stored);
    const double gap = list.gap_bound(q, 1.0), least = list.clearance(q, 1.0).distance;
    ASSERT_LE(gap, std::max(least, 0.0) + 1e-9);
    if (least > 0.0) {
      ASSERT_GE(gap, 7.0 / 8.0 * least - 2e-3);
    }
    const std::size_t n = list.contacts(q, 0.4, of_list), m = world.contacts(q, 0.4, of_world);
    ASSERT_NEAR(double(n), double(m), 1.0);
    for (std::size_t i = 0; i < std::min(n, m); ++i) {
      ++near;
      ASSERT_NEAR(of_list[i].distance, of_world[i].distance, stored);
    }
    const roam::Floor floor{.slope_degrees = 50.0, .band = 0.8, .point = q.from};
    const Clearance down = list.floor_clearance(q.body, q.from, 1.0, floor);
    const Clearance there = world.floor_clearance(q.body, q.from, 1.0, floor);
    if (down.found && there.found) {
      ++floors;
      ASSERT_NEAR(down.distance, there.distance, stored);
    } else if (down.found != there.found) {
      ASSERT_NEAR(down.found ? down.distance : there.distance, 1.0, stored);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(near, 500);
  EXPECT_GT(floors, 100);
}

TEST(ASpaceOfOnesOwn, IsAskedNothingThatNoQueryTakes) {
  struct Untouched final : Space {
    [[nodiscard]] roam::SpaceFacts facts() const override { return {}; }
    [[nodiscard]] roam::Object object(roam::TriangleId) const override { return {}; }
    [[nodiscard]] FirstImpact find_first(const Query&, roam::Vicinity*) const override {
      ADD_FAILURE() << "it was asked";
      return {};
    }
    void find_near(const Query&, roam::Collector&, roam::Vicinity*) const override { ADD_FAILURE() << "it was asked"; }
  };
  const Untouched space;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
  std::array<Contact, 4> contacts;
  const auto refuses = [&](const Query& q, double reach) {
    EXPECT_THROW((void)space.clearance(q, reach), roam::Error);
    EXPECT_THROW((void)space.gap_bound(q, reach), roam::Error);
    EXPECT_THROW((void)space.contacts(q, reach, contacts), roam::Error);
  };
  const auto refuses_way = [&](const Query& q) {
    EXPECT_THROW((void)space.sweep(q), roam::Error);
    EXPECT_THROW((void)space.first_impact(q), roam::Error);
    EXPECT_THROW((void)space.completed(q, {}), roam::Error);
    refuses(q, 1.0);
  };
  for (const double bad : {nan, infinity, -infinity, -1.0, 1000.5}) {
    refuses_way({{bad, 0.0}, Vec3(0.0), Vec3(1.0)});
    refuses_way({{0.1, bad}, Vec3(0.0), Vec3(1.0)});
    refuses({{0.1, 0.0}, Vec3(0.0), Vec3(1.0)}, bad);
    EXPECT_THROW((void)space.floor_clearance({0.1, 0.0}, Vec3(0.0), bad, {}), roam::Error);
    EXPECT_THROW((void)space.floor_clearance({bad, 0.0}, Vec3(0.0), 1.0, {}), roam::Error);
  }
  for (int k = 0; k < 3; ++k) {
    for (const double bad : {nan, infinity, -infinity}) {
      Vec3 v(1.0);
      v[k] = bad;
      refuses_way({{0.1, 0.0}, v, Vec3(1.0)});
      refuses_way({{0.1, 0.0}, Vec3(0.0), v});
    }
    for (const double far : {1.1e6, -1.1e6}) {
      Vec3 v(1.0);
      v[k] = far;
      refuses_way({{0.1, 0.0}, Vec3(0.0), v});
    }
  }
}

}  // namespace
