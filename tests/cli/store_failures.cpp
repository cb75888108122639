// What roam build and its kin say, and leave behind, where something cannot be.
#include <nlohmann/json.hpp>
#include <sstream>
#include <utility>

#include "store/tile_reader.h"
#include "store_verbs.h"

namespace {

using namespace store_verbs;

class StoreFailures : public StoreVerbs {};

TEST_F(StoreFailures, ReadingOptionsOfAShardOrAMergeAreWrongUsage) {
  const TestFolder folder;
  const std::string planned = folder.file("planned.roam");
  ASSERT_EQ(run({"build", scene(), "-o", planned, "--plan"}).status, 0);
  for (const std::vector<std::string>& step : {std::vector<std::string>{"--shard", "0"}, {"--merge"}}) {
    for (const std::vector<std::string>& reading : {std::vector<std::string>{"--up", "y"},
                                                    {"--unit", "m"},
                                                    {"--ignore", "Door*"},
                                                    {"--allow", folder.file("")},
                                                    {"--lossless"}}) {
      std::vector<std::string> arguments{"build", "-o", planned};
      arguments.insert(arguments.end(), step.begin(), step.end());
      arguments.insert(arguments.end(), reading.begin(), reading.end());
      const ProgramResult told = run(arguments);
      EXPECT_EQ(told.status, 2) << reading[0] << step[0];
      EXPECT_TRUE(contains(told.err, reading[0]) && contains(told.err, "--plan")) << told.err;
    }
  }
  for (const std::vector<std::string>& step : {std::vector<std::string>{scene(), "--plan"}, {"--merge"}}) {
    std::vector<std::string> arguments{"build", "-o", planned};
    arguments.insert(arguments.end(), step.begin(), step.end());
    arguments.emplace_back("--near=1,2,3");
    const ProgramResult told = run(arguments);
    EXPECT_EQ(told.status, 2) << step.back();
    EXPECT_TRUE(contains(told.err, "--near with " + step.back())) << told.err;
  }
  const ProgramResult share = run({"build", scene(), "-o", planned, "--plan", "4", "--shard", "0", "--near=1,2,3"});
  EXPECT_EQ(share.status, 2);
  EXPECT_TRUE(contains(share.err, "a share only reads")) << share.err;
  EXPECT_EQ(run({"build", "-o", planned, "--shard", "0", "--near=1,2,3", "--memory", "256M"}).status, 0);
  EXPECT_EQ(run({"build", "-o", planned, "--merge"}).status, 0);
}

TEST_F(StoreFailures, AReadThatFailsLeavesNothing) {
  const TestFolder folder;
  const std::string broken = folder.write("broken.ply", "ply\nformat ascii 1.0\nelement vertex 3\n");
  const std::string empty = folder.write("empty.obj", "v 0 0 0\n");
  const std::string long_broken = folder.file("long.ply");  // breaks after runs have been written
  fs::copy(scene(), long_broken);
  fs::resize_file(long_broken, fs::file_size(long_broken) - 5);
  for (const std::string& bad : {broken, empty, long_broken}) {
    EXPECT_EQ(run({"build", bad}).status, 1);
    EXPECT_FALSE(fs::exists(bad + ".roam")) << bad;
    EXPECT_EQ(run({"build", bad, "-o", folder.file("some/where/new.roam"), "--plan"}).status, 1);
    EXPECT_FALSE(fs::exists(folder.file("some"))) << bad;
    fs::create_directory(folder.file("there"));
    EXPECT_EQ(run({"build", bad, "-o", folder.file("there")}).status, 1);
    EXPECT_TRUE(fs::is_empty(folder.file("there"))) << bad;
  }
}

TEST_F(StoreFailures, AReadThatFailsLeavesTheStoreThatWasAndOtherThings) {
  const TestFolder folder;
  const std::string kept = copy(folder);
  const std::string broken = folder.write("broken.ply", "ply\n");
  EXPECT_EQ(run({"build", broken, "-o", kept}).status, 1);
  EXPECT_EQ(run({"verify", kept}).status, 0);
  fs::create_directory(folder.file("new"));
  folder.write("new/holiday.jpg", "");
  EXPECT_EQ(run({"build", broken, "-o", folder.file("new/s.roam")}).status, 1);
  EXPECT_TRUE(fs::exists(folder.file("new/holiday.jpg")));
  EXPECT_FALSE(fs::exists(folder.file("new/s.roam")));
}

TEST_F(StoreFailures, LinksThatLeadNowhereAreCalledSo) {
  const TestFolder folder;
  fs::create_symlink("nothing", folder.file("dangling"));
  fs::create_symlink("loop", folder.file("loop"));
  for (const char* name : {"dangling", "loop"}) {
    const std::string link = folder.file(name);
    for (const std::vector<std::string>& verb : {std::vector<std::string>{"info", link},
                                                 {"verify", link},
                                                 {"verify", link, "--repair", scene()},
                                                 {"build", link},
                                                 {"build", scene(), "-o", link},
                                                 {"build", scene(), "-o", link + "/s.roam"},
                                                 {"build", "-o", link, "--merge"},
                                                 {"build", "-o", link, "--shard", "0"}}) {
      const ProgramResult told = run(verb);
      EXPECT_EQ(told.status, 1) << verb[0] << ' ' << verb[1];
      EXPECT_TRUE(contains(told.err, link)) << told.err;
      EXPECT_FALSE(contains(told.err, "filesystem error")) << told.err;
    }
    EXPECT_TRUE(fs::is_symlink(link)) << "and stay";
  }
  EXPECT_TRUE(contains(run({"info", folder.file("dangling")}).err, "is a link to nothing, which is not there"));
  EXPECT_TRUE(contains(run({"build", scene(), "-o", folder.file("dangling")}).err, "link that leads nowhere"));
}

TEST_F(StoreFailures, ALinkBesideASceneIsNoPlaceForItsStoreUnlessItIsNamed) {
  const TestFolder folder;
  const std::string copy = folder.file(fs::path(scene()).filename()), mine = folder.file("mine.roam"),
                    beside = copy + ".roam";
  fs::copy_file(scene(), copy);
  fs::create_directory(mine);
  fs::create_symlink(mine, beside);
  for (const char* step : {"--json", "--plan"}) {
    const ProgramResult told = run({"build", copy, step});
    EXPECT_EQ(told.status, 1);
    EXPECT_TRUE(contains(told.err, beside + " is a link")) << told.err;
    EXPECT_TRUE(fs::is_empty(mine));
  }
  EXPECT_EQ(run({"build", copy, "-o", beside}).status, 0);
  EXPECT_TRUE(roam::Store::is_store(mine));
}

TEST_F(StoreFailures, WhatCannotBeReadIsNoMatterOfTheRightToWrite) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  const fs::path pack = only_pack(bad);
  fs::remove(pack);
  fs::create_symlink(pack.filename(), pack);
  const ProgramResult told = run({"verify", bad});
  EXPECT_EQ(told.status, 3);
  EXPECT_TRUE(contains(told.out, "cannot read " + pack.string())) << told.out;
  EXPECT_FALSE(contains(told.out, "write")) << told.out;
}

