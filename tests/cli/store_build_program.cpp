// The verb `roam build`, as a user runs it.

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <span>
#include <sstream>

#include "environment_variable.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using Json = nlohmann::json;

TEST(StoreBuildProgram, BuildsBesideTheSceneAndSaysWhatItDid) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto first = run_roam({"build", scene, "--json"});
  ASSERT_EQ(first.status, 0) << first.err;
  const Json json = Json::parse(first.out);
  EXPECT_EQ(json["store"], scene + ".roam");
  EXPECT_EQ(json["triangles"], 7200);
  EXPECT_EQ(json["shards_built"], 1);
  EXPECT_EQ(json["unchanged"], false);
  EXPECT_EQ(json["hash"], roam::Store::open(scene + ".roam")->info().hash);
  const auto second = run_roam({"build", scene});
  EXPECT_EQ(second.status, 0) << second.err;
  EXPECT_NE(second.out.find("up to date"), std::string::npos) << second.out;
}

TEST(StoreBuildProgram, SaysItsProgressInJsonLines) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto build = run_roam({"build", scene, "--json-lines", "--near=-5,1e3,2"});
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
  EXPECT_EQ(run_roam({"build", scene, "--near", "1,2"}).status, 2);
  EXPECT_EQ(run_roam({"build", scene, "--near", "1,nan,2"}).status, 2);
}

TEST(StoreBuildProgram, BuildsInSteps) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto plan = run_roam({"build", scene, "-o", folder.file("s"), "--plan", "--json"});
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_EQ(Json::parse(plan.out)["shards_to_build"], 1);
  const auto early = run_roam({"build", "-o", folder.file("s"), "--merge"});
  EXPECT_EQ(early.status, 1);
  EXPECT_NE(early.err.find("missing shards: 1, damaged shards: 0, in tasks 0 of 1;"), std::string::npos) << early.err;
  const auto shard = run_roam({"build", "-o", folder.file("s"), "--shard", "0"});
  EXPECT_EQ(shard.status, 0);
  EXPECT_EQ(shard.out.rfind("task 0 of 1: shards built: 1, there already: 0, in ", 0), 0U) << shard.out;
  const auto merge = run_roam({"build", "-o", folder.file("s"), "--merge"});
  EXPECT_EQ(merge.status, 0) << merge.err;
  EXPECT_NE(merge.out.find("7200 triangles"), std::string::npos) << merge.out;
  expect_whole(folder.file("s"));
}

TEST(StoreBuildProgram, ReadsSharesOfTheSceneBeforeThePlan) {
  const TestFolder folder;
  std::vector<std::string> scene;
  for (const char* name : {"a.ply", "b.ply", "c.ply"}) {
    scene.push_back(write_ply(folder.file(name), field(20, 0.5, {20.0 * double(scene.size()), 0.0, 0.0})));
  }
  const auto build = [&](std::vector<std::string> more) {
    std::vector<std::string> arguments{"build"};
    arguments.insert(arguments.end(), scene.begin(), scene.end());
    more.insert(more.end(), {"-o", folder.file("s"), "--unit", "ft"});
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_roam(arguments);
  };
  {
    const EnvironmentVariable job("PBS_ARRAY_INDEX", "1");
    const auto read = build({"--plan", "2", "--shard", "auto"});
    EXPECT_EQ(read.out.rfind("share 1 of 2 (PBS, PBS_ARRAY_INDEX=1): parts read: 1, known already: 0, in ", 0), 0U)
        << read.out << read.err;
    const EnvironmentVariable beyond("PBS_ARRAY_INDEX", "2");
    const auto none = build({"--plan", "2", "--shard", "auto"});
    EXPECT_EQ(none.status, 0) << none.err;
    EXPECT_NE(none.out.find("there is no share 2 of 2: they are counted from 0 (PBS"), std::string::npos) << none.out;
  }
  const auto json = build({"--plan", "2", "--shard", "0", "--json"});
  ASSERT_EQ(json.status, 0) << json.err;
  EXPECT_EQ(Json::parse(json.out)["share"], 0);
  EXPECT_EQ(Json::parse(json.out)["share_parts"], 2);
  EXPECT_EQ(Json::parse(json.out)["parts_read"], 2);
  const auto plan = build({"--plan", "2", "--json"});
  ASSERT_EQ(plan.status, 0) << plan.err;
  EXPECT_EQ(Json::parse(plan.out)["parts_read"], 0);
  EXPECT_EQ(build({"--plan", "2", "--shard", "2"}).status, 0) << "nothing to do";
  EXPECT_EQ(build({"--plan", "--shard", "0"}).status, 2) << "of how many?";
  EXPECT_EQ(run_roam({"build", "-o", folder.file("s"), "--plan", "2", "--shard", "0"}).status, 2) << "of which scene?";
}

TEST(StoreBuildProgram, SaysWhichShardsThereAre) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const std::string store = folder.file("s");
  const auto one = run_roam({"build", scene, "-o", store, "--plan"});
  EXPECT_EQ(one.out.rfind("1 task: --shard 0, on", 0), 0U) << one.out;
  EXPECT_EQ(run_roam({"build", "-o", store, "--shard", "-1"}).status, 2);
  EXPECT_EQ(run_roam({"build", "-o", store, "--shard", "0"}).status, 0);
  EXPECT_EQ(run_roam({"build", "-o", store, "--merge"}).status, 0);
  // The part is made again, its shard is there: nothing but a merge is left to do.
  std::filesystem::remove_all(store + "/parts");
  const auto none = run_roam({"build", scene, "-o", store, "--plan"});
  EXPECT_EQ(none.status, 0) << none.err;
  EXPECT_EQ(none.out.find("--shard 0"), std::string::npos) << none.out;
  EXPECT_NE(none.out.find("--merge"), std::string::npos) << none.out;
  EXPECT_EQ(run_roam({"build", "-o", store, "--merge"}).status, 0);
}

