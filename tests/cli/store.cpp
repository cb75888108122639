// roam build, info, verify, walk and sweep with a store, as a shell sees them.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <random>
#include <sstream>

#include "sanitizer.h"
#include "store/opened.h"
#include "store_verbs.h"

namespace {

using namespace store_verbs;
using nlohmann::json;

TEST_F(StoreVerbs, InfoSaysWhatItHoldsAndCosts) {
  const json scene_info = json::parse(run({"info", scene(), "--json"}).out);
  const ProgramResult told = run({"info", store(), "--json"});
  ASSERT_EQ(told.status, 0) << told.err;
  const json info = json::parse(told.out);
  EXPECT_EQ(info["triangles"], scene_info["triangles"]);
  EXPECT_EQ(info["bounds"], scene_info["bounds"]);
  EXPECT_EQ(info["format"], "store 1");
  EXPECT_EQ(info["hash"].get<std::string>().size(), 64U);
  std::uintmax_t bytes = 0;
  for (const auto& entry : fs::recursive_directory_iterator(store())) {
    if (entry.is_regular_file() && entry.path().extension() != "" && entry.path().parent_path().filename() != "spare") {
      bytes += entry.file_size();
    }
  }
  EXPECT_NEAR(info["bytes"].get<double>(), static_cast<double>(bytes), 200.0) << "all files, CURRENT too";
  EXPECT_GT(info["tiles"], 1);
  EXPECT_GT(info["largest_error_m"], 0.0);
  EXPECT_LT(info["largest_error_m"], 1e-3);
}

TEST_F(StoreVerbs, SweepAnswersAsTheSceneDoes) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> along(0.0, 100.0), off(-1.0, 1.0), way(-5.0, 5.0);
  std::string queries;
  for (int i = 0; i < 300; ++i) {
    const double s = along(random);
    queries += std::to_string(-13739 + s) + ',' + std::to_string(253 + 1.063 * s + off(random)) + ',' +
               std::to_string(182 + 0.5 * off(random)) + ',' + std::to_string(way(random)) + ',' +
               std::to_string(way(random)) + ',' + std::to_string(way(random)) + ",0.2\n";
  }
  const ProgramResult by_scene = run({"sweep", scene()}, queries), by_store = run({"sweep", store()}, queries);
  ASSERT_EQ(by_store.status, 0) << by_store.err;
  std::istringstream a(by_scene.out), b(by_store.out);
  int hits = 0, same = 0, rows = 0;
  for (std::string row_a, row_b; std::getline(a, row_a) && std::getline(b, row_b); ++rows) {
    if (rows == 0) {
      EXPECT_EQ(row_a, row_b);
      continue;
    }
    std::vector<std::string> fields_a, fields_b;
    for (auto [row, fields] : {std::pair(&row_a, &fields_a), std::pair(&row_b, &fields_b)}) {
      std::istringstream in(*row);
      for (std::string field; std::getline(in, field, ',');) fields->push_back(field);
    }
    ASSERT_EQ(fields_a[0], fields_b[0]) << row_a << '\n' << row_b;
    if (fields_a[0] == "0") continue;
    ++hits;
    // Both err by the tiles' error at most, along a way of at most 8.7 m that may graze.
    EXPECT_NEAR(std::stod(fields_a[1]), std::stod(fields_b[1]), 0.02) << row_a << '\n' << row_b;
    same += fields_a[8] == fields_b[8] ? 1 : 0;
  }
  EXPECT_EQ(rows, 301);
  EXPECT_GT(hits, 150);
  EXPECT_GT(same, hits * 9 / 10) << "triangles are numbered as in the scene, but for neighbours that are met together";
}