TEST_F(StoreFailures, ABuildThatHasNotEndedIsNotWholeAndIsTold) {
  const TestFolder folder;
  const std::string begun = folder.file("begun.roam");
  ASSERT_EQ(run({"build", scene(), "-o", begun, "--plan"}).status, 0);
  const ProgramResult told = run({"verify", begun});
  EXPECT_EQ(told.status, 3);
  EXPECT_TRUE(contains(told.out, "not complete") && contains(told.out, "roam build")) << told.out;
  EXPECT_FALSE(contains(told.out, "--repair")) << told.out;
  const ProgramResult json = run({"verify", begun, "--json"});
  EXPECT_EQ(json.status, 3);
  const auto found = nlohmann::json::parse(json.out);
  EXPECT_FALSE(found["whole"]);
  EXPECT_FALSE(found["complete"]);
  EXPECT_TRUE(found["damage"].empty());
  const ProgramResult repaired = run({"verify", begun, "--repair", scene()});
  EXPECT_EQ(repaired.status, 1) << "a repair cannot end a build";
  EXPECT_TRUE(contains(repaired.err, "roam build")) << repaired.err;
  ASSERT_EQ(run({"build", scene(), "-o", begun}).status, 0);
  EXPECT_TRUE(nlohmann::json::parse(run({"verify", begun, "--json"}).out)["complete"]);
}

TEST_F(StoreFailures, ABuildThatWasKilledJustBeforeItsEndIsNotDamaged) {
  const TestFolder folder;
  const std::string begun = folder.file("begun.roam");
  ASSERT_EQ(run({"build", scene(), "-o", begun, "--plan"}).status, 0);
  fs::copy(store() + "/manifests", begun + "/manifests", fs::copy_options::recursive);
  const ProgramResult told = run({"verify", begun});
  EXPECT_EQ(told.status, 3);
  EXPECT_TRUE(contains(told.out, "not complete") && !contains(told.out, "damaged")) << told.out;
  const ProgramResult built = run({"build", scene(), "-o", begun});
  EXPECT_EQ(built.status, 0) << built.err;
  EXPECT_EQ(run({"verify", begun}).status, 0);
}

