// What a stranger may have left for a builder: it is refused or forgotten, in little memory.
#include <gtest/gtest.h>

#include "memory_cost.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using memory_cost::Cost;
using memory_cost::cost_of;
using roam::Vec3;

TEST(StoreBuildHostile, FilesOfABuilderAreReadWithinLimits) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 1.0, Vec3(0.0))), store = folder.file("s");
  const auto o = options({scene}, store);
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_shard(o, 0, report);
  // All that a builder writes as JSON, and finds there the next time.
  std::vector<fs::path> files{store + "/sources.json"};
  for (const auto& entry : fs::recursive_directory_iterator(store + "/scratch")) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  ASSERT_EQ(files.size(), 4U) << "the files, the plan, a part, a shard";
  std::string values;
  for (int i = 0; i < 10'000'000; ++i) values += "[],";
  for (const fs::path& file : files) {
    std::string good;
    if (fs::exists(file)) {
      std::ifstream in(file);
      good.assign(std::istreambuf_iterator<char>(in), {});
    }
    for (const std::string& text : {std::string(60'000'000, '['), "{\"x\": [" + values + "1]}"}) {
      std::ofstream(file) << text;
      // Merging reads the plan and the shard, building all of them but the plan.
      const Cost merging = cost_of([&] { roam::merge_store(o, report); });
      EXPECT_LT(merging.mebibytes, 200U) << file << merging.said;
      const bool merges = file.filename() == "plan.json" || file.parent_path().filename() == "shards";
      EXPECT_EQ(!merging.said.empty(), merges) << file << ": " << merging.said;
      if (!merges) {
        const Cost planning = cost_of([&] { static_cast<void>(roam::plan_store(o, report)); });
        EXPECT_LT(planning.mebibytes, 250U) << file << planning.said;
        EXPECT_EQ(planning.said, "") << file;
        // As it was: planned, and built.
        fs::remove_all(store);
        ASSERT_EQ(roam::plan_store(o, report), 1U);
        roam::build_shard(o, 0, report);
      }
    }
    std::ofstream(file) << good;
  }
}

}  // namespace