TEST_F(StoreVerbs, AWalkIsVerifiedAgainstTheStoreAndAgainstTheScene) {
  for (const std::vector<std::string>& check :
       {std::vector<std::string>{"--verify"}, std::vector<std::string>{"--against", scene()}}) {
    for (const char* mode : {"walk", "fly"}) {
      std::vector<std::string> arguments{"walk", store(),   "--path", path(),     "--mode", mode,    "--height",
                                         "1.8",  "--speed", "20",     "--memory", "8M",     "--json"};
      arguments.insert(arguments.end(), check.begin(), check.end());
      const ProgramResult walked = run(arguments);
      ASSERT_EQ(walked.status, 0) << walked.err << walked.out;
      const json report = json::parse(walked.out);
      EXPECT_EQ(report["outcome"], "reached");
      EXPECT_EQ(report["violations"], 0);
      EXPECT_GT(report["verified"]["distances"], 1000);
      EXPECT_EQ(report["verified"]["overstated_clearances"], 0);
      EXPECT_LE(report["paging"]["memory"], 8 << 20);
      EXPECT_GT(report["paging"]["loads"], 0);
    }
  }
}

TEST_F(StoreVerbs, AWallThatTheStoreDoesNotHaveIsFoundByTheCheckAgainstTheScene) {
  const TestFolder folder;
  // Across the way, 60 m in, and read after all of the gallery.
  folder.write("wall.obj", "v -13704.6 302.9 178\nv -13691.4 290.5 178\nv -13698 296.7 190\nf 1 2 3\n");
  const std::vector<std::string> walk{"walk",    store(), "--path",   path(), "--mode",    "fly",
                                      "--speed", "20",    "--memory", "8M",   "--against", scene()};
  const auto checked = [&](std::vector<std::string> arguments) {
    arguments.emplace_back("--json");
    return json::parse(run(arguments).out);
  };
  EXPECT_EQ(checked(walk)["violations"], 0);
  std::vector<std::string> planted = walk;
  planted.push_back(folder.file("wall.obj"));
  const json report = checked(planted);
  EXPECT_EQ(report["outcome"], "reached") << "nothing of the wall is in the store";
  EXPECT_GE(report["violations"], 1);
  EXPECT_LE(report["violations"], 10);
  EXPECT_LT(report["verified"]["least_gap_m"], -0.29);
  EXPECT_GE(report["verified"]["overstated_clearances"], report["violations"]);
}

TEST_F(StoreVerbs, ABodyThatMakesNoMoveIsNotCalledVerified) {
  const TestFolder folder;
  const std::string cut = copy(folder);
  for (const auto& pack : fs::directory_iterator(fs::path(cut) / "packs")) fs::resize_file(pack.path(), 10'000);
  const ProgramResult walked = run({"walk", cut, "--path", path(), "--mode", "fly", "--verify"});
  EXPECT_TRUE(contains(walked.out, "checked     nothing: the body made no move")) << walked.out;
}

TEST_F(StoreVerbs, WandersFromAPlaceThatIsFoundAndDrawsThat) {
  const TestFolder folder;
  const ProgramResult walked = run(
      {"walk", store(), "--wander", "5", "--height", "1.8", "--verify", "--json", "--picture", folder.file("way.svg")});
  ASSERT_EQ(walked.status, 0) << walked.err << walked.out;
  const json report = json::parse(walked.out);
  EXPECT_EQ(report["violations"], 0);
  EXPECT_GT(report["length_m"], 3.0);
  EXPECT_GT(folder.read("way.svg").size(), 5000U);
}

TEST_F(StoreVerbs, NamesWhatBlocksByObjectAndTriangleOfTheScene) {
  const TestFolder folder;
  folder.write("room.obj",
               "v 0 -2 0\nv 20 -2 0\nv 20 2 0\nv 0 2 0\nv 5 -2 0\nv 5 2 0\nv 5 -2 3\nv 5 2 3\n"
               "o floor\nf 1 2 3 4\no wall\nf 5 6 8 7\n");
  folder.write("in.path", "1 0 0.9\n10 0 0.9\n");
  ASSERT_EQ(run({"build", folder.file("room.obj"), "-o", folder.file("room.roam")}).status, 0);
  const ProgramResult walked =
      run({"walk", folder.file("room.roam"), "--path", folder.file("in.path"), "--height", "1.8", "--json"});
  EXPECT_EQ(walked.status, 3);
  const json report = json::parse(walked.out);
  EXPECT_EQ(report["outcome"], "blocked");
  EXPECT_EQ(report["blocked_at"]["object"], "wall");
  EXPECT_GE(report["blocked_at"]["triangle"], 2);
  EXPECT_LE(report["blocked_at"]["triangle"], 3);
}

TEST_F(StoreVerbs, DamageIsNamedSolidAndRepaired) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  const fs::path pack = only_pack(bad);
  flip(pack, static_cast<std::streamoff>(fs::file_size(pack) / 3));
  const ProgramResult verified = run({"verify", bad, "--json"});
  EXPECT_EQ(verified.status, 3) << verified.out;
  const json found = json::parse(verified.out);
  EXPECT_FALSE(found["whole"]);
  ASSERT_GE(found["damage"].size(), 1U);
  EXPECT_TRUE(contains(verified.out, "tile ") && contains(verified.out, " of page 0")) << verified.out;
  for (const json& damage : found["damage"]) {
    EXPECT_FALSE(contains(damage["why"], " of page ")) << damage << ": what it is, is said already";
  }
  EXPECT_TRUE(contains(run({"verify", bad}).out, "--repair"));

  const ProgramResult repaired = run({"verify", bad, "--repair", scene()});
  EXPECT_EQ(repaired.status, 0) << repaired.out << repaired.err;
  EXPECT_EQ(run({"verify", bad}).status, 0);
  EXPECT_EQ(fs::file_size(only_pack(bad)), fs::file_size(only_pack(store())));
}

