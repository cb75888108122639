// roam bench as a shell sees it: what it takes, what it says, and what is not there. No time is judged.
#include <gtest/gtest.h>

#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <thread>

#include "messages.h"
#include "program.h"

namespace {

ProgramResult bench(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), "bench");
  return run_program(ROAM_PROGRAM, arguments);
}

TEST(BenchVerb, ListsWhatItMeasuresAndAsksWhich) {
  const ProgramResult help = bench({"--help"});
  EXPECT_EQ(help.status, 0) << help.err;
  for (const char* verb : {"engines", "labels", "paper", "scale", "walkers"})
    EXPECT_TRUE(contains(help.out, verb)) << help.out;
  const ProgramResult nothing = bench({});
  EXPECT_EQ(nothing.status, 2);
  EXPECT_TRUE(contains(nothing.err, "engines, labels, paper, scale or walkers")) << nothing.err;
}

TEST(BenchVerb, SaysHowToGetTheProgramWhereItIsNotInstalled) {
  const TestFolder folder;
  const std::string alone = folder.file("roam");
  std::filesystem::copy_file(ROAM_PROGRAM, alone);
  const ProgramResult result = run_program(alone, {"bench", "engines"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "roam-bench")) << result.err;
  EXPECT_TRUE(contains(result.err, "cmake --preset bench")) << result.err;
}

TEST(BenchVerb, RefusesAProgramThatCannotBeRun) {
  ::setenv("ROAM_BENCH", "/no/such/program", 1);
  const ProgramResult result = bench({"engines"});
  ::unsetenv("ROAM_BENCH");
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "/no/such/program")) << result.err;
}

#ifdef ROAM_HAS_BENCH

/// The report of a run that succeeds.
nlohmann::json report_of(std::vector<std::string> arguments) {
  arguments.emplace_back("--json");
  const ProgramResult result = bench(std::move(arguments));
  EXPECT_EQ(result.status, 0) << result.err;
  return nlohmann::json::parse(result.out, nullptr, false);
}

const std::vector<std::string> small{"engines",  "--triangles", "10000",      "--queries", "200",
                                     "--rounds", "2",           "--patience", "100000"};

