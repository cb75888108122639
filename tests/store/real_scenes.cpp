// Stores of real scenes, trees of tiles among them, beside worlds of the same scenes: whatever one of the two says is
// free keeps clear of what the other one meets, and what is met is near, judged in higher precision on the triangles as
// read.
//
// ROAM_TEST_SWEEPS: how many sweeps a scene (default 5,000).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <iostream>
#include <map>

#include "clutter.h"
#include "import_files.h"
#include "pager_made.h"
#include "program.h"
#include "roam/import.h"
#include "roam/store_build.h"
#include "roam/world.h"
#include "verify/swept_distance.h"

namespace {

namespace fs = std::filesystem;
using roam::Body;
using roam::Impact;
using roam::TriangleId;
using roam::Vec3;
using roam::verification::swept_distance;

int sweeps() {
  const char* said = std::getenv("ROAM_TEST_SWEEPS");
  return said != nullptr ? std::atoi(said) : 5'000;
}

/// Metres: what Space promises of what is free, and of what is met.
constexpr long double too_near = 1e-6L, too_far = 2e-3L;

/// The scene as read, all objects numbered through.
struct Source {
  explicit Source(const std::vector<fs::path>& files) : scene(roam::import_scene(files)) {
    for (const roam::Mesh& mesh : scene.meshes) {
      first.push_back(triangles);
      triangles += mesh.triangles.size();
    }
  }
  [[nodiscard]] roam::Triangle triangle(TriangleId id) const {
    const auto mesh = static_cast<std::size_t>(std::upper_bound(first.begin(), first.end(), id) - first.begin() - 1);
    return scene.meshes[mesh].triangle(id - first[mesh]);
  }
  roam::ImportedScene scene;
  std::vector<TriangleId> first;
  TriangleId triangles = 0;
};

/// One question, and what a space answers, with the triangle as read.
struct Sweep {
  Body body;
  Vec3 from, motion;
};
struct Answer {
  bool hit = false;
  double time = 1.0;
  roam::Triangle triangle{};
};

struct SceneTally {
  int hits = 0, free = 0, one_hits = 0, other_time = 0;
  long double largest_gap = 0.0;    ///< of what is met, from the body
  long double largest_depth = 0.0;  ///< of what the other meets, on the way that is said to be free
  double farthest_apart = 0.0;      ///< where both meet something
};

void expect_near(const Sweep& q, const Answer& answer, const char* which, SceneTally& tally) {
  if (!answer.hit) return;
  const Vec3 place = q.from + answer.time * q.motion;
  const long double gap = swept_distance(place, place, q.body.half_height, answer.triangle) - q.body.radius;
  tally.largest_gap = std::max(tally.largest_gap, gap);
  ASSERT_LE(gap, too_far) << which;
}

/// The way that `says` calls free keeps clear of the triangle that `other` meets.
void expect_clear(const Sweep& q, const Answer& says, const Answer& other, const char* which, SceneTally& tally) {
  if (!other.hit || says.time == 0.0) return;
  const Vec3 to = q.from + says.time * q.motion;
  const long double gap = swept_distance(q.from, to, q.body.half_height, other.triangle) - q.body.radius;
  tally.largest_depth = std::max(tally.largest_depth, -gap);
  ASSERT_GE(gap, -too_near) << which;
}

void compare(const char* name, const std::vector<fs::path>& files) {
  const Source source(files);
  const roam::World world = roam::World::build(source.scene.meshes);
  const TestFolder folder;
  const fs::path built = folder.file("scene.roam");
  roam::StoreBuildOptions options;
  options.scene = files;
  options.output = built;
  (void)roam::build_store(options);
  const auto store = roam::Store::open(built);
  ASSERT_EQ(store->info().triangles, source.triangles);
  EXPECT_LE(store->info().largest_error, 1e-3);
  roam::Pager pager(store, {.memory = 256 << 20});
  ASSERT_NO_FATAL_FAILURE(made::load_all(pager));

  std::map<TriangleId, TriangleId> numbers;  // of the scene, by the store's
  const auto number = [&](TriangleId stored) {
    const auto [known, is_new] = numbers.try_emplace(stored);
    if (is_new) known->second = store->source(stored).scene;
    return known->second;
  };
  clutter::Random random(17);
  SceneTally tally;
  for (int i = 0; i < sweeps(); ++i) {
    SCOPED_TRACE(i);
    const roam::Triangle at = source.triangle(random.engine() % source.triangles);
    Sweep q;
    q.body = {random.between(0.0, 0.8), i % 3 == 0 ? random.between(0.0, 0.9) : 0.0};
    q.from = at[random.engine() % 3] + random.between(0.0, 3.0) * random.direction();
    q.motion = std::pow(10.0, random.between(-2.0, 2.0)) * random.direction();
    const Impact in_world = world.sweep(q.body, q.from, q.motion), in_store = pager.sweep(q.body, q.from, q.motion);
    ASSERT_FALSE(in_store.unknown);
    Answer a, b;
    if (in_world.hit) a = {true, in_world.time, source.triangle(in_world.triangle)};
    if (in_store.hit) b = {true, in_store.time, source.triangle(number(in_store.triangle))};
    ASSERT_NO_FATAL_FAILURE(expect_near(q, a, "world", tally));
    ASSERT_NO_FATAL_FAILURE(expect_near(q, b, "store", tally));
    ASSERT_NO_FATAL_FAILURE(expect_clear(q, a, b, "world", tally));
    ASSERT_NO_FATAL_FAILURE(expect_clear(q, b, a, "store", tally));
    tally.hits += a.hit && b.hit ? 1 : 0;
    tally.free += !a.hit && !b.hit ? 1 : 0;
    tally.one_hits += a.hit != b.hit ? 1 : 0;
    if (a.hit && b.hit) {
      tally.other_time += a.time != b.time ? 1 : 0;
      tally.farthest_apart = std::max(tally.farthest_apart, std::abs(a.time - b.time) * glm::length(q.motion));
    }
  }
  std::cout << name << ": " << source.triangles << " triangles, " << sweeps() << " sweeps; both hit " << tally.hits
            << ", both free " << tally.free << ", one hits " << tally.one_hits << ", times differ " << tally.other_time
            << ", at most " << tally.farthest_apart << " m apart; what is met is at most " << tally.largest_gap
            << " m away, and at most " << tally.largest_depth << " m inside of what the other calls free\n";
  EXPECT_GT(tally.hits, sweeps() / 10);
  EXPECT_GT(tally.free, sweeps() / 10);
  // Grazes: that close to touching, one of the two may stop where the other one passes.
  EXPECT_LE(tally.one_hits, 1 + sweeps() / 500);
}

TEST(StoreRealScenes, APitOfPagedTilesAnswersAsItsWorld) {
  ROAM_NEEDS_TEST_DATA();
  compare("pit_osgb", {roam::test::test_data() / "pit_osgb"});
}

TEST(StoreRealScenes, TilesWhoseFinerOnesAreMissingAnswerAsTheirWorld) {
  ROAM_NEEDS_TEST_DATA();
  std::vector<fs::path> tiles;
  for (const auto& entry : fs::directory_iterator(roam::test::test_data() / "contextcapture_tiles")) {
    if (entry.path().extension() == ".osgb") tiles.push_back(entry.path());
  }
  std::sort(tiles.begin(), tiles.end());
  ASSERT_GE(tiles.size(), 4U);
  compare("contextcapture_tiles", tiles);
}

TEST(StoreRealScenes, ATunnelAnswersAsItsWorld) {
  ROAM_NEEDS_TEST_DATA();
  compare("subt_tunnel_practice_1", {roam::test::test_data() / "underground/subt_tunnel_practice_1.ive"});
}

}  // namespace