TEST_F(StoreVerbs, ARepairTakesTheFoldersAndTheMemoryOfTheBuild) {
  const TestFolder folder;
  const std::string made = folder.file("s.roam"), allowed = folder.file("");
  ASSERT_EQ(run({"build", scene(), "-o", made, "--allow", allowed}).status, 0);
  flip(only_pack(made), 1000);
  const ProgramResult refused = run({"verify", made, "--repair", scene()});
  EXPECT_EQ(refused.status, 1) << refused.out;
  EXPECT_TRUE(contains(refused.err, "--allow")) << refused.err;
  const ProgramResult little = run({"verify", made, "--repair", scene(), "--allow", allowed, "--memory", "255M"});
  EXPECT_EQ(little.status, 2) << little.out;
  EXPECT_TRUE(contains(little.err, "--memory 255 MiB") && contains(little.err, "256 MiB")) << little.err;
  const ProgramResult repaired = run({"verify", made, "--repair", scene(), "--allow", allowed, "--memory", "2G"});
  EXPECT_EQ(repaired.status, 0) << repaired.err;
  EXPECT_EQ(run({"verify", made}).status, 0);
  EXPECT_EQ(run({"verify", made, "--allow", allowed}).status, 2);
  EXPECT_EQ(run({"verify", made, "--memory", "2G"}).status, 2);
}

TEST_F(StoreVerbs, EveryTileDamagedHoldsABodyAndLetsNothingThrough) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  const fs::path pack = only_pack(bad);
  // The tiles are before the pages.
  auto end = static_cast<std::uint64_t>(fs::file_size(pack));
  const auto opened = roam::Store::open(bad);
  for (const auto& page : opened->state().pages) end = std::min(end, page.ref.offset);
  for (std::uint64_t at = 64; at < end; at += 64) flip(pack, static_cast<std::streamoff>(at));
  int tiles = 0;
  const json verified = json::parse(run({"verify", bad, "--json"}).out);
  for (const json& damage : verified["damage"]) {
    tiles += contains(damage["what"], "tile ") ? 1 : 0;
  }
  EXPECT_EQ(tiles, json::parse(run({"info", bad, "--json"}).out)["tiles"]);
  const ProgramResult walked =
      run({"walk", bad, "--path", path(), "--mode", "fly", "--speed", "20", "--against", scene(), "--json"});
  const json report = json::parse(walked.out);
  EXPECT_EQ(report["violations"], 0) << walked.out;
  EXPECT_EQ(walked.status, 3);
  EXPECT_EQ(report["outcome"], "held") << "by what cannot be read, not by a wall";
  EXPECT_TRUE(contains(report["why"], "read")) << report["why"];
  EXPECT_GT(report["paging"]["failed"], 0);
  EXPECT_TRUE(contains(report["paging"]["last_failure"], "tile")) << report["paging"];
}

