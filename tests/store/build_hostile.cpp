// What a stranger may have left for a builder: it is refused or forgotten, in little memory.
#include <gtest/gtest.h>

#include "memory_cost.h"
#include "store/build/merge.h"
#include "store/build/plan.h"
#include "store/build/root.h"
#include "store/files.h"
#include "store/held.h"
#include "store/part.h"
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
  roam::build_task(o, 0, report);
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
      EXPECT_LT(merging.mebibytes, 250U) << file << merging.said;
      const bool merges = file.filename() == "plan.json" || file.parent_path().filename() == "shards";
      EXPECT_EQ(!merging.said.empty(), merges) << file << ": " << merging.said;
      if (!merges) {
        const Cost planning = cost_of([&] { static_cast<void>(roam::plan_store(o, report)); });
        EXPECT_LT(planning.mebibytes, 250U) << file << planning.said;
        EXPECT_EQ(planning.said, "") << file;
        // As it was: planned, and built.
        fs::remove_all(store);
        ASSERT_EQ(roam::plan_store(o, report), 1U);
        roam::build_task(o, 0, report);
      }
    }
    std::ofstream(file) << good;
  }
}

TEST(StoreBuildHostile, ShardsAndScenesOfMoreTrianglesThanThereCanBeAreRefused) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 1.0, Vec3(0.0))), store = folder.file("s");
  const auto o = options({scene}, store);
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  const roam::store::Work work(o);
  const roam::store::Plan good = roam::store::read_plan(work);
  roam::store::Plan plan = good;
  plan.shards[0].stretch.triangles = 1ULL << 34;
  plan.shards[0].key = roam::store::key_of(plan.shards[0].stretch, plan);
  roam::store::write_plan(work, plan);
  const Cost cost = cost_of([&] { roam::build_task(o, 0, report); });
  EXPECT_NE(cost.said.find("too large"), std::string::npos) << cost.said;
  EXPECT_LT(cost.mebibytes, 16U);
  // The part of a published store, which is what the builder takes for the scene's.
  roam::store::write_plan(work, good);
  roam::build_store(o);
  roam::store::PartFile part;
  part.triangles = 1ULL << 40;
  part.cells.push_back({0, part.triangles});
  roam::store::Manifest manifest = *roam::store::manifest_in_force(work);
  const auto bytes = roam::store::encode_part(part);
  roam::store::NewFile file(store, "parts/new.part");
  file.write(bytes);
  manifest.parts[0].file = file.commit_by_hash();
  manifest.parts[0].bytes = bytes.size();
  fs::remove_all(store + "/packs");  // so that something is to be built
  roam::store::publish(store, manifest);
  const Cost planning = cost_of([&] { static_cast<void>(roam::plan_store(o, report)); });
  EXPECT_NE(planning.said.find("more triangles than any scene has"), std::string::npos) << planning.said;
  EXPECT_LT(planning.mebibytes, 200U);
}

TEST(StoreBuildHostile, PartsOfMoreCellsThanFitTheMemoryArePlannedInIt) {
  const TestFolder folder;
  std::vector<std::string> scene;
  for (int i = 0; i < 16; ++i) {
    scene.push_back(write_ply(folder.file(std::to_string(i) + ".ply"), field(9, 1.0, {10.0 * i, 0.0, 0.0})));
  }
  auto o = options(scene, folder.file("s"));
  o.memory = roam::StoreBuildOptions::least_memory;
  roam::build_store(o);
  const roam::store::Work work(o);
  roam::store::Manifest manifest = *roam::store::manifest_in_force(work);
  for (std::size_t i = 0; i < scene.size(); ++i) {
    roam::store::PartFile part;
    part.cell_bits = 30;
    for (; part.triangles < roam::store::most_cells; ++part.triangles) {
      part.cells.push_back({roam::store::CurveKey{part.triangles * scene.size() + i} << part.cell_bits, 1});
    }
    const auto bytes = roam::store::encode_part(part);
    roam::store::NewFile file(o.output, "parts/new.part");
    file.write(bytes);
    manifest.parts[i].file = file.commit_by_hash();
    manifest.parts[i].bytes = bytes.size();
  }
  fs::remove_all(folder.file("s/packs"));  // so that something is to be built
  roam::store::publish(work.store, manifest);
  roam::StoreBuildReport report;
  const Cost planning = cost_of([&] { static_cast<void>(roam::plan_store(o, report)); });
  EXPECT_EQ(planning.said, "");
  EXPECT_EQ(report.parts_read, scene.size());
  EXPECT_LT(planning.mebibytes, 200U);
}