TEST_F(StoreFailures, ARepairTellsTheNotesOfItsReading) {
  const TestFolder folder;
  const std::string odd = folder.write("odd.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv nan 0 0\nf 1 2 3\nf 1 2 4\n");
  const std::string made = odd + ".roam";
  const ProgramResult built = run({"build", odd});
  ASSERT_EQ(built.status, 0) << built.err;
  const std::size_t begin = built.err.find("roam: note: ");
  ASSERT_NE(begin, std::string::npos) << built.err;
  const std::string note = built.err.substr(begin, built.err.find('\n', begin) - begin);
  // What a store says may be a stranger's words.
  const std::string quoted = "roam: note: of the build of " + made + ": \"" + note.substr(12) + "\"";
  const ProgramResult again = run({"build", odd});
  EXPECT_TRUE(contains(again.err, quoted)) << again.err;
  flip(only_pack(made), 100);
  const ProgramResult repaired = run({"verify", made, "--repair", odd});
  EXPECT_EQ(repaired.status, 0) << repaired.err;
  EXPECT_TRUE(contains(repaired.err, quoted) || contains(repaired.err, note)) << repaired.err;
}

/// The fields of each row after the header.
std::vector<std::vector<std::string>> rows_of(const std::string& text) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(text);
  std::string row;
  std::getline(in, row);
  while (std::getline(in, row)) {
    rows.emplace_back();
    std::istringstream fields(row);
    for (std::string field; std::getline(fields, field, ',');) rows.back().push_back(field);
  }
  return rows;
}

/// Sweeps from the middle of the corridor into its walls, along its first 60 m.
std::string queries_into_walls() {
  std::string queries;
  for (int i = 0; i < 60; ++i) {
    queries += std::to_string(-13739.0 + i) + ',' + std::to_string(253.0 + 1.063 * i) + ",182," +
               std::to_string(i % 2 == 0 ? 6.0 : -6.0) + ',' + std::to_string(i % 2 == 0 ? -6.0 : 6.0) + ",0,0.2\n";
  }
  return queries;
}

TEST_F(StoreFailures, SweepsEndAtWhatCannotBeReadAndGoOn) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  const fs::path pack = only_pack(bad);
  // Each third block of the tiles; the pages lie at the end.
  for (std::uintmax_t at = 64; at < fs::file_size(pack) * 3 / 4; at += 30'000) flip(pack, std::streamoff(at));
  const std::string queries = queries_into_walls();
  const auto whole = rows_of(run({"sweep", store()}, queries).out);
  const ProgramResult told = run({"sweep", bad}, queries);
  EXPECT_EQ(told.status, 3) << told.err;
  const auto rows = rows_of(told.out);
  ASSERT_EQ(rows.size(), whole.size()) << "each row is answered";
  int unknown = 0, known = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), 11U);
    if (rows[i][9] != "unknown") {
      ++known;
      EXPECT_EQ(rows[i][0], whole[i][0]);
      EXPECT_NEAR(std::stod(rows[i][1]), std::stod(whole[i][1]), 1e-6);
      continue;
    }
    ++unknown;
    EXPECT_EQ(rows[i][0], "1") << "solid";
    EXPECT_EQ(rows[i][8], "-1");
    EXPECT_LE(std::stod(rows[i][1]), std::stod(whole[i][1])) << "never through";
  }
  EXPECT_GT(unknown, 0) << told.err;
  EXPECT_GT(known, 0) << told.err;
  EXPECT_TRUE(contains(told.err, "note: line ") && contains(told.err, "tile ") && contains(told.err, "of page 0"))
      << told.err;
  EXPECT_TRUE(contains(told.err, std::to_string(unknown) + " of ") && contains(told.err, "roam verify")) << told.err;
}

TEST_F(StoreFailures, SweepsNeedNoNamesOfObjects) {
  const TestFolder folder;
  const std::string bad = copy(folder), queries = queries_into_walls();
  fs::remove_all(bad + "/parts");
  const ProgramResult told = run({"sweep", bad}, queries);
  EXPECT_EQ(told.status, 0) << told.err;
  EXPECT_EQ(told.out, run({"sweep", store()}, queries).out);
}

