// Controllers side by side: what the report makes of known walks, and each controller that is here on a short way.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bench/judge.h"
#include "bench/walkers_report.h"

namespace roam::bench {
namespace {

/// A floor of 40 m x 20 m at z = 0, and a wall across it at x = 10. Their fronts face a body that stands at the origin:
/// PhysX's controller passes through backs.
Scene room() {
  Scene scene{.name = "room", .meshes = {}};
  scene.meshes.push_back({.name = "floor",
                          .vertices = {{-20, -10, 0}, {20, -10, 0}, {20, 10, 0}, {-20, 10, 0}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}}});
  scene.meshes.push_back({.name = "wall",
                          .vertices = {{10, 10, -1}, {10, -10, -1}, {10, -10, 5}, {10, 10, 5}},
                          .triangles = {{0, 1, 2}, {0, 2, 3}}});
  return scene;
}

Judgement judged(const Scene& scene, const Way& way, const Walked& walked) {
  PaperJudge judge;
  judge.watch(way, walked);
  for (const Mesh& mesh : scene.meshes) judge.add(mesh);
  return judge.judgements().front();
}

Walked straight_through(const Way& way, const Vec3& to) {
  return {.nanoseconds = {1.0}, .radii = {way.radius}, .places = {way.from, to}};
}

const Way person{.name = "person",
                 .from = {0, 0, 0.95},
                 .to = {5, 0, 0.95},
                 .radius = 0.3,
                 .speed = 1.4,
                 .walking = true,
                 .adapting = false,
                 .height = 1.8};

TEST(PaperJudge, KnowsTheWholeCapsule) {
  Way low = person;
  low.from.z = low.to.z = 0.85;  // the feet of 1.8 m are 5 cm below the floor
  const Judgement deep = judged(room(), low, straight_through(low, low.to));
  EXPECT_EQ(deep.in_walls, 1U);
  EXPECT_NEAR(deep.deepest, 0.05, 1e-9);
  EXPECT_EQ(judged(room(), person, straight_through(person, person.to)).in_walls, 0U);
  low.height = 0.0;  // a sphere at that height is free
  EXPECT_EQ(judged(room(), low, straight_through(low, low.to)).in_walls, 0U);
}

/// Those in node are there if ROAM_TEST_NODE_MODULES names the folder whose node_modules hold them.
std::vector<Controller> all_controllers() {
  const char* modules = std::getenv("ROAM_TEST_NODE_MODULES");
  return controllers(modules == nullptr ? "" : modules);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Controller& controller : all_controllers()) all.push_back(controller.name);
  return all;
}

class ControllerWalks : public testing::TestWithParam<std::string> {};

TEST_P(ControllerWalks, ReachTheirEndAndStopAtAWall) {
  const std::vector<Controller> all = all_controllers();
  const auto found = std::find_if(all.begin(), all.end(), [](const Controller& c) { return c.name == GetParam(); });
  if (!found->load) GTEST_SKIP() << found->name << " is not here: " << found->missing;
  const Controller& controller = *found;
  const Scene scene = room();
  const Mover mover = controller.load(scene);
  const Walked walked = walk(mover, person, 60.0);
  const Judgement reached = judged(scene, person, walked);
  EXPECT_EQ(reached.ending, Ending::reached);
  // Bodies of games may come into the floor.
  EXPECT_LT(reached.deepest, controller.name == "roam" ? depth_allowed : 0.05);
  const double height = walked.places.back().z;
  EXPECT_NEAR(height, 0.9, 0.06) << "it does not stand on the floor";

  Way into_wall = person;
  into_wall.to.x = 15.0;
  const Walked stopped = walk(mover, into_wall, 60.0);
  EXPECT_EQ(judged(scene, into_wall, stopped).ending, Ending::stuck);
  EXPECT_NEAR(stopped.places.back().x, 9.7, 0.1);

  const Way flight{.name = "flight", .from = {0, 0, 2}, .to = {5, 0, 2}, .radius = 0.3, .speed = 1.4};
  const Walked flown = walk(mover, flight, 60.0);
  EXPECT_EQ(judged(scene, flight, flown).ending, Ending::reached);
  EXPECT_NEAR(flown.places.back().z, 2.0, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Each, ControllerWalks, testing::ValuesIn(names()), [](const auto& test) {
  std::string name = test.param;
  std::erase(name, '-');
  return name;
});

ControllerWalk made(const char* way, const char* controller, double p50, double p99, Ending ending = Ending::reached) {
  ControllerWalk walk{.way = way, .controller = controller, .used = {}};
  walk.judged.ending = ending;
  for (const double noise : {1.0, 2.0, 0.5}) {
    walk.p50.push_back(noise * p50);
    walk.p99.push_back(noise * p99);
    walk.most.push_back(noise * p99);
  }
  return walk;
}

TEST(BenchWalkers, CompareWithTheFastestThatReachedTheEnd) {
  WalkerFindings findings{.scene = "made up", .rounds = 3, .walks = {}, .absent = {}, .failed = {}};
  findings.walks = {made("a", "roam", 1.0, 2.0), made("a", "fast", 3.0, 30.0), made("a", "even", 4.0, 8.0),
                    made("a", "lost", 0.1, 0.1, Ending::stuck), made("b", "roam", 1.0, 2.0)};
  const std::vector<WalkerLead> leads = walker_leads(findings);
  ASSERT_EQ(leads.size(), 2U);
  EXPECT_DOUBLE_EQ(leads[0].p50, 3.0);
  EXPECT_DOUBLE_EQ(leads[0].p99, 4.0);
  EXPECT_EQ(leads[1].p50, 0.0) << "nobody else walked there";
  const app::Json report = walkers_json(findings);
  EXPECT_EQ(report["walks"].size(), 5U);
  EXPECT_EQ(report["walks"][3]["outcome"], "stuck");
  EXPECT_DOUBLE_EQ(report["leads"][0]["p99"], 4.0);
  EXPECT_TRUE(report["leads"][1]["p50"].is_null());
  EXPECT_EQ(walkers_status(findings), app::done);
  findings.walks[0].judged.in_walls = 1;
  EXPECT_EQ(walkers_status(findings), app::answer_no);
  findings.failed = {{"roam", "it"}};
  EXPECT_EQ(walkers_status(findings), app::failed);
}

}  // namespace
}  // namespace roam::bench
