// The verb `roam build`, as a user runs it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "store_builds.h"

namespace {

using namespace store_builds;
using Json = nlohmann::json;

ProgramResult roam(const std::vector<std::string>& arguments, const ProgramOptions& options = {}) {
  return run_program(ROAM_PROGRAM, arguments, options);
}

TEST(StoreBuildProgram, BuildsBesideTheSceneAndSaysWhatItDid) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto first = roam({"build", scene, "--json"});
  ASSERT_EQ(first.status, 0) << first.err;
  const Json json = Json::parse(first.out);
  EXPECT_EQ(json["store"], scene + ".roam");
  EXPECT_EQ(json["triangles"], 7200);
  EXPECT_EQ(json["shards_built"], 1);
  EXPECT_EQ(json["unchanged"], false);
  EXPECT_EQ(json["hash"], roam::Store::open(scene + ".roam")->info().hash);
  const auto second = roam({"build", scene});
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_NE(second.out.find("up to date"), std::string::npos) << second.out;
}

TEST(StoreBuildProgram, SaysItsProgressInJsonLines) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto build = roam({"build", scene, "--json-lines", "--near=-5,1e3,2"});
  ASSERT_EQ(build.status, 0) << build.err;
  std::istringstream lines(build.out);
  std::vector<Json> objects;
  for (std::string line; std::getline(lines, line);) objects.push_back(Json::parse(line));
  ASSERT_GT(objects.size(), 3u);
  EXPECT_EQ(objects.front()["step"], "read");
  EXPECT_EQ(objects[objects.size() - 2]["step"], "merge");
  for (const Json& object : std::span(objects).first(objects.size() - 1)) {
    EXPECT_LE(object["bytes_done"].get<std::uint64_t>(), std::filesystem::file_size(scene));
    EXPECT_LE(object["triangles_done"].get<std::uint64_t>(), 7200u);
  }
  EXPECT_EQ(objects.back()["hash"], roam::Store::open(scene + ".roam")->info().hash);
  EXPECT_EQ(build.err, "") << "progress for people, too";
  EXPECT_EQ(roam({"build", scene, "--near", "1,2"}).status, 2);
  EXPECT_EQ(roam({"build", scene, "--near", "1,nan,2"}).status, 2);
}

TEST(StoreBuildProgram, BuildsInSteps) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto plan = roam({"build", scene, "-o", folder.file("s"), "--plan", "--json"});
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_EQ(Json::parse(plan.out)["shards_to_build"], 1);
  const auto early = roam({"build", "-o", folder.file("s"), "--merge"});
  EXPECT_EQ(early.status, 1);
  EXPECT_NE(early.err.find("shard 0 is missing"), std::string::npos) << early.err;
  const auto shard = roam({"build", "-o", folder.file("s"), "--shard", "0"});
  EXPECT_EQ(shard.status, 0);
  EXPECT_NE(shard.out.find("shard 0"), std::string::npos) << shard.out;
  const auto merge = roam({"build", "-o", folder.file("s"), "--merge"});
  EXPECT_EQ(merge.status, 0) << merge.err;
  EXPECT_NE(merge.out.find("7200 triangles"), std::string::npos) << merge.out;
  expect_whole(folder.file("s"));
}

TEST(StoreBuildProgram, SaysWhichShardsThereAre) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const std::string store = folder.file("s");
  const auto one = roam({"build", scene, "-o", store, "--plan"});
  EXPECT_EQ(one.out.rfind("1 shard to build: --shard 0, on", 0), 0U) << one.out;
  EXPECT_EQ(roam({"build", "-o", store, "--shard", "-1"}).status, 2);
  EXPECT_EQ(roam({"build", "-o", store, "--shard", "0"}).status, 0);
  EXPECT_EQ(roam({"build", "-o", store, "--merge"}).status, 0);
  // The part is made again, its shard is there: nothing but a merge is left to do.
  std::filesystem::remove_all(store + "/parts");
  const auto none = roam({"build", scene, "-o", store, "--plan"});
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_EQ(none.out.find("--shard 0"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("--merge"), std::string::npos) << none.out;
  EXPECT_EQ(roam({"build", "-o", store, "--merge"}).status, 0);
}

TEST(StoreBuildProgram, IsStoppedByCtrlCAndGoesOn) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(900, 0.5, {0.0, 0.0, 0.0}));
  const auto stopped = roam({"build", scene, "-o", folder.file("s")}, {.interrupt_after = 0.3});
  EXPECT_EQ(stopped.status, 130);
  EXPECT_NE(stopped.err.find("the same command again goes on"), std::string::npos) << stopped.err;
  EXPECT_FALSE(roam::Store::is_store(folder.file("s")));
  const auto rest = roam({"build", scene, "-o", folder.file("s")});
  EXPECT_EQ(rest.status, 0) << rest.err;
  expect_whole(folder.file("s"));
}

TEST(StoreBuildProgram, RefusesWrongUsage) {
  const TestFolder folder;
  EXPECT_EQ(roam({"build"}).status, 2);
  EXPECT_EQ(roam({"build", "a.ply", "--plan", "--merge"}).status, 2);
  EXPECT_EQ(roam({"build", "--merge"}).status, 2);
  const std::string scene = write_ply(folder.file("a.ply"), field(4, 0.5, {0.0, 0.0, 0.0}));
  const auto small = roam({"build", scene, "--memory", "10M"});
  EXPECT_EQ(small.status, 2);
  EXPECT_NE(small.err.find("--memory 10 MiB: a build needs at least 256 MiB"), std::string::npos) << small.err;
}

}  // namespace
