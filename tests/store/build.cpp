// What a store holds of the scene that it was built from.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "clutter.h"
#include "import/find_reader.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using roam::Box;
using roam::Mesh;
using roam::Triangle;
using roam::Vec3;

constexpr double all_of_it = 1e10;
const Box everything{Vec3(-all_of_it), Vec3(all_of_it)};

double apart(const Triangle& a, const Triangle& b) {
  double worst = 0.0;
  for (int c = 0; c < 3; ++c) worst = std::max(worst, std::hypot(a[c].x - b[c].x, a[c].y - b[c].y, a[c].z - b[c].z));
  return worst;
}

/// The farthest that a corner of `stored` lies from its corner of `source`, whichever of them comes first.
double apart_in_any_turn(const Triangle& stored, const Triangle& source) {
  double best = 1e300;
  for (int turn = 0; turn < 3; ++turn) {
    best = std::min(best, apart(stored, {source[turn], source[(turn + 1) % 3], source[(turn + 2) % 3]}));
  }
  return best;
}

/// Every triangle of the source is in the store once, within `error` of its place, under its own number.
void expect_conserved(const std::string& folder, const std::vector<Triangle>& source, double error) {
  const auto store = roam::Store::open(folder);
  ASSERT_EQ(store->info().triangles, source.size());
  EXPECT_LE(store->info().largest_error, error);
  std::vector<bool> seen(source.size());
  std::size_t count = 0;
  store->for_each_triangle(everything, [&](std::span<const Triangle> triangles, std::span<const roam::TriangleId> ids) {
    for (std::size_t i = 0; i < triangles.size(); ++i) {
      const roam::SourceTriangle from = store->source(ids[i]);
      ASSERT_LT(from.scene, source.size());
      ASSERT_FALSE(seen[from.scene]) << "triangle " << from.scene << " is there twice";
      seen[from.scene] = true;
      ++count;
      ASSERT_LE(apart_in_any_turn(triangles[i], source[from.scene]), error) << "triangle " << from.scene;
    }
  });
  EXPECT_EQ(count, source.size());
}

std::vector<Triangle> triangles_of(const std::vector<Mesh>& meshes) {
  std::vector<Triangle> all;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) all.push_back(mesh.triangle(i));
  }
  return all;
}

