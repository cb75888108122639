// The ends that training finds in real scenes: however the scene lies and however its triangles are written.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "import_files.h"
#include "roam/import.h"
#include "roam/train.h"
#include "words/training.h"

namespace roam::test {
namespace {

using words::answer;

constexpr double same = 2e-4;  ///< m, of both ends

Training trained(std::vector<Mesh> meshes) {
  return train(Survey::build(std::move(meshes), {.lossless = true, .progress = {}}), {.height = 1.8});
}

Mesh joined(const std::vector<Mesh>& meshes) {
  Mesh all;
  for (const Mesh& mesh : meshes) {
    const auto first = static_cast<std::uint32_t>(all.vertices.size());
    all.vertices.insert(all.vertices.end(), mesh.vertices.begin(), mesh.vertices.end());
    for (const auto& t : mesh.triangles) all.triangles.push_back({t[0] + first, t[1] + first, t[2] + first});
  }
  return all;
}

Mesh placed(Mesh mesh, const Vec3& by, double turn) {
  const double c = std::cos(turn), s = std::sin(turn);
  for (Vec3& v : mesh.vertices) v = by + Vec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
  return mesh;
}

Mesh flipped(Mesh mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  return mesh;
}

Mesh doubled(Mesh mesh) {
  const Mesh other = flipped(mesh);
  mesh.triangles.insert(mesh.triangles.end(), other.triangles.begin(), other.triangles.end());
  return mesh;
}

Mesh split(const Mesh& mesh) {
  Mesh out;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle t = mesh.triangle(i);
    const auto first = static_cast<std::uint32_t>(out.vertices.size());
    const Vec3 middle = 0.5 * (t[1] + t[2]);
    for (const Vec3& v : {t[0], t[1], middle, t[2]}) out.vertices.push_back(v);
    out.triangles.push_back({first, first + 1, first + 2});
    out.triangles.push_back({first, first + 2, first + 3});
  }
  return out;
}

Mesh reversed(Mesh mesh) {
  std::reverse(mesh.triangles.begin(), mesh.triangles.end());
  return mesh;
}

TEST(TrainRealScenes, EndsDoNotDependOnHowAnObstacleCourseLiesOrIsWritten) {
  ROAM_NEEDS_TEST_DATA();
  const Mesh mesh = joined(import_scene(test_data() / "building/cpr_obstacle_world.stl").meshes);
  const Training plain = trained({mesh});
  ASSERT_TRUE(plain.largest) << answer(plain);
  EXPECT_NEAR(*plain.largest, 0.4572, 1e-3) << "doors of 3 feet";
  EXPECT_EQ(plain.smallest, 0.0);
  EXPECT_TRUE(plain.feasible) << answer(plain);
  EXPECT_DOUBLE_EQ(plain.radius, 0.3);
  const std::vector<std::pair<std::string, Mesh>> others{{"moved", placed(mesh, {-13739, 253, 182}, 0.0)},
                                                         {"turned", placed(mesh, {0, 0, 0}, 0.6)},
                                                         {"reordered", reversed(mesh)},
                                                         {"split", split(mesh)},
                                                         {"flipped", flipped(mesh)},
                                                         {"doubled", doubled(mesh)}};
  for (const auto& [how, other] : others) {
    const Training t = trained({other});
    ASSERT_TRUE(t.largest) << how << ": " << answer(t);
    EXPECT_NEAR(*t.largest, *plain.largest, same) << how << ": " << answer(t);
    EXPECT_NEAR(t.smallest, plain.smallest, same) << how;
    EXPECT_EQ(t.feasible, plain.feasible) << how << ": " << answer(t);
    const auto trained_parts = [](const Training& which) {
      return std::count_if(which.parts.begin(), which.parts.end(), [](const ConnectedPart& p) { return p.trained; });
    };
    EXPECT_EQ(trained_parts(t), trained_parts(plain)) << how << ": " << answer(t);
  }
}

TEST(TrainRealScenes, WaysInADungeonKeepOutOfAGrooveThatHoldsTheWalker) {
  ROAM_NEEDS_TEST_DATA();
  const Training t = trained(import_scene(test_data() / "recast/dungeon.obj", {.up = UpAxis::y}).meshes);
  EXPECT_TRUE(t.feasible) << answer(t);
  EXPECT_TRUE(t.contradictions.empty()) << answer(t);
  EXPECT_FALSE(t.unwalked.empty()) << answer(t);
}

/// Between furniture higher than a step and lower than the middle of a wide body. And on a bench, where a wall on one
/// side and the edge are the narrowest of a way: a body of any size drops off it, or passes farther from the wall.
TEST(TrainRealScenes, NoTrialInAHouseContradictsItsOpenings) {
  ROAM_NEEDS_TEST_DATA();
  const Survey house =
      Survey::build(import_scene(test_data() / "building/small_house.glb").meshes, {.lossless = true, .progress = {}});
  struct Case {
    double height;
    std::uint64_t seed;
  };
  for (const Case& c : {Case{1.7, 1}, Case{1.7, 3}, Case{1.8, 4}}) {
    const Training t = train(house, {.seed = c.seed, .height = c.height});
    EXPECT_TRUE(t.feasible && t.largest.has_value()) << answer(t);
    EXPECT_TRUE(t.contradictions.empty()) << "height " << c.height << ", seed " << c.seed << ": " << answer(t);
  }
}

}  // namespace
}  // namespace roam::test