TEST_F(StoreVerbs, OptionsThatMeanNothingForAStoreOrASceneAreRefused) {
  EXPECT_EQ(run({"walk", store(), "--up", "y", "--path", path()}).status, 2);
  EXPECT_EQ(run({"walk", store(), "--lossless", "--path", path()}).status, 2);
  EXPECT_EQ(run({"info", store(), scene()}).status, 2);
  EXPECT_EQ(run({"sweep", store(), scene()}).status, 2);
  const ProgramResult reading = run({"walk", scene(), "--memory", "1M", "--path", path()});
  EXPECT_EQ(reading.status, 2);
  EXPECT_TRUE(contains(reading.err, "--memory 1 MiB: reading a scene needs at least 64 MiB")) << reading.err;
  EXPECT_EQ(run({"walk", store(), "--memory", "lots", "--path", path()}).status, 2);
  const ProgramResult little = run({"walk", store(), "--memory", "1M", "--path", path()});
  EXPECT_EQ(little.status, 2);
  EXPECT_TRUE(contains(little.err, "--memory") && contains(little.err, "8 MiB")) << little.err;
  if (!roam::test::has_sanitizer) {  // which ends a process that asks for so much
    const ProgramResult much = run({"walk", store(), "--memory", "4000000G", "--path", path()});
    EXPECT_EQ(much.status, 1);
    EXPECT_TRUE(contains(much.err, "--memory")) << much.err;
  }
  const ProgramResult itself = run({"walk", store(), "--path", path(), "--against", store()});
  EXPECT_EQ(itself.status, 2);
  EXPECT_TRUE(contains(itself.err, "--verify")) << itself.err;
}

TEST_F(StoreVerbs, AWalkCheckedAgainstAnotherSceneSaysSo) {
  const TestFolder folder;
  const std::string other = folder.write("far.obj", "v 9e3 0 0\nv 9e3 1 0\nv 9e3 0 1\nf 1 2 3\n");
  const ProgramResult walked =
      run({"walk", store(), "--path", path(), "--mode", "fly", "--speed", "20", "--against", other});
  EXPECT_TRUE(contains(walked.err, "far.obj: 1; of the store: ")) << walked.err;
  EXPECT_TRUE(contains(walked.out, "no triangle came near any of them")) << walked.out;
  const ProgramResult right =
      run({"walk", store(), "--path", path(), "--mode", "fly", "--speed", "20", "--against", scene()});
  EXPECT_FALSE(contains(right.err, "of the store")) << right.err;
  EXPECT_FALSE(contains(right.out, "no triangle came near")) << right.out;
}

TEST_F(StoreVerbs, AWalkIsCheckedAgainstTheSceneAsTheStoreWasReadOfIt) {
  const TestFolder folder;
  const std::string small = folder.file("small.roam");
  ASSERT_EQ(run({"build", scene(), "-o", small, "--unit", "cm"}).status, 0);
  const std::string way = folder.write("small.path", "-137.39 2.53 1.82\n-136.39 3.593 1.82\n");
  const std::vector<std::string> walk{"walk", small,      "--path", way,        "--mode",    "fly",  "--speed",
                                      "0.2",  "--radius", "0.004",  "--sphere", "--against", scene()};
  const ProgramResult walked = run(walk);
  EXPECT_FALSE(contains(walked.out, "no triangle came near")) << walked.out;
  EXPECT_TRUE(contains(walked.out, "0 violations")) << walked.out;
  std::vector<std::string> otherwise = walk;
  otherwise.insert(otherwise.end(), {"--unit", "mm"});
  EXPECT_TRUE(contains(run(otherwise).out, "no triangle came near")) << "what is said counts";
  std::vector<std::string> besides = walk;
  besides.insert(besides.end(), {"--ignore", "nothing is called so"});
  EXPECT_FALSE(contains(run(besides).out, "no triangle came near")) << "and what is not is the store's";
}

