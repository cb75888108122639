// What roam build and its kin say, and leave behind, where something cannot be.
#include "store_verbs.h"

namespace {

using namespace store_verbs;

class StoreFailures : public StoreVerbs {};

TEST_F(StoreFailures, ReadingOptionsOfAShardOrAMergeAreWrongUsage) {
  const TestFolder folder;
  const std::string planned = folder.file("planned.roam");
  ASSERT_EQ(run({"build", scene(), "-o", planned, "--plan"}).status, 0);
  for (const std::vector<std::string>& step : {std::vector<std::string>{"--shard", "0"}, {"--merge"}}) {
    for (const std::vector<std::string>& reading :
         {std::vector<std::string>{"--up", "y"}, {"--unit", "m"}, {"--ignore", "Door*"}, {"--lossless"}}) {
      std::vector<std::string> arguments{"build", "-o", planned};
      arguments.insert(arguments.end(), step.begin(), step.end());
      arguments.insert(arguments.end(), reading.begin(), reading.end());
      const ProgramResult told = run(arguments);
      EXPECT_EQ(told.status, 2) << reading[0] << step[0];
      EXPECT_TRUE(contains(told.err, reading[0]) && contains(told.err, "--plan")) << told.err;
    }
  }
  EXPECT_EQ(run({"build", "-o", planned, "--shard", "0", "--threads", "1", "--memory", "256M"}).status, 0);
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

}  // namespace