TEST(StoreBuild, HoldsEveryTriangleOnceInItsPlace) {
  const TestFolder folder;
  const auto scene = roam::generate::gallery({.triangles = 60'000, .seed = 3});
  roam::generate::write_scene(scene, folder.file("gallery.ply"));
  const auto report = roam::build_store(options({folder.file("gallery.ply")}, folder.file("s")));
  EXPECT_EQ(report.triangles, scene.triangles());
  EXPECT_EQ(report.parts_read, 1U);
  EXPECT_EQ(report.shards_built, report.shards);
  expect_whole(folder.file("s"));
  expect_conserved(folder.file("s"), triangles_of(roam::generate::collect(scene)), 1e-3);
}

TEST(StoreBuild, KeepsDegenerateTinyAndHugeTriangles) {
  const TestFolder folder;
  clutter::Random random(5);
  Mesh mesh = clutter::make(random, {20'000, 60.0, 1e-4, 200.0, {500.0, -300.0, 20.0}});
  mesh.vertices.insert(mesh.vertices.end(), {{-5e3, -5e3, 0.0}, {5e3, -5e3, 1.0}, {0.0, 5e3, 2.0}});
  const auto n = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.triangles.push_back({n - 3, n - 2, n - 1});
  write_ply(folder.file("clutter.ply"), mesh);
  for (const bool lossless : {false, true}) {
    auto o = options({folder.file("clutter.ply")}, folder.file(lossless ? "lossless" : "store"));
    o.lossless = lossless;
    roam::build_store(o);
    expect_whole(o.output);
    expect_conserved(o.output, triangles_of({mesh}), lossless ? 4e-6 : 1e-3);
  }
}

TEST(StoreBuild, TakesCoordinatesAtTheLimit) {
  const TestFolder folder;
  Mesh mesh = field(8, 1.0, {-1e9, 1e9 - 8.0, -1e9});
  const Mesh other = field(8, 1.0, {1e9 - 8.0, -1e9, 1e9 - 1.0});
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), other.vertices.begin(), other.vertices.end());
  for (const auto& t : other.triangles) mesh.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  write_ply(folder.file("far.ply"), mesh);
  roam::build_store(options({folder.file("far.ply")}, folder.file("s")));
  expect_whole(folder.file("s"));
  expect_conserved(folder.file("s"), triangles_of({mesh}), 1e-3);
}

TEST(StoreBuild, TakesMoreTrianglesInOnePointThanATileHolds) {
  const TestFolder folder;
  Mesh mesh;
  mesh.vertices = {{1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {1.0, 2.0, 3.0}, {1.1, 2.0, 3.0}, {1.0, 2.1, 3.0}};
  for (int i = 0; i < 20'000; ++i) mesh.triangles.push_back({0, 1, 2});
  for (int i = 0; i < 40'000; ++i) mesh.triangles.push_back({0, 3, 4});
  write_ply(folder.file("point.ply"), mesh);
  roam::build_store(options({folder.file("point.ply")}, folder.file("s")));
  expect_whole(folder.file("s"));
  expect_conserved(folder.file("s"), triangles_of({mesh}), 1e-3);
}

TEST(StoreBuild, TakesMoreTrianglesInOnePointThanAShardHolds) {
  const TestFolder folder;
  Mesh mesh;
  mesh.vertices = {{1.0, 2.0, 3.0}, {1.1, 2.0, 3.0}, {1.0, 2.1, 3.0}};
  mesh.triangles.assign((1U << 20) + 30'000, {0, 1, 2});
  write_ply(folder.file("point.ply"), mesh);
  const auto report = roam::build_store(options({folder.file("point.ply")}, folder.file("s")));
  EXPECT_EQ(report.shards, 2U);
  expect_whole(folder.file("s"));
  const auto store = roam::Store::open(folder.file("s"));
  EXPECT_EQ(store->info().triangles, mesh.triangles.size());
  std::vector<roam::TriangleId> some;
  store->for_each_triangle(everything, [&](std::span<const Triangle>, std::span<const roam::TriangleId> ids) {
    for (std::size_t i = 0; i < ids.size(); i += 4000) some.push_back(ids[i]);
  });
  std::set<std::uint64_t> numbers;
  for (const auto id : some) EXPECT_TRUE(numbers.insert(store->source(id).number).second);
  EXPECT_GT(numbers.size(), 200U);
}

TEST(StoreBuild, KnowsPartsNumbersAndObjects) {
  const TestFolder folder;
  folder.write("a.obj", "o wall\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\no door\nv 5 0 0\nv 6 0 0\nv 5 1 0\nf 4 5 6\n");
  folder.write("b.obj", "o tree\nv 0 0 9\nv 1 0 9\nv 0 1 9\nf 1 2 3\nf 3 2 1\n");
  roam::build_store(options({folder.file("a.obj"), folder.file("b.obj")}, folder.file("s")));
  const auto store = roam::Store::open(folder.file("s"));
  EXPECT_EQ(store->info().objects, 3U);
  std::set<std::string> found;
  store->for_each_triangle(everything, [&](std::span<const Triangle>, std::span<const roam::TriangleId> ids) {
    for (const auto id : ids) {
      const auto from = store->source(id);
      found.insert(from.part + "/" + from.object + "/" + std::to_string(from.number) + "/" +
                   std::to_string(from.scene));
    }
  });
  EXPECT_EQ(found, (std::set<std::string>{"a.obj/wall/0/0", "a.obj/door/1/1", "b.obj/tree/0/2", "b.obj/tree/1/3"}));
}

TEST(StoreBuild, TakesFilesWhoseNamesAreNoText) {
  const TestFolder folder;
  const std::vector<std::string> names{"caf\xe9.ply", "\xc3\xbc\xe2\x82\xac.ply", "\xed\xa0\x80\xc0\xaf.ply"};
  std::vector<fs::path> scene;
  for (const std::string& name : names) {
    scene.emplace_back(write_ply(folder.file(name), field(4, 1.0, {9000.0 * double(scene.size()), 0.0, 0.0})));
  }
  const auto o = options({scene[0], scene[1], scene[2]}, folder.file("s"));
  roam::build_store(o);
  EXPECT_TRUE(roam::build_store(o).unchanged);
  const auto store = roam::Store::open(folder.file("s"));
  std::set<std::string> parts;
  store->for_each_triangle(store->info().bounds, [&](auto, auto ids) {
    for (const roam::TriangleId id : ids) parts.insert(store->source(id).part);
  });
  EXPECT_EQ(parts, (std::set<std::string>{"caf%E9.ply", names[1], "%ED%A0%80%C0%AF.ply"}));
}

TEST(StoreBuild, MakesTheSameTilesOfTrianglesInAnotherOrder) {
  const TestFolder folder;
  clutter::Random random(7);
  Mesh mesh = field(150, 0.4, {0.0, 0.0, 0.0});
  write_ply(folder.file("a.ply"), mesh);
  std::shuffle(mesh.triangles.begin(), mesh.triangles.end(), random.engine);
  write_ply(folder.file("b.ply"), mesh);
  std::vector<std::vector<Triangle>> stored[2];
  for (int i = 0; i < 2; ++i) {
    const std::string name = i == 0 ? "a" : "b";
    roam::build_store(options({folder.file(name + ".ply")}, folder.file(name)));
    const auto store = roam::Store::open(folder.file(name));
    store->for_each_triangle(everything, [&](std::span<const Triangle> triangles, std::span<const roam::TriangleId>) {
      stored[i].emplace_back(triangles.begin(), triangles.end());
    });
  }
  EXPECT_TRUE(stored[0] == stored[1]);
  EXPECT_EQ(roam::Store::open(folder.file("a"))->info().geometry_hash,
            roam::Store::open(folder.file("b"))->info().geometry_hash);
}

bool is_of_the_machine(const std::string& note) { return note.starts_with("The scene was read without Landlock"); }

TEST(StoreBuild, TellsWhatTheImportLeftOut) {
  const TestFolder folder;
  folder.write("a.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n");
  const auto report = roam::build_store(options({folder.file("a.obj")}, folder.file("s")));
  EXPECT_EQ(report.triangles, 1U);
  ASSERT_FALSE(report.notes.empty());
  EXPECT_TRUE(report.notes.front().starts_with("a.obj: ")) << report.notes.front();
  EXPECT_EQ(report.notes.front().find(folder.file("")), std::string::npos) << report.notes.front();
  const auto again = roam::build_store(options({folder.file("a.obj")}, folder.file("s")));
  EXPECT_TRUE(again.unchanged);
  std::vector<std::string> of_the_scene = report.notes;
  std::erase_if(of_the_scene, is_of_the_machine);
  EXPECT_EQ(again.notes, of_the_scene);
}

TEST(StoreBuild, HoldsNothingOfTheMachineThatReadTheScene) {
  const TestFolder folder;
  const std::vector<std::string> scene{write_ply(folder.file("a.ply"), field(8, 1.0, {0.0, 0.0, 0.0})),
                                       write_ply(folder.file("b.ply"), field(8, 1.0, {20.0, 0.0, 0.0}))};
  roam::build_store(options(scene, folder.file("here")));
  auto elsewhere = options(scene, folder.file("elsewhere"));
  elsewhere.import.reader = folder.write(
      "reader.sh", "#!/bin/sh\nexec '" + roam::reader::find_reader({}).string() + "' --highest-landlock 0 \"$@\"\n");
  fs::permissions(elsewhere.import.reader, fs::perms::owner_all);
  const auto report = roam::build_store(elsewhere);
  EXPECT_EQ(std::count_if(report.notes.begin(), report.notes.end(), is_of_the_machine), 1);
  expect_same(folder.file("here"), folder.file("elsewhere"));
}

}  // namespace
