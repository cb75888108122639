// The paper's tables tell apart what was measured and what was not: a way that the clock cut, a row that failed.

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "../bench/paper_report.h"

namespace roam::bench {
namespace {

/// A floor far below the way, so that there is something to judge by.
Reference far_below() {
  const Mesh floor{.name = "floor", .vertices = {{-9, -9, -9}, {9, -9, -9}, {0, 9, -9}}, .triangles = {{0, 1, 2}}};
  return Reference({&floor, 1});
}

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
  return judge(straight, walk(mover, straight, patience), far_below()).ending;
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

const PaperRow roam_row{
    .name = "roam", .title = "roam", .how = "a walker", .missing = {}, .load = [](auto&&) { return Mover{}; }};
const PaperRow other_row{
    .name = "other", .title = "another", .how = "its own", .missing = {}, .load = [](auto&&) { return Mover{}; }};
const PaperRow absent_row{.name = "unity", .title = "Unity", .how = {}, .missing = "not sold here", .load = {}};

/// All ways at one step each, and that way ended.
RowFindings walked(const PaperRow& row, Ending ending, std::size_t in_walls = 0) {
  RowFindings found{.row = &row, .result = {}, .judged = {}};
  for (const Way& way : paper_ways(0.5, 0.7)) {
    found.result.ways.push_back({.nanoseconds = {1000.0}, .places = {way.from, way.to}, .radius = way.radius});
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
}

TEST(BenchPaperReport, FailsWithARowOfRoamsOwn) {
  EXPECT_EQ(paper_status(findings({broken(roam_row), walked(other_row, Ending::reached)})), app::failed);
  EXPECT_EQ(paper_status(findings({walked(roam_row, Ending::reached, 1)})), app::answer_no);
  EXPECT_EQ(paper_status(findings({walked(other_row, Ending::reached, 1)})), app::done);
}

}  // namespace
}  // namespace roam::bench
