// How much work training takes in rough caves, counted in places, trials and steps.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "import_files.h"
#include "roam/import.h"
#include "roam/train.h"
#include "train_scenes.h"
#include "ways/trials/trials.h"

namespace {

using namespace roam;

constexpr double length = 24.0, width = 8.0;  // m, of the cave

/// Three halls of rough ground under a rough roof, with passages of 1 m between them.
Mesh cave() {
  scenes::Random random(5);
  Mesh mesh;
  constexpr int along = 96, across = 32;
  constexpr double cell = length / along;
  const auto add_ground = [&](double level, double rise, double roughness) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    for (int i = 0; i <= along; ++i) {
      for (int k = 0; k <= across; ++k) {
        const double x = cell * i, y = cell * k;
        mesh.vertices.push_back(
            {x, y, level + rise * std::sin(1.1 * x) * std::cos(0.9 * y) + random.between(-roughness, roughness)});
      }
    }
    for (std::uint32_t i = 0; i < along; ++i) {
      for (std::uint32_t k = 0; k < across; ++k) {
        const std::uint32_t a = first + i * (across + 1) + k, b = a + 1, c = a + across + 1, d = c + 1;
        mesh.triangles.insert(mesh.triangles.end(), {{a, c, d}, {a, d, b}});
      }
    }
  };
  add_ground(0.0, 0.3, 0.08);
  add_ground(3.0, 0.4, 0.2);
  for (const double y : {0.0, width}) scenes::add_wall(mesh, 0.0, y, length, y, -1.0, 4.0);
  for (const double x : {0.0, length}) scenes::add_wall(mesh, x, 0.0, x, width, -1.0, 4.0);
  for (const double x : {8.0, 16.0}) {
    scenes::add_box(mesh, {x, 0.0, -1.0}, {x + 1.0, 3.5, 4.0});
    scenes::add_box(mesh, {x, 4.5, -1.0}, {x + 1.0, width, 4.0});
  }
  return mesh;
}

TEST(Trial, OfABodyThatIsStuckInACaveIsShort) {
  const Survey survey = survey_of({cave()});
  const auto floor = [&](double x, double y) {
    const Vec3 from(x, y, 2.0), down(0.0, 0.0, -4.0);
    return from + survey.world().sweep({.radius = 0.0}, from, down).time * down;
  };
  int stuck = 0, most = 0;
  for (const double radius : {0.45, 0.51, 0.55, 0.65}) {
    for (double y = 1.0; y <= width - 1.0; y += 0.5) {
      int asked = 0;  // once in 256 steps
      const Trial trial = ways::try_way(survey, {.height = 1.8}, radius, 0.0, {{floor(2.0, y), floor(22.0, width - y)}},
                                        [&] { return ++asked > 0; });
      stuck += trial.outcome == Outcome::blocked ? 1 : 0;
      most = std::max(most, asked);
    }
  }
  EXPECT_GT(stuck, 30);
  EXPECT_LE(most, 4) << "free motion takes 2";
  RecordProperty("stuck", stuck);
  RecordProperty("most", most);
}

/// `area`: m2 of floor in the scene, tops of things included; `trials`: of a path, on average.
void expect_little_work(const Survey& survey, double area, std::size_t trials) {
  const Training t = train(survey, {.height = 1.8});
  ASSERT_FALSE(t.paths.empty());
  std::size_t made = 0;
  for (const TrainedPath& path : t.paths) made += path.trials.size();
  EXPECT_LE(static_cast<double>(t.places), 26.0 * area);  // in a lattice of 0.2 m
  EXPECT_LE(made, trials * t.paths.size());
  testing::Test::RecordProperty("places", static_cast<int>(t.places));
  testing::Test::RecordProperty("paths", static_cast<int>(t.paths.size()));
  testing::Test::RecordProperty("trials", static_cast<int>(made));
}

TEST(Training, WorksWithinABudget) { expect_little_work(survey_of({cave()}), length * width, 3); }

TEST(TrainRealScenes, WorkWithinABudget) {
  ROAM_NEEDS_TEST_DATA();
  const auto expect_little = [](const char* file, double area, std::size_t trials) {
    SCOPED_TRACE(file);
    const auto scene = import_scene(roam::test::test_data() / file);
    expect_little_work(Survey::build(scene.meshes, {.lossless = true}), area, trials);
  };
  expect_little("underground/subt_cave_3way_20m.dae", 110.0, 2);
  expect_little("underground/pittsburgh_mine.dae", 15'000.0, 3);
}

}  // namespace
