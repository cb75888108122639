// The paper's tables tell apart what was measured and what was not: a way that the clock cut, a row that failed.

#include <gtest/gtest.h>

#include <chrono>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <random>
#include <thread>

#include "bench/judge.h"
#include "bench/paper_report.h"

namespace roam::bench {
namespace {

const Way straight{.name = "straight", .from = Vec3(0.0), .to = {100.0, 0.0, 0.0}};

/// Goes where it is told, at `part` of the speed, and takes `seconds` of the clock for each step.
Mover mover(double part, double seconds) {
  const auto place = std::make_shared<Vec3>(0.0);
  Mover made;
  made.place = [place](const Way& way) { *place = way.from; };
  made.step = [=](const Vec3& velocity) {
    std::this_thread::sleep_for(std::chrono::duration<double>(seconds));
    return *place += part * velocity / paper_rate;
  };
  return made;
}

Ending ending(const Mover& mover, double patience) {
  PaperJudge judge;
  judge.watch(straight, walk(mover, straight, patience));
  return judge.judgements().front().ending;
}

TEST(BenchPaperWays, CallsAWayThatTheClockCutNeitherStuckNorCompleted) {
  EXPECT_EQ(ending(mover(1.0, 0.01), 0.05), Ending::cut);
  EXPECT_EQ(ending(mover(1.0, 0.0), 60.0), Ending::reached);
  EXPECT_EQ(ending(mover(0.0, 0.0), 60.0), Ending::stuck);
}

TEST(BenchPaperWays, GivesWhoLoadsTheRestOfTheFrameOnly) {
  Mover slow = mover(1.0, 0.0);
  const auto step = slow.step;
  slow.step = [step](const Vec3& velocity) {
    // Busy, not asleep: a step is timed in the thread's own time.
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(1);
    while (std::chrono::steady_clock::now() < end) {
    }
    return step(velocity);
  };
  std::vector<double> rests;
  slow.rest = [&](double seconds) { rests.push_back(seconds); };
  const Walked walked = walk(slow, straight, 60.0);
  ASSERT_EQ(rests.size(), walked.nanoseconds.size());
  for (std::size_t i = 0; i < rests.size(); ++i) {
    EXPECT_DOUBLE_EQ(rests[i], std::max(0.0, 1.0 / paper_rate - 1e-9 * walked.nanoseconds[i]));
  }
}

/// Small triangles anywhere around a way of 20 m, a mesh for every fifty.
std::vector<Mesh> litter(std::mt19937& random) {
  std::uniform_real_distribution<double> along(-2.0, 22.0), across(-2.0, 2.0), small(-0.3, 0.3);
  std::vector<Mesh> meshes;
  for (int m = 0; m < 60; ++m) {
    Mesh& mesh = meshes.emplace_back();
    for (std::uint32_t i = 0; i < 50; ++i) {
      const Vec3 middle{along(random), across(random), across(random)};
      for (int k = 0; k < 3; ++k) mesh.vertices.push_back(middle + Vec3(small(random), small(random), small(random)));
      mesh.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
    }
  }
  return meshes;
}

/// Two hundred steps of a body that wanders and whose radius changes.
Walked wandering(std::mt19937& random) {
  std::uniform_real_distribution<double> aside(-0.1, 0.1), radius(0.01, 0.4);
  Walked walked;
  walked.places.emplace_back(0.0);
  for (int i = 0; i < 200; ++i) {
    walked.places.push_back(walked.places.back() + Vec3(0.1, aside(random), aside(random)));
    walked.radii.push_back(radius(random));
    walked.nanoseconds.push_back(1.0);
  }
  return walked;
}

TEST(PaperJudge, FindsPieceByPieceWhatTheWholeSceneSays) {
  std::mt19937 random(7);
  const std::vector<Mesh> scene = litter(random);
  const Reference whole(scene);
  std::vector<Walked> walks;
  for (int i = 0; i < 5; ++i) walks.push_back(wandering(random));
  for (const std::size_t most : {std::size_t{1}, std::size_t{37}, PaperJudge::most_kept}) {
    PaperJudge judge(most);
    for (const Walked& walked : walks) judge.watch(straight, walked);
    for (const Mesh& mesh : scene) judge.add(mesh);
    const std::vector<Judgement> judged = judge.judgements();
    ASSERT_EQ(judged.size(), walks.size());
    for (std::size_t w = 0; w < walks.size(); ++w) {
      const Walked& walked = walks[w];
      std::size_t in_walls = 0;
      double deepest = 0.0;
      bool through = false;
      for (std::size_t i = 0; i < walked.radii.size() && !through; ++i) {
        const Vec3 motion = walked.places[i + 1] - walked.places[i];
        const Query step{{.radius = walked.radii[i]}, walked.places[i], motion};
        const double depth = walked.radii[i] - whole.smallest_clearance(step, 1.0, walked.radii[i]);
        in_walls += depth > depth_allowed ? 1 : 0;
        deepest = std::max(deepest, depth);
        through = whole.sweep({{.radius = 0.0}, step.from, motion}).hit;
      }
      EXPECT_EQ(judged[w].in_walls, in_walls) << most;
      EXPECT_GT(in_walls, 0U);
      EXPECT_DOUBLE_EQ(judged[w].deepest, deepest) << most;
      EXPECT_EQ(judged[w].ending, through ? Ending::through : Ending::stuck) << most;
    }
  }
}

/// Past a wall at y = 0.5, at 0.2 m from it on the last of three steps.
Judgement past_wall(std::vector<double> radii) {
  const Mesh wall{.name = "wall", .vertices = {{-9, 0.5, -9}, {9, 0.5, -9}, {0, 0.5, 18}}, .triangles = {{0, 1, 2}}};
  PaperJudge judge;
  judge.watch(straight, {.nanoseconds = {1.0, 1.0, 1.0},
                         .radii = std::move(radii),
                         .places = {{0, 0, 0}, {0.1, 0, 0}, {0.2, 0, 0}, {0.3, 0.3, 0}}});
  judge.add(wall);
  return judge.judgements().front();
}

TEST(PaperJudge, JudgesEachStepByTheRadiusThatTheBodyHadOnIt) {
  EXPECT_EQ(past_wall({0.45, 0.45, 0.15}).in_walls, 0U);
  const Judgement late = past_wall({0.45, 0.45, 0.25});
  EXPECT_EQ(late.in_walls, 1U);
  EXPECT_NEAR(late.deepest, 0.05, 1e-12);
  EXPECT_EQ(past_wall({0.6, 0.45, 0.15}).in_walls, 1U) << "the least radius of the way would have fitted";
}

const PaperRow roam_row{
    .name = "roam", .title = "roam", .how = "a walker", .missing = {}, .load = [](auto&&) { return Mover{}; }};
const PaperRow other_row{
    .name = "other", .title = "another", .how = "its own", .missing = {}, .load = [](auto&&) { return Mover{}; }};
const PaperRow absent_row{.name = "unity", .title = "Unity", .how = {}, .missing = "not sold here", .load = {}};

/// All ways at one step each, and that way ended.
RowFindings walked(const PaperRow& row, Ending ending, std::size_t in_walls = 0) {
  RowFindings found{.row = &row, .result = {}, .judged = {}};
  for (const Way& way : paper_ways(0.5, 0.7)) {
    found.result.ways.push_back({.nanoseconds = {1000.0}, .radii = {way.radius}, .places = {way.from, way.to}});
    found.judged.push_back({.ending = ending, .in_walls = in_walls});
  }
  return found;
}

RowFindings broken(const PaperRow& row) {
  RowFindings found{.row = &row, .result = {}, .judged = {}};
  found.result.failure = "ended by signal Killed";
  return found;
}

PaperFindings findings(std::vector<RowFindings> rows) {
  return {.scene = "made up",
          .triangles = 1,
          .prepared = 1.0,
          .patience = 7.0,
          .ways = paper_ways(0.5, 0.7),
          .rows = std::move(rows)};
}

TEST(BenchPaperReport, ClaimsNothingOfAWayThatTheClockCut) {
  const PaperFindings found = findings({walked(other_row, Ending::cut), walked(roam_row, Ending::reached)});
  const std::string text = paper_tables(found);
  EXPECT_NE(text.find("not finished in 7 s"), std::string::npos) << text;
  EXPECT_EQ(text.find("stuck"), std::string::npos) << text;
  const app::Json report = paper_json(found);
  EXPECT_EQ(report["patience_s"], 7.0);
  EXPECT_EQ(report["table_1"][0]["outcome"], "not finished");
  EXPECT_TRUE(report["table_1"][0]["time_s"].is_null()) << "no way's time";
  EXPECT_TRUE(report["table_2"][0]["small_room"].is_null());
  EXPECT_EQ(report["table_2"][0]["ways_ended"], 0);
  EXPECT_EQ(report["table_2"][1]["small_room"], true);
  EXPECT_EQ(report["table_2"][1]["ways_ended"], 3);
  EXPECT_EQ(paper_status(found), app::done);
}

TEST(BenchPaperReport, KeepsARowThatFailedApartFromOneThatIsAbsent) {
  const PaperFindings found = findings(
      {walked(roam_row, Ending::reached), broken(other_row), {.row = &absent_row, .result = {}, .judged = {}}});
  const app::Json report = paper_json(found);
  ASSERT_EQ(report["failed"].size(), 1U);
  EXPECT_EQ(report["failed"][0]["row"], "other");
  EXPECT_EQ(report["failed"][0]["why"], "ended by signal Killed");
  ASSERT_EQ(report["absent"].size(), 1U);
  EXPECT_EQ(report["absent"][0]["row"], "unity");
  EXPECT_EQ(report["absent"][0]["why"], "not sold here");
  EXPECT_EQ(paper_status(found), app::done) << "others may fail";
  EXPECT_EQ(paper_tables(found).find("no row went a way"), std::string::npos);
  EXPECT_NE(paper_tables(findings({broken(other_row)})).find("no row went a way"), std::string::npos);
}

TEST(BenchPaperReport, FailsWithARowOfRoamsOwn) {
  EXPECT_EQ(paper_status(findings({broken(roam_row), walked(other_row, Ending::reached)})), app::failed);
  EXPECT_EQ(paper_status(findings({walked(roam_row, Ending::reached, 1)})), app::answer_no);
  EXPECT_EQ(paper_status(findings({walked(other_row, Ending::reached, 1)})), app::done);
}

}  // namespace
}  // namespace roam::bench