TEST_F(StoreVerbs, AFlightFarFromAllTilesIsInTheSceneAllTheSame) {
  const TestFolder folder;
  folder.write("floor.obj", "v 0 -2 0\nv 20 -2 0\nv 20 2 0\nv 0 2 0\nf 1 2 3 4\n");
  const std::string stored = folder.file("floor.roam"), above = folder.write("above.path", "9 0 9\n10 0 9\n");
  const std::string far = folder.write("far.path", "9 0 19\n10 0 19\n");
  ASSERT_EQ(run({"build", folder.file("floor.obj"), "-o", stored}).status, 0);
  const ProgramResult flown = run({"walk", stored, "--path", above, "--mode", "fly", "--verify"});
  EXPECT_TRUE(contains(flown.out, "nothing had to be measured")) << flown.out << flown.err;
  EXPECT_FALSE(contains(flown.out, "--up")) << flown.out;
  EXPECT_TRUE(contains(run({"walk", stored, "--path", far, "--mode", "fly", "--verify"}).out, "--up"));
}

TEST_F(StoreVerbs, WhatIsNotThereOrNotCompleteIsSaidSo) {
  const TestFolder folder;
  const std::string missing = folder.file("nothing.ply");
  const ProgramResult built = run({"build", missing});
  EXPECT_EQ(built.status, 1);
  EXPECT_TRUE(contains(built.err, missing)) << built.err;
  EXPECT_FALSE(fs::exists(missing + ".roam")) << "nothing is left of a build that could not begin";
  const ProgramResult walked =
      run({"walk", store(), "--path", path(), "--against", missing, "--trace", folder.file("t")});
  EXPECT_EQ(walked.status, 1);
  EXPECT_FALSE(fs::exists(folder.file("t"))) << "that is said before the walk, not after it";

  const std::string begun = folder.file("begun.roam");
  ASSERT_EQ(run({"build", scene(), "-o", begun, "--plan"}).status, 0);
  for (const char* verb : {"info", "sweep", "build"}) {
    const ProgramResult told = run({verb, begun});
    EXPECT_EQ(told.status, 1) << verb;
    EXPECT_TRUE(contains(told.err, "not complete")) << told.err;
  }
  const ProgramResult twice = run({"build", store()});
  EXPECT_EQ(twice.status, 2);
  EXPECT_TRUE(contains(twice.err, "this is a store; name the scene that it was made of")) << twice.err;
}

TEST_F(StoreVerbs, ANewerFormatAsksForANewerRoam) {
  const TestFolder folder;
  const std::string newer = copy(folder);
  std::string current = folder.read("copy.roam/CURRENT");
  current.replace(current.find(" 1\n"), 3, " 9\n");
  folder.write("copy.roam/CURRENT", current);
  for (const char* verb : {"info", "verify", "sweep"}) {
    const ProgramResult told = run({verb, newer});
    EXPECT_EQ(told.status, 1);
    EXPECT_TRUE(contains(told.err, "newer roam")) << told.err;
  }
}

TEST_F(StoreVerbs, ASecondBuildOfTheSameSceneDoesNothing) {
  const ProgramResult again = run({"build", scene(), "--json"});
  ASSERT_EQ(again.status, 0) << again.err;
  const json report = json::parse(again.out);
  EXPECT_TRUE(report["unchanged"]);
  EXPECT_EQ(report["shards_built"], 0);
}

}  // namespace