TEST(StoreBuildProgram, TakesTheNumberOfItsTaskFromABatchEngine) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(20, 0.5, {0.0, 0.0, 0.0}));
  const std::string store = folder.file("s");
  const auto task = [&] { return run_roam({"build", "-o", store, "--shard", "auto"}); };
  // Before SCENE, --plan without a number is --plan.
  ASSERT_EQ(run_roam({"build", "--plan", scene, "-o", store}).status, 0);
  const auto outside = task();
  EXPECT_EQ(outside.status, 2);
  EXPECT_NE(outside.err.find("this is no job of an array"), std::string::npos) << outside.err;
  const std::vector<std::vector<std::string>> engines = {{"Slurm", "SLURM_ARRAY_TASK_ID", "0"},
                                                         {"Grid Engine", "SGE_TASK_ID", "1"},
                                                         {"PBS", "PBS_ARRAY_INDEX", "0"},
                                                         {"Torque", "PBS_ARRAYID", "0"},
                                                         {"LSF", "LSB_JOBINDEX", "1"},
                                                         {"AWS Batch", "AWS_BATCH_JOB_ARRAY_INDEX", "0"},
                                                         {"Kubernetes", "JOB_COMPLETION_INDEX", "0"},
                                                         {"GNU parallel", "PARALLEL_SEQ", "1"}};
  for (const auto& engine : engines) {
    const EnvironmentVariable first(engine[1].c_str(), engine[2]);
    const auto built = task();
    const std::string start = "task 0 of 1 (" + engine[0] + ", " + engine[1] + "=" + engine[2] + "): shards built: ";
    EXPECT_EQ(built.out.rfind(start, 0), 0U) << built.out << built.err;
  }
  {
    // Jobs outside of arrays have these values. The first variable that counts wins.
    const EnvironmentVariable grid("SGE_TASK_ID", "undefined"), lsf("LSB_JOBINDEX", "0"), parallel("PARALLEL_SEQ", "1");
    EXPECT_NE(task().out.find("GNU parallel"), std::string::npos);
    const EnvironmentVariable slurm("SLURM_ARRAY_TASK_ID", "7");
    const auto beyond = task();
    EXPECT_EQ(beyond.status, 0) << beyond.err;
    EXPECT_NE(beyond.out.find("no task 7 in the plan: they go from 0 to 0 (SLURM_ARRAY_TASK_ID=7)"), std::string::npos)
        << beyond.out;
    const auto named = run_roam({"build", "-o", store, "--shard", "7"});
    EXPECT_EQ(named.status, 0) << named.err;
    EXPECT_NE(named.out.find("nothing to do: "), std::string::npos) << named.out;
  }
  for (const char* wrong : {"x", "-1", "1e3", "99999999999999999999999"}) {
    const EnvironmentVariable slurm("SLURM_ARRAY_TASK_ID", wrong);
    EXPECT_EQ(task().status, 2) << wrong;
  }
  ASSERT_EQ(run_roam({"build", "-o", store, "--merge"}).status, 0);
  const EnvironmentVariable late("AWS_BATCH_JOB_ARRAY_INDEX", "0");
  for (const auto& repeated : {task(), run_roam({"build", "-o", store, "--merge"})}) {
    EXPECT_EQ(repeated.status, 0) << repeated.err;
    EXPECT_EQ(repeated.out, "nothing to do: " + store + " is complete, and no build of it is planned\n");
  }
}

TEST(StoreBuildProgram, IsStoppedByCtrlCAndGoesOn) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(900, 0.5, {0.0, 0.0, 0.0}));
  const auto stopped = run_roam({"build", scene, "-o", folder.file("s")}, {.interrupt_after = 0.3});
  EXPECT_EQ(stopped.status, 130);
  EXPECT_NE(stopped.err.find("the same command again goes on"), std::string::npos) << stopped.err;
  EXPECT_FALSE(roam::Store::is_store(folder.file("s")));
  const auto rest = run_roam({"build", scene, "-o", folder.file("s")});
  EXPECT_EQ(rest.status, 0) << rest.err;
  expect_whole(folder.file("s"));
}

TEST(StoreBuildProgram, RefusesWrongUsage) {
  const TestFolder folder;
  EXPECT_EQ(run_roam({"build"}).status, 2);
  EXPECT_EQ(run_roam({"build", "a.ply", "--plan", "--merge"}).status, 2);
  EXPECT_EQ(run_roam({"build", "--merge"}).status, 2);
  const std::string scene = write_ply(folder.file("a.ply"), field(4, 0.5, {0.0, 0.0, 0.0}));
  const auto small = run_roam({"build", scene, "--memory", "10M"});
  EXPECT_EQ(small.status, 2);
  EXPECT_NE(small.err.find("--memory 10 MiB: a build needs at least 256 MiB"), std::string::npos) << small.err;
}

}  // namespace