TEST_F(StoreFailures, SweepsAreAnsweredWhereTheNumbersOfTrianglesCannotBeRead) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  const auto opened = roam::Store::open(bad);
  roam::store::TileReader reader(opened->state());
  for (std::uint64_t p = 0; p < opened->info().pages; ++p) {
    for (const auto& entry : reader.page(p).view.tiles) {
      flip(only_pack(bad), static_cast<std::streamoff>(entry.offset + entry.bytes));
    }
  }
  const std::string queries = queries_into_walls();
  const auto whole = rows_of(run({"sweep", store()}, queries).out);
  const ProgramResult told = run({"sweep", bad}, queries);
  EXPECT_EQ(told.status, 3) << told.err;
  auto rows = rows_of(told.out);
  ASSERT_EQ(rows.size(), whole.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i][0] == "1") {
      EXPECT_EQ(std::exchange(rows[i][8], whole[i][8]), "-1");
    }
    EXPECT_EQ(rows[i], whole[i]);
  }
  EXPECT_TRUE(contains(told.err, "the source numbers of tile")) << told.err;
}

TEST_F(StoreVerbs, WhatCannotBeVerifiedIsNamedBehindTheReportOfAWalkThatEnded) {
  const TestFolder folder;
  const std::string bad = copy(folder), start = folder.write("start.path", "-13739 253 182\n-13736 256.2 182\n");
  const std::vector<std::string> walk{"walk", bad, "--path", start, "--mode", "fly", "--speed", "20"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), walk.begin(), walk.end());
    return run(more);
  };
  // A tile beside the way, which is not met by the body but lies in the box of what is looked through.
  const fs::path pack = only_pack(bad);
  std::streamoff at = 0;
  ProgramResult checked;
  do {
    flip(pack, at);
    checked = with({"--verify", "--json", "--trace", folder.file("way.csv"), "--picture", folder.file("way.svg")});
    if (checked.status == 1) break;
    flip(pack, at);
    at += 256;
  } while (at < static_cast<std::streamoff>(fs::file_size(pack)));
  ASSERT_EQ(checked.status, 1) << "nothing was damaged that lies along the way";
  const auto report = nlohmann::json::parse(checked.out);
  EXPECT_TRUE(report["violations"].is_null()) << report << ": that is not known";
  ASSERT_EQ(report["verified"]["unread"].size(), 1U) << report;
  const std::string unread = report["verified"]["unread"][0];
  EXPECT_TRUE(contains(unread, "tile ")) << unread;
  EXPECT_GT(folder.read("way.svg").size(), 5000U);
  EXPECT_GT(folder.read("way.csv").size(), 100U);
  EXPECT_TRUE(contains(checked.err, unread) && contains(checked.err, "--against SCENE")) << checked.err;
  EXPECT_TRUE(contains(checked.err, "roam verify " + bad + " --repair SCENE")) << checked.err;
  const ProgramResult told = with({"--verify"});
  EXPECT_EQ(told.status, 1);
  EXPECT_FALSE(contains(told.out, "0 violations")) << told.out << ": that is not known";
  // What is advised is a way out.
  const int went = with({}).status;
  EXPECT_EQ(with({"--against", scene()}).status, went);
  const ProgramResult mended = run({"verify", bad, "--repair", scene()});
  ASSERT_EQ(mended.status, 0) << mended.err;
  EXPECT_TRUE(contains(mended.out, " damaged\n")) << mended.out;
  EXPECT_TRUE(contains(mended.out, ": whole; ")) << mended.out;
  EXPECT_FALSE(contains(mended.out, "--repair")) << "what is done needs no advice: " << mended.out;
  EXPECT_EQ(with({"--verify"}).status, 0);
}

TEST_F(StoreVerbs, ASurveyOfADamagedStoreSaysWhatToDo) {
  const TestFolder folder;
  const std::string bad = copy(folder);
  flip(only_pack(bad), static_cast<std::streamoff>(fs::file_size(only_pack(bad)) / 3));
  const ProgramResult told =
      run({"probe", bad, "--from", "-13739,253,182", "--to", "-13736,256.2,182", "--sphere", "--mode", "fly"});
  EXPECT_EQ(told.status, 1);
  EXPECT_TRUE(contains(told.err, "tile ") && contains(told.err, "the scene itself")) << told.err;
  EXPECT_TRUE(contains(told.err, "roam verify " + bad + " --repair SCENE")) << told.err;
}

}  // namespace