std::vector<std::string> with(std::vector<std::string> arguments, const std::vector<std::string>& more) {
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(BenchEngines, TellsWrongAnswersAndTimesOfEachEngineOnEachSet) {
  const nlohmann::json report =
      report_of(with(small, {"--sets", "random,capsule", "--engines", "roam,paper"}))["scenes"][0];
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

TEST(BenchEngines, MeasuresRaysAndNearestPointsBesideTheSweeps) {
  const std::vector<std::string> more{"--sets", "random,rays,walkrays,nearest", "--engines", "roam,paper"};
  const nlohmann::json report = report_of(with(small, more));
  std::vector<std::string> sets;
  for (const auto& run : report["scenes"][0]["runs"]) {
    sets.push_back(run["set"]);
    EXPECT_GT(run["p50_us"], 0.0);
    EXPECT_EQ(run["engine"], run["set"] == "random" && sets.size() == 2 ? "the paper's method" : "roam")
        << "the paper's method has no rays";
    EXPECT_TRUE(run["engine"] != "roam" || run["late"] == 0) << run;
  }
  EXPECT_EQ(sets, (std::vector<std::string>{"random", "random", "rays", "walkrays", "nearest"}));
  EXPECT_EQ(report["leads"]["rows"].size(), 1U) << "means of sweeps only";

  const ProgramResult text = bench(with(small, more));
  const std::size_t sweeps = text.out.find("random "), points = text.out.find("rays and nearest points");
  ASSERT_NE(points, std::string::npos) << text.out;
  EXPECT_LT(sweeps, points);
  EXPECT_LT(points, text.out.find("walkrays "));
}

TEST(BenchEngines, MeasuresSeveralScenesAndComparesOverAllRows) {
  const std::vector<std::string> scenes{"--scene", "gallery:10k", "--scene", "terrain", "--sets", "random,long"};
  const nlohmann::json report = report_of(with(with(small, scenes), {"--engines", "roam,polytope,paper"}));
  ASSERT_EQ(report["scenes"].size(), 2U);
  EXPECT_TRUE(contains(report["scenes"][0]["scene"], "gallery")) << report;
  EXPECT_TRUE(contains(report["scenes"][1]["scene"], "terrain")) << report;
  ASSERT_EQ(report["leads"]["rows"].size(), 4U);
  double product = 1.0, least = 1e9;
  for (const auto& row : report["leads"]["rows"]) {
    EXPECT_EQ(row["p99"]["engine"], "the paper's method") << "the polytope does not say when";
    product *= row["p99"]["times"].get<double>();
    least = std::min(least, row["p99"]["times"].get<double>());
  }
  EXPECT_NEAR(std::pow(report["leads"]["all"]["p99"]["mean"].get<double>(), 4.0) / product, 1.0, 1e-9);
  EXPECT_EQ(report["leads"]["all"]["p99"]["worst"], least);

  const ProgramResult text = bench(with(with(small, scenes), {"--engines", "roam,paper"}));
  for (const char* words : {"geometric mean", "worst row by hit p50"})
    EXPECT_TRUE(contains(text.out, words)) << text.out;
}

TEST(BenchEngines, NamesEnginesThatAreNotHereAndWhatToInstall) {
  const ProgramResult result =
      bench(with(small, {"--sets", "random", "--engines", "roam,physx-wasm,jolt-wasm,three-mesh-bvh"}));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_TRUE(contains(result.out, "physx")) << result.out;
  EXPECT_TRUE(contains(result.out, "npm install --prefix DIR physx-js-webidl")) << result.out;
  EXPECT_TRUE(contains(result.out, "npm install --prefix DIR jolt-physics")) << result.out;
  EXPECT_TRUE(contains(result.out, "npm install --prefix DIR three three-mesh-bvh")) << result.out;

  const TestFolder folder;
  const ProgramResult elsewhere =
      bench(with(small, {"--engines", "physx-wasm", "--wasm-engines", folder.file("nothing")}));
  EXPECT_EQ(elsewhere.status, 1);
  EXPECT_TRUE(contains(elsewhere.err, "none of the chosen engines")) << elsewhere.err;
  EXPECT_TRUE(contains(elsewhere.err, "npm install --prefix " + folder.file("nothing"))) << elsewhere.err;
}

TEST(BenchEngines, PrintsATableAndDrawsBars) {
  const TestFolder folder;
  const std::string picture = folder.file("engines.svg");
  const ProgramResult result =
      bench(with(small, {"--sets", "random", "--engines", "roam,paper", "--picture", picture}));
  ASSERT_EQ(result.status, 0) << result.err;
  for (const char* head : {"missed", "late", "early", "deepest", "p50", "p99", "max", "B/triangle", "build 1, s"}) {
    EXPECT_TRUE(contains(result.out, head)) << result.out;
  }
  const std::string svg = folder.read("engines.svg");
  EXPECT_TRUE(contains(svg, "<svg"));
  std::size_t letters = 0;
  for (std::size_t k = 0; (k = svg.find("xlink:href", k)) != std::string::npos; ++k) ++letters;
  EXPECT_GT(letters, 100U) << svg;
}

TEST(BenchEngines, RefusesASceneThatIsNotThere) {
  const ProgramResult missing = bench({"engines", "--scene", "/no/such/scene.ply"});
  EXPECT_EQ(missing.status, 1);
  EXPECT_TRUE(contains(missing.err, "/no/such/scene.ply")) << missing.err;
}

TEST(BenchWalkers, WalksThreeWaysAndSaysWhoCameIntoWalls) {
  const nlohmann::json report = report_of({"walkers", "--triangles", "50k", "--rounds", "1", "--controllers", "roam"});
  ASSERT_EQ(report["walks"].size(), 3U);
  for (const auto& walk : report["walks"]) {
    EXPECT_EQ(walk["outcome"], "completed") << walk;
    EXPECT_EQ(walk["steps_in_walls"], 0) << walk;
    EXPECT_GT(walk["steps"], 2000) << walk;
    EXPECT_GE(walk["p99_us"], walk["p50_us"]);
  }
}

nlohmann::json row_of(const nlohmann::json& rows, const std::string& name) {
  for (const auto& row : rows) {
    if (row["row"] == name) return row;
  }
  return {};
}

TEST(BenchPaper, MeasuresBothTablesAndNamesRowsThatCannotBeRun) {
  const nlohmann::json report =
      report_of({"paper", "--triangles", "50k", "--rows", "roam,osg-bullet,polytope-kdtree,ogre-bullet,unity"});
  const bool with_bullet = row_of(report["absent"], "osg-bullet").is_null();
  const bool with_ogre = row_of(report["absent"], "ogre-bullet").is_null();
  ASSERT_EQ(report["table_1"].size(), 6U * (2U + (with_bullet ? 1U : 0U) + (with_ogre ? 1U : 0U))) << "six ways a row";
  std::map<std::string, std::map<std::string, std::string>> outcomes;
  std::map<std::string, std::map<std::string, int>> steps;
  for (const auto& cell : report["table_1"]) {
    EXPECT_GT(cell["steps"], 0);
    EXPECT_GE(cell["time_s"].get<double>(), cell["steps"].get<double>() / 60.0);
    if (cell["row"] == "roam") {
      EXPECT_EQ(cell["steps_in_walls"], 0) << cell;
    }
    outcomes[cell["row"]][cell["way"]] = cell["outcome"];
    steps[cell["row"]][cell["way"]] = cell["steps"];
  }
  auto &roam = outcomes["roam"], &polytope = outcomes["polytope-kdtree"], &bullet = outcomes["osg-bullet"];
  if (with_bullet) {
    EXPECT_EQ(bullet["3 split"], "completed") << "held by the tolerance of its sweep";
  }
  if (with_ogre) {
    EXPECT_EQ(outcomes["ogre-bullet"], bullet) << "the same triangles, read by another";
    EXPECT_EQ(steps["ogre-bullet"], steps["osg-bullet"]);
    EXPECT_GT(row_of(report["table_2"], "ogre-bullet")["load_s"], 0.0);
  }
  for (const char* way : {"1 straight", "2 corner", "3 split", "grotto", "grotto, adapted"}) {
    EXPECT_EQ(roam[way], "completed") << way;
  }
  EXPECT_EQ(roam["3 split, smaller"], "fell");
  EXPECT_EQ(polytope["2 corner"], "stuck") << "as the paper prints it";
  EXPECT_EQ(polytope["grotto, adapted"], "stuck");
  const nlohmann::json two = row_of(report["table_2"], "roam");
  EXPECT_GT(two["load_s"], 0.0);
  EXPECT_GT(two["peak_mib"], 1.0);
  EXPECT_EQ(two["flew_off"], 0);
  EXPECT_TRUE(two["small_room"]);
  EXPECT_TRUE(two["radius_adapts"]);
  EXPECT_FALSE(row_of(report["table_2"], "polytope-kdtree")["radius_adapts"]);
  EXPECT_FALSE(row_of(report["absent"], "unity")["why"].get<std::string>().empty());
  EXPECT_TRUE(report["failed"].empty()) << report["failed"];
}

// The finer the wall, the more of its triangles touch who is held within Bullet's tolerance of it.
TEST(BenchPaper, KeepsBulletFarEnoughOffAWallToFallAlongIt) {
  const nlohmann::json report = report_of({"paper", "--triangles", "300k", "--rows", "roam-sweep,osg-bullet"});
  if (!row_of(report["absent"], "osg-bullet").is_null()) GTEST_SKIP() << "no Bullet here";
  std::map<std::string, int> steps;
  for (const auto& cell : report["table_1"]) {
    if (cell["way"] != "3 split, smaller") continue;
    EXPECT_EQ(cell["outcome"], "fell") << cell;
    steps[cell["row"]] = cell["steps"];
  }
  ASSERT_EQ(steps.size(), 2U);
  EXPECT_LE(steps["osg-bullet"], steps["roam-sweep"] + 3) << "both fall freely";
}

TEST(BenchPaper, EndsARowThatTakesMoreThanItMay) {
  const std::vector<std::string> row{"paper", "--triangles", "50k", "--rows", "polytope-kdtree,physx"};
  for (const auto& [option, least, why] : {std::array{"--memory", "10MiB", "more than 10 MiB of memory"},
                                           std::array{"--loading", "0.001", "not loaded the scene in 0.001 s"}}) {
    const nlohmann::json report = report_of(with(row, {option, least}));
    EXPECT_TRUE(contains(row_of(report["failed"], "polytope-kdtree")["why"], why)) << report["failed"];
    EXPECT_TRUE(contains(row_of(report["absent"], "physx")["why"], "npm install")) << report["absent"];
    EXPECT_TRUE(report["table_1"].empty());
  }
}

/// The kinds of files that are in a folder at some time while `work` is done, by their extensions.
template <class Work>
std::set<std::string> kinds_meanwhile(const std::string& folder, const Work& work) {
  namespace fs = std::filesystem;
  std::set<std::string> kinds;
  std::atomic<bool> done = false;
  std::thread look([&] {
    while (!done) {
      try {
        for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
          kinds.insert(entry.path().extension());
        }
      } catch (const fs::filesystem_error&) {
        // It went while it was looked at.
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  });
  work();
  done = true;
  look.join();
  return kinds;
}

TEST(BenchPaper, LaysOutOnlyWhatTheRowsRead) {
  for (const auto& [row, reads] :
       {std::pair{"roam", ".ply"}, {"roam-store", ".roam"}, {"polytope-kdtree", ".osgb"}, {"ogre-bullet", ".mesh"}}) {
    const TestFolder folder;
    ProgramResult result;
    const std::set<std::string> kinds = kinds_meanwhile(folder.file(""), [&] {
      result = bench({"paper", "--triangles", "50k", "--rows", row, "--scratch", folder.file("")});
    });
    if (row == std::string("ogre-bullet") && result.status == 1) {
      EXPECT_TRUE(contains(result.err, "libogre")) << result.err;
      continue;
    }
    ASSERT_EQ(result.status, 0) << result.err;
    for (const char* kind : {".ply", ".roam", ".osgb", ".mesh"}) {
      const bool wanted = kind == std::string(".ply") || kind == std::string(reads);
      EXPECT_EQ(kinds.contains(kind), wanted) << row << " " << kind;
    }
  }
}

TEST(BenchPaper, SaysAtOnceThatNoneOfItsRowsCanBeRun) {
  const ProgramResult result = bench({"paper", "--rows", "unity,physx"});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "unity: it cannot be run")) << result.err;
  EXPECT_TRUE(contains(result.err, "physx: `npm install")) << result.err;
  EXPECT_FALSE(contains(result.err, "laying out")) << result.err;
}

/// Interrupts that command after each of some times, and looks at what is left.
void expect_to_end_on_ctrl_c(std::vector<std::string> arguments, const std::vector<double>& seconds) {
  arguments.insert(arguments.begin(), "bench");
  for (const double after : seconds) {
    const TestFolder folder;
    std::vector<std::string> all = arguments;
    if (all[1] != "engines") all.insert(all.end(), {"--scratch", folder.file("")});
    const ProgramResult result = run_program(ROAM_PROGRAM, all, {.input = {}, .interrupt_after = after});
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_TRUE(contains(result.err, "cancelled")) << result.err;
    EXPECT_TRUE(std::filesystem::is_empty(folder.file(""))) << "after " << after << " s";
  }
}

// The scenes are far larger than what is done by then: they would run for minutes.
TEST(BenchInterrupted, EndsEachMeasurementAndLeavesNothing) {
  expect_to_end_on_ctrl_c({"paper", "--triangles", "100M"}, {1.0});
  expect_to_end_on_ctrl_c({"scale", "--least", "100M", "--triangles", "100M", "--memory", "0.1"}, {1.0});
  expect_to_end_on_ctrl_c({"engines", "--triangles", "10000", "--queries", "200", "--rounds", "1000000"}, {3.0});
}

// By a signal to the command alone, as from a supervisor: the row is another process, and goes on for long.
TEST(BenchInterrupted, EndsTheRowThatRuns) {
  expect_to_end_on_ctrl_c({"paper", "--triangles", "2M", "--rows", "polytope"}, {7.0});
}

TEST(BenchPaper, RefusesASceneThatIsNotAtThePlaceOfTable1) {
  const TestFolder folder;
  const std::string elsewhere = folder.write("triangle.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const ProgramResult result = bench({"paper", "--scene", elsewhere});
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(contains(result.err, "Table 1")) << result.err;
}

TEST(BenchScale, GoesFromMemoryToAStoreAndDrawsIt) {
  const TestFolder folder;
  const nlohmann::json sizes = report_of({"scale", "--least", "10k", "--triangles", "50k", "--memory", "0.001",
                                          "--rounds", "1", "--picture", folder.file("scale.svg")})["sizes"];
  ASSERT_EQ(sizes.size(), 2U);
  EXPECT_TRUE(sizes[0]["in_memory"]);
  EXPECT_FALSE(sizes[1]["in_memory"]);
  for (const auto& size : sizes) {
    EXPECT_GT(size["bytes"], 0);
    for (const char* what : {"sweep", "clearance", "step"}) EXPECT_GE(size[what]["p99_us"], size[what]["p50_us"]);
  }
  EXPECT_TRUE(contains(folder.read("scale.svg"), "<svg"));
}

TEST(BenchVerbs, RefuseBeforeAnyWorkWhatCanOnlyFail) {
  const TestFolder folder;
  for (const char* verb : {"engines", "paper", "scale", "walkers"}) {
    const ProgramResult nowhere = bench({verb, "--picture", folder.file("no/such/folder.svg")});
    EXPECT_EQ(nowhere.status, 2) << nowhere.err;
    EXPECT_TRUE(contains(nowhere.err, "there is no folder")) << nowhere.err;
    const ProgramResult no_format = bench({verb, "--picture", folder.file("chart.txt")});
    EXPECT_EQ(no_format.status, 2) << no_format.err;
    EXPECT_TRUE(contains(no_format.err, ".svg or a .png")) << no_format.err;
    for (const char* count : {"0", "-5", "9999", "2000M", "many"}) {
      const ProgramResult result = bench({verb, "--triangles", count});
      EXPECT_EQ(result.status, 2) << verb << " " << count << ": " << result.err;
      EXPECT_TRUE(contains(result.err, "--triangles")) << result.err;
    }
  }
  using Words = std::vector<std::string>;
  for (const Words& words : {Words{"engines", "--queries", "0"},
                             Words{"engines", "--queries", "1000000000000"},
                             Words{"engines", "--rounds", "-1"},
                             Words{"engines", "--origin", "nan,0,0"},
                             Words{"engines", "--origin", "1e300,0,0"},
                             Words{"engines", "--engines", "unity"},
                             Words{"engines", "--sets", "sideways"},
                             Words{"engines", "--patience", "0"},
                             Words{"engines", "--scene", "gallery:many"},
                             Words{"walkers", "--controllers", "unity"},
                             Words{"paper", "--rows", "unreal"},
                             Words{"scale", "--least", "2M", "--triangles", "1M"},
                             Words{"paper", "--triangles", "49k"},
                             Words{"paper", "--radius", "5"},
                             Words{"paper", "--split-radius", "nan"},
                             Words{"paper", "--memory", "8"},
                             Words{"paper", "--triangles", "1M", "--scene", "own.ply"},
                             Words{"scale", "--rounds", "0"},
                             Words{"scale", "--pager", "1"},
                             Words{"scale", "--speed", "1e-9"}}) {
    const ProgramResult result = bench(words);
    EXPECT_EQ(result.status, 2) << words[0] << " " << words[1] << " " << words[2] << ": " << result.err;
    EXPECT_TRUE(contains(result.err, words[1])) << result.err;
  }
}

#endif

}  // namespace
