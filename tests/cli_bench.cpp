// roam bench as a shell sees it: what it takes, what it says, and what is not there. No time is judged.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "program.h"

namespace {

ProgramResult bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "bench");
  return run_program(ROAM_PROGRAM, arguments);
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

TEST(BenchVerb, ListsWhatItMeasuresAndAsksWhich) {
  const ProgramResult help = bench({"--help"});
  EXPECT_EQ(help.status, 0) << help.err;
  for (const char* verb : {"engines", "paper", "scale"}) EXPECT_TRUE(says(help.out, verb)) << help.out;
  const ProgramResult nothing = bench({});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(says(nothing.err, "engines, paper or scale")) << nothing.err;
}

TEST(BenchVerb, SaysHowToGetTheProgramWhereItIsNotInstalled) {
  const TestFolder folder;
  const std::string alone = folder.file("roam");
  std::filesystem::copy_file(ROAM_PROGRAM, alone);
  const ProgramResult result = run_program(alone, {"bench", "engines"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(says(result.err, "roam-bench")) << result.err;
  EXPECT_TRUE(says(result.err, "cmake --preset bench")) << result.err;
}

TEST(BenchVerb, RefusesAProgramThatCannotBeRun) {
  ::setenv("ROAM_BENCH", "/no/such/program", 1);
  const ProgramResult result = bench({"engines"});
  ::unsetenv("ROAM_BENCH");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(says(result.err, "/no/such/program")) << result.err;
}

#ifdef ROAM_HAS_BENCH

nlohmann::json json(const ProgramResult& result) { return nlohmann::json::parse(result.out, nullptr, false); }

const std::vector<std::string> small{"engines",  "--triangles", "10000",      "--queries", "200",
                                     "--rounds", "2",           "--patience", "0.05"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(BenchEngines, TellsWrongAnswersAndTimesOfEachEngineOnEachSet) {
  const ProgramResult result = bench(with(small, {"--json", "--sets", "random,capsule", "--engines", "roam,paper"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json report = json(result);
  EXPECT_NEAR(report["triangles"].get<double>(), 10'000, 300);
  ASSERT_EQ(report["engines"].size(), 2U);
  EXPECT_EQ(report["engines"][0]["engine"], "roam");
  EXPECT_GT(report["engines"][0]["bytes_a_triangle"], 5.0);
  ASSERT_EQ(report["runs"].size(), 3U) << "the paper's method knows no capsule";
  for (const auto& run : report["runs"]) {
    EXPECT_GT(run["queries"], 0);
    EXPECT_GT(run["p50_us"], 0.0);
    EXPECT_GE(run["p99_us"], run["p50_us"]);
    EXPECT_GE(run["max_us"], run["p99_us"]);
    if (run["engine"] != "roam") continue;
    EXPECT_EQ(run["queries"], 200);
    for (const char* wrong : {"missed", "late"}) EXPECT_EQ(run[wrong], 0) << run;
  }
}

TEST(BenchEngines, NamesEnginesThatAreNotHereAndWhatToInstall) {
  const ProgramResult result = bench(with(small, {"--sets", "random", "--engines", "roam,physx,jolt"}));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(says(result.out, "physx")) << result.out;
  EXPECT_TRUE(says(result.out, "npm install --prefix DIR physx-js-webidl")) << result.out;
  EXPECT_TRUE(says(result.out, "npm install --prefix DIR jolt-physics")) << result.out;

  const TestFolder folder;
  const ProgramResult elsewhere = bench(with(small, {"--engines", "physx", "--wasm-engines", folder.file("nothing")}));
  EXPECT_EQ(elsewhere.status, 1);
  EXPECT_TRUE(says(elsewhere.err, "none of the engines")) << elsewhere.err;
}

TEST(BenchEngines, PrintsATableAndDrawsBars) {
  const TestFolder folder;
  const std::string picture = folder.file("engines.svg");
  const ProgramResult result =
      bench(with(small, {"--sets", "random", "--engines", "roam,paper", "--picture", picture}));
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* head : {"missed", "late", "early", "deepest", "p50", "p99", "max", "B/triangle", "build 1, s"}) {
    EXPECT_TRUE(says(result.out, head)) << result.out;
  }
  const std::string svg = folder.read("engines.svg");
  EXPECT_TRUE(svg.starts_with("<svg")) << svg;
  EXPECT_TRUE(says(svg, ">roam<")) << svg;
  EXPECT_TRUE(says(svg, ">the paper's method<")) << svg;
  EXPECT_TRUE(says(svg, "% missed or late")) << svg;
}

TEST(BenchEngines, RefusesWhatItDoesNotKnow) {
  EXPECT_EQ(bench({"engines", "--engines", "unity"}).status, 2);
  EXPECT_EQ(bench({"engines", "--sets", "sideways"}).status, 2);
  EXPECT_EQ(bench({"engines", "--patience", "0"}).status, 2);
  const ProgramResult missing = bench({"engines", "--scene", "/no/such/scene.ply"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(says(missing.err, "/no/such/scene.ply")) << missing.err;
}

#endif

}  // namespace