TEST(StoreBuildHostile, AManifestMayTakeAllMemoryOfTheBuildAndNoMore) {
  const TestFolder folder;
  auto o = options({write_ply(folder.file("a.ply"), field(60, 1.0, Vec3(0.0)))}, folder.file("s"));
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_task(o, 0, report);
  roam::store::Work work(o);
  roam::store::Plan plan = roam::store::read_plan(work);
  plan.parts[0].notes.assign(3000, "a.ply: x");
  const auto most = o.memory;
  constexpr std::uint64_t less = 256 << 10, enough = 2 * less;  // bytes
  std::vector<std::string> notes;
  const auto merge = [&] { notes = roam::store::merge(work, plan, less); };
  const auto read = [&] { static_cast<void>(roam::store::manifest_in_force(work)); };
  const auto tidy = [&] { static_cast<void>(roam::store::tidy(work.store, o.memory)); };
  const auto verify = [&] { EXPECT_TRUE(roam::store::verify_store(work.store, {}, o.memory).whole()); };
  o.memory = less;
  const std::string said = refusal(merge);
  EXPECT_NE(said.find("--memory"), std::string::npos) << said;
  EXPECT_FALSE(roam::Store::is_store(o.output)) << "no build of that memory could go on from it";
  o.memory = enough;
  EXPECT_EQ(refusal(merge), "");
  EXPECT_NE(notes.at(0).find("other verbs do not"), std::string::npos) << notes.at(0);
  EXPECT_FALSE(fs::exists(folder.file("s/scratch")));
  EXPECT_EQ(refusal(read) + refusal(tidy) + refusal(verify), "");
  o.memory = less;
  for (const std::string& refused : {refusal(read), refusal(tidy), refusal(verify)}) {
    EXPECT_NE(refused.find("--memory"), std::string::npos) << refused;
  }
  o.memory = most;
  EXPECT_TRUE(roam::build_store(o).unchanged);
  EXPECT_EQ(refusal([&] { roam::repair_store(o); }), "");
}

TEST(StoreBuildHostile, ACopyOfTheManifestThatTakesMoreThanTheMemoryIsNoDamage) {
  const TestFolder folder;
  auto o = options({write_ply(folder.file("a.ply"), field(60, 1.0, Vec3(0.0)))}, folder.file("s"));
  roam::build_store(o);
  const auto before = content(folder.file("s"));
  fs::remove(folder.file("s/CURRENT"));
  roam::store::Work work(o);
  const auto more = o.memory;
  const std::uint64_t text = fs::file_size(fs::directory_iterator(folder.file("s/spare"))->path());
  for (const std::uint64_t less : {text - 1, text + 100}) {
    o.memory = less;
    const std::string said = refusal([&] { static_cast<void>(roam::store::mend_root(work, std::nullopt)); });
    EXPECT_NE(said.find("--memory"), std::string::npos) << said;
  }
  o.memory = more;
  EXPECT_TRUE(roam::store::mend_root(work, std::nullopt).mended);
  EXPECT_TRUE(content(folder.file("s")) == before);
}

TEST(StoreBuildHostile, APlanThatTakesMoreThanTheMemoryAsksForMore) {
  const TestFolder folder;
  auto o = options({write_ply(folder.file("a.ply"), field(60, 1.0, Vec3(0.0)))}, folder.file("s"));
  o.memory = roam::StoreBuildOptions::least_memory;
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  const std::string file = folder.file("s/scratch/plan.json");
  std::string values;
  for (int i = 0; i < 10'000'000; ++i) values += "[],";
  for (const std::string& text : {"[" + values + "1]", "\"" + std::string(65 << 20, 'x') + "\""}) {
    std::ofstream(file) << text;
    const std::string said = refusal([&] { roam::build_task(o, 0, report); });
    EXPECT_NE(said.find("--memory"), std::string::npos) << said;
    EXPECT_EQ(said.find("plan again"), std::string::npos) << said;
  }
}

}  // namespace
