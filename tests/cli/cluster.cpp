// The verb `roam cluster`, with a Slurm that is made up here. tests/tree/cluster.sh has a real one.

#include <gtest/gtest.h>

#include "environment_variable.h"
#include "store_builds.h"

namespace {

using namespace store_builds;

TEST(Cluster, WritesJobsForSlurm) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("it's a $(scene).ply"), field(20, 0.5, {0.0, 0.0, 0.0}));
  const std::string store = folder.file("s");
  const std::vector<std::string> verb = {"cluster", "slurm",    scene,  "-o",     store, "--shards",
                                         "3",       "--memory", "300M", "--unit", "ft"};
  // A Slurm that runs each job at once, and notes its arguments.
  std::filesystem::create_directory(folder.file("bin"));
  std::ofstream(folder.file("bin/sbatch")) << "#!/bin/sh\necho \"$@\" >> '" + folder.file("jobs") + R"('
cat > "$0.job"
case "$*" in
*--array=0-2*) for i in 0 1 2; do SLURM_ARRAY_TASK_ID=$i sh "$0.job" || exit; done ;;
*) sh "$0.job" ;;
esac > "$0.out" || exit
echo "4$(wc -l < ')" + folder.file("jobs") + "');cluster\"\n";
  std::filesystem::permissions(folder.file("bin/sbatch"), std::filesystem::perms::owner_all);
  const auto printed = run_roam(verb);
  ASSERT_EQ(printed.status, 0) << printed.err;
  const std::string path = std::getenv("PATH");
  const EnvironmentVariable with_slurm("PATH", folder.file("bin") + ":" + path);
  const auto run = run_program("/bin/sh", {"-c", printed.out});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "The jobs are 41 42 43 44; the last one writes slurm-44.out.\n");
  std::ifstream jobs(folder.file("jobs"));
  const std::string said{std::istreambuf_iterator<char>(jobs), {}};
  const std::string common = "--parsable --requeue --job-name=roam-", limits = " --cpus-per-task=2 --mem=375M",
                    after = " --kill-on-invalid-dep=yes --dependency=afterok:42";
  EXPECT_EQ(said, common + "read" + limits + " --array=0-2\n" + common + "plan" + limits +
                      " --dependency=afterany:41\n" + common + "tasks" + limits + after + " --array=0-2\n" + common +
                      "merge" + limits + after + ",afterany:43\n");
  EXPECT_NEAR(roam::Store::open(store)->info().bounds.upper.x, 10.0 * 0.3048, 0.001) << "in feet";
  auto submitted = verb;
  submitted.push_back("--submit");
  EXPECT_EQ(run_roam(submitted).status, 0);
  const EnvironmentVariable without("PATH", folder.file("nothing"));
  const auto refused = run_roam(submitted);
  EXPECT_EQ(refused.status, 1);
  EXPECT_NE(refused.err.find("there is no sbatch here"), std::string::npos) << refused.err;
}

/// The system takes no argument of more than 128 KiB.
TEST(Cluster, SubmitsJobsOfAnyNumberOfScenes) {
  const TestFolder folder;
  std::filesystem::path deep = folder.file("");
  for (int i = 0; i < 12; ++i) deep /= std::string(250, 'a');
  std::filesystem::create_directories(deep);
  std::vector<std::string> verb = {"cluster", "slurm", "-o", folder.file("s"), "--shards", "3"};
  for (int i = 0; i < 40; ++i) {
    verb.push_back(write_ply((deep / (std::to_string(i) + ".ply")).string(), field(1, 0.5, {0.0, 0.0, 0.0})));
  }
  EXPECT_GT(run_roam(verb).out.size(), 128U << 10);
  verb.emplace_back("--submit");
  std::filesystem::create_directory(folder.file("bin"));
  std::ofstream(folder.file("bin/sbatch")) << "#!/bin/sh\ncat > /dev/null\necho 7\n";
  std::filesystem::permissions(folder.file("bin/sbatch"), std::filesystem::perms::owner_all);
  const std::string path = std::getenv("PATH");
  const EnvironmentVariable with_slurm("PATH", folder.file("bin") + ":" + path);
  const auto run = run_roam(verb);
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_EQ(run.out, "The jobs are 7 7 7 7; the last one writes slurm-7.out.\n");
}

TEST(Cluster, RefusesNamesThatTheShellWouldRead) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a\nEND\n.ply"), field(2, 0.5, {0.0, 0.0, 0.0}));
  const std::string steering = write_ply(folder.file("a\xc2\x9b.ply"), field(2, 0.5, {0.0, 0.0, 0.0}));
  const std::string raw = write_ply(folder.file("a\x9b.ply"), field(2, 0.5, {0.0, 0.0, 0.0}));
  const std::string turning = write_ply(folder.file("a\xe2\x80\xae.ply"), field(2, 0.5, {0.0, 0.0, 0.0}));
  for (const std::string& name : {scene, steering, raw, turning}) {
    const auto refused = run_roam({"cluster", "slurm", name, "--shards", "3"});
    EXPECT_EQ(refused.status, 2);
    EXPECT_NE(refused.err.find("this name has a line break"), std::string::npos) << refused.err;
  }
  const std::string old = write_ply(folder.file("caf\xe9.ply"), field(2, 0.5, {0.0, 0.0, 0.0}));
  EXPECT_NE(run_roam({"cluster", "slurm", old, "--shards", "3"}).out.find("caf\xe9.ply'"), std::string::npos);
  EXPECT_EQ(run_roam({"cluster", "slurm", folder.file("absent.ply"), "--shards", "3"}).status, 1);
  EXPECT_EQ(run_roam({"cluster", "slurm", scene}).status, 2);
  EXPECT_EQ(run_roam({"cluster"}).status, 2);
}

}  // namespace
