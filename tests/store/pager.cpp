// A pager of which everything is in memory answers as a World of the same triangles, and one that is not answers no
// later.
#include "roam/pager.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "clutter.h"
#include "pager_made.h"
#include "roam/generate.h"
#include "roam/world.h"

namespace {

using roam::Body;
using roam::Box;
using roam::Impact;
using roam::Mesh;
using roam::Pager;
using roam::Vec3;
using roam::World;

struct Query {
  Body body;
  Vec3 from, motion;
};

/// Near surfaces, in all directions, short and long.
Query some_query(clutter::Random& random, std::span<const Mesh> meshes) {
  const Mesh& mesh = meshes[random.engine() % meshes.size()];
  const roam::Triangle t = mesh.triangle(random.engine() % mesh.triangles.size());
  Query q;
  q.body = {random.engine() % 8 == 0 ? 0.0 : random.between(0.05, 0.6),
            random.engine() % 3 == 0 ? random.between(0.0, 0.9) : 0.0};
  q.from = t[random.engine() % 3] + random.between(0.0, 3.0) * random.direction();
  q.motion = std::pow(10.0, random.between(-2.0, 2.3)) * random.direction();
  if (random.engine() % 10 == 0) q.motion = Vec3(0.0);
  return q;
}

/// The stored triangles are those of the world, but a leaf's may stand in another order and turned about: so what is
/// computed of them differs in the last bits. An arrival is accepted up to 20 um before the body touches, and twice the
/// rounding error of its frame (docs/algorithm.md); where it is looked for from decides what of that is used.
constexpr double last_bits = 2.5e-5;  // metres

/// The same along the way: the flatter it meets, the more.
double along(const Query& q, const Impact& impact) {
  const double length = glm::length(q.motion);
  const double steep = impact.hit && length > 0.0 ? std::abs(glm::dot(impact.normal, q.motion)) / length : 0.0;
  return last_bits / std::max(0.01, steep);
}

struct Tally {
  long hits = 0, touching = 0, misses = 0, same_triangle = 0;
};

/// The gap to the triangle that is nearest of all; or `reach`.
double least_gap(const World& world, const Query& q, const Vec3& motion, double reach) {
  roam::Contact nearest;
  return world.contacts(q.body, q.from, motion, reach, {&nearest, 1}) > 0 ? nearest.distance : reach;
}

void compare(const Pager& pager, const World& world, std::span<const Mesh> meshes, int queries, std::uint64_t seed) {
  clutter::Random random(seed);
  Tally tally;
  for (int i = 0; i < queries; ++i) {
    const Query q = some_query(random, meshes);
    SCOPED_TRACE(i);
    const Impact a = pager.sweep(q.body, q.from, q.motion), b = world.sweep(q.body, q.from, q.motion);
    const double length = glm::length(q.motion);
    ASSERT_NEAR(a.time * length, b.time * length, along(q, b));
    ASSERT_FALSE(a.unknown);
    if (a.hit && b.hit) {
      ++(a.time == 0.0 ? tally.touching : tally.hits);
      ASSERT_NEAR(a.distance, b.distance, last_bits + (a.time == 0.0 ? 0.0 : 2e-3));
      const auto source = i % 64 == 0 ? pager.store().source(a.triangle).scene : b.triangle;
      tally.same_triangle += source == b.triangle ? 1 : 0;
    } else {
      ASSERT_TRUE(a.hit == b.hit || (a.hit ? a : b).time * length > length - last_bits || length == 0.0);
      ++tally.misses;
    }
    if (i % 4 != 0) continue;
    const double reach = random.between(0.0, 2.0);
    const Vec3 motion = i % 8 == 0 ? Vec3(0.0) : q.motion;
    const auto c = pager.clearance(q.body, q.from, motion, reach);
    const double least = least_gap(world, q, motion, reach);
    ASSERT_LE(c.distance, least + last_bits);
    ASSERT_GE(c.distance, least - (pager.store().info().lossless ? 1e-5 : 2e-3));
    ASSERT_FALSE(c.unknown);
    std::array<roam::Contact, 24> left{}, right{};
    const std::size_t n = pager.contacts(q.body, q.from, motion, 0.3, left);
    const std::size_t m = world.contacts(q.body, q.from, motion, 0.3, right);
    for (std::size_t k = 0; k < std::min(n, m); ++k) ASSERT_NEAR(left[k].distance, right[k].distance, last_bits);
    if (n != m) {  // by one whose distance is the reach
      const auto& more = n > m ? left : right;
      ASSERT_NEAR(more[std::min(n, m)].distance, 0.3, last_bits);
    }
  }
  EXPECT_GT(tally.hits, queries / 20);
  EXPECT_GT(tally.touching, queries / 200);
  EXPECT_GT(tally.misses, queries / 20);
  // Two that share an edge are met at once.
  EXPECT_GT(static_cast<double>(tally.same_triangle), 0.99 * static_cast<double>(tally.hits + tally.touching));
}

void compare(const char* name, const std::vector<Mesh>& meshes, const made::StoreOptions& options, int queries) {
  const made::Folder folder(std::string("pager_") + name);
  const auto store = made::store(folder.path(), meshes, options);
  roam::BuildOptions build;
  build.lossless = options.lossless;
  const World world = World::build(meshes, build);
  Pager pager(store, {.memory = 64 << 20, .loaders = 2});
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
  EXPECT_EQ(pager.facts().speed_limit, std::numeric_limits<double>::infinity());
  EXPECT_EQ(pager.stats().triangles, world.stats().triangles);
  compare(pager, world, meshes, queries, 1);
}

TEST(Pager, AnswersAsAWorldDoesInAGallery) {
  compare("gallery", roam::generate::collect(roam::generate::gallery({.triangles = 200'000, .seed = 1})),
          {.page_tiles = 7}, 100'000);
}

TEST(Pager, AnswersAsAWorldDoesOnATerrain) {
  compare("terrain", roam::generate::collect(roam::generate::terrain({.triangles = 200'000, .seed = 1})),
          {.page_tiles = 5}, 30'000);
}

TEST(Pager, AnswersAsALosslessWorldDoes) {
  clutter::Random random(3);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 4; ++i) {
    meshes.push_back(clutter::make(random, {20'000, 60.0, 0.05, 8.0, Vec3(5e4, -3e4 + 70.0 * i, 100.0)}));
  }
  compare("lossless", meshes, {.lossless = true, .page_tiles = 3}, 30'000);
}

TEST(Pager, NamesTheObjectOfATriangleWhenItKnowsIt) {
  const made::Folder folder("pager_names");
  clutter::Random random(4);
  std::vector<Mesh> meshes;
  for (int i = 0; i < 3; ++i) {
    meshes.push_back(clutter::make(random, {500, 5.0, 0.1, 1.0, Vec3(12.0 * i, 0.0, 0.0)}));
    meshes.back().name = "heap " + std::to_string(i);
  }
  Pager pager(made::store(folder.path(), meshes));
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));
  for (int i = 0; i < 3; ++i) {
    const auto c = pager.clearance({0.1, 0.0}, Vec3(12.0 * i, 0.0, 0.0), 10.0);
    ASSERT_TRUE(c.found);
    std::string name;
    EXPECT_TRUE(made::update_until(pager, {}, Vec3(0.0), [&] {
      name = pager.object_name(c.triangle);
      return !name.empty();
    }));
    EXPECT_EQ(name, meshes[static_cast<std::size_t>(i)].name);
  }
}

/// Whatever is in memory, no answer is later than that of the world; and what is called unknown is so.
void ask_with_parts(Pager& pager, const World& world, std::span<const Mesh> meshes, const Body& body, int rounds) {
  clutter::Random random(7);
  long unknown = 0, known = 0;
  for (int round = 0; round < rounds; ++round) {
    const Query at = some_query(random, meshes);
    for (int i = 0; i < 40; ++i) {
      (void)pager.update(body, at.from, 10.0 * random.direction());
      std::this_thread::sleep_for(std::chrono::microseconds(50));
      for (int k = 0; k < 10; ++k) {
        Query q = some_query(random, meshes);
        if (k % 2 == 0) q.from = at.from + random.in_box(20.0);
        const Impact a = pager.sweep(q.body, q.from, q.motion), b = world.sweep(q.body, q.from, q.motion);
        const double length = glm::length(q.motion);
        ASSERT_LE(a.time * length, b.time * length + along(q, b));
        ASSERT_TRUE(a.hit || !b.hit || b.time * length > length - last_bits);
        ++(a.hit && a.unknown ? unknown : known);
        if (!a.unknown) {
          ASSERT_NEAR(a.time * length, b.time * length, along(q, b));
        } else {
          // Solid only near what may be there: the box of some tile.
          const Vec3 p = a.point;
          const Box all = pager.bounds();
          for (int j = 0; j < 3; ++j) {
            ASSERT_GE(p[j], all.lower[j] - 0.1);
            ASSERT_LE(p[j], all.upper[j] + 0.1);
          }
        }
        const auto c = pager.clearance(q.body, q.from, 0.1 * q.motion, 1.0);
        const double least = least_gap(world, q, 0.1 * q.motion, 1.0);
        // How deep a body is in a triangle and in a box are two questions.
        ASSERT_LE(c.distance, std::max(least, -q.body.radius) + last_bits);
        if (!c.unknown) {
          ASSERT_GE(c.distance, least - 2e-3);
        }
      }
    }
  }
  EXPECT_GT(unknown, 100);
  EXPECT_GT(known, 100);
}

TEST(Pager, IsNeverLaterThanTheTruthWhateverIsInMemory) {
  const made::Folder folder("pager_parts");
  const auto meshes = roam::generate::collect(roam::generate::gallery({.triangles = 1'000'000, .seed = 2}));
  const auto store = made::store(folder.path(), meshes, {.page_tiles = 9});
  const World world = World::build(meshes);
  ASSERT_GT(store->info().resident_bytes, 9u << 20);
  Pager pager(store, {.memory = Pager::least_memory});
  ask_with_parts(pager, world, meshes, {0.3, 0.6}, 40);
  const auto stats = pager.stats();
  EXPECT_GT(stats.evictions, 20u);
  EXPECT_EQ(stats.failures, 0u);
}

TEST(Pager, WaitsNoLongerOnceMemoryHoldsNoMore) {
  const made::Folder folder("pager_long");
  const auto meshes = roam::generate::collect(roam::generate::gallery({.triangles = 1'000'000, .seed = 2}));
  const auto store = made::store(folder.path(), meshes, {.page_tiles = 9});
  ASSERT_GT(store->info().resident_bytes, 9u << 20);
  Pager pager(store, {.memory = Pager::least_memory});
  const Vec3 middle = pager.bounds().center();
  std::uint64_t loads = 0;
  double before = 0.0;
  for (const double speed : {1000.0, 1000.0, -1000.0, -1000.0}) {
    int calls = 0;
    EXPECT_FALSE(pager.wait({0.3, 0.6}, middle, {speed, 0.0, 0.0}, 600.0, 1.0, [&] { return ++calls < 50'000; }));
    EXPECT_LT(calls, 50'000);
    const auto stats = pager.stats();
    EXPECT_TRUE(stats.full);
    EXPECT_GT(stats.tiles, 50u);
    EXPECT_EQ(stats.reading, 0u);
    if (speed == before) {
      EXPECT_EQ(stats.loads, loads) << "it had ended too early";
    }
    loads = stats.loads;
    before = speed;
  }
  // A body that reaches less finds room for it.
  EXPECT_TRUE(pager.wait({0.3, 0.6}, middle, Vec3(0.0), 600.0));
}

TEST(Pager, TellsWhatIsWrongWithItsOptions) {
  const made::Folder folder("pager_options");
  clutter::Random random(5);
  const Mesh mesh = clutter::make(random, {});
  const auto store = made::store(folder.path(), {&mesh, 1});
  EXPECT_THROW(Pager(store, {.memory = 1 << 20}), roam::Error);
  EXPECT_THROW(Pager(store, {.loaders = -1}), roam::Error);
  EXPECT_THROW(Pager(store, {.loaders = 17}), roam::Error);
  EXPECT_THROW(Pager(store, {.horizon = 0.0}), roam::Error);
  EXPECT_THROW(Pager(store, {.horizon = std::nan("")}), roam::Error);
  EXPECT_THROW(Pager(store, {.memory = Pager::least_memory, .loaders = 16}), roam::Error);
  Pager pager(store);
  EXPECT_THROW((void)pager.update({-1.0, 0.0}, Vec3(0.0), Vec3(0.0)), roam::Error);
  EXPECT_THROW((void)pager.update({0.3, 0.0}, Vec3(std::nan("")), Vec3(0.0)), roam::Error);
  EXPECT_THROW((void)pager.update({0.3, 0.0}, Vec3(0.0), Vec3(std::nan(""))), roam::Error);
}

}  // namespace
