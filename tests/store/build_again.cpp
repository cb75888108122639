// A build upon a store takes what has changed since, and nothing else; it repairs, and refuses what cannot be.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <thread>

#include "store/files.h"
#include "store_builds.h"

namespace {

using namespace store_builds;

TEST(StoreBuildAgain, DoesNothingWhenNothingChanged) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply")}, folder.file("s"));
  EXPECT_FALSE(roam::build_store(o).unchanged);
  const auto before = content(folder.file("s"));
  const auto again = roam::build_store(o);
  EXPECT_TRUE(again.unchanged);
  EXPECT_EQ(again.triangles, 7200U);
  EXPECT_EQ(again.parts_read + again.shards_built, 0U);
  // Another time is no other content.
  fs::last_write_time(folder.file("a.ply"), fs::last_write_time(folder.file("a.ply")) + std::chrono::hours(1));
  EXPECT_TRUE(roam::build_store(o).unchanged);
  EXPECT_TRUE(content(folder.file("s")) == before);
  auto other = o;
  other.import.unit = roam::LengthUnit::cm;
  EXPECT_FALSE(roam::build_store(other).unchanged);
}

TEST(StoreBuildAgain, TakesAFileThatChangedButNotInSizeForChanged) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply")}, folder.file("s"));
  roam::build_store(o);
  write_ply(folder.file("a.ply"), field(60, 0.5, {1.0, 0.0, 0.0}));
  EXPECT_FALSE(roam::build_store(o).unchanged);
  roam::build_store(options({folder.file("a.ply")}, folder.file("fresh")));
  expect_same(folder.file("s"), folder.file("fresh"));
}

TEST(StoreBuildAgain, SeesAChangeBehindATimeThatWasSetBack) {
  const TestFolder folder;
  const fs::path scene = folder.file("a.ply");
  write_ply(scene, field(60, 0.5, {0.0, 0.0, 0.0}));
  std::this_thread::sleep_for(std::chrono::milliseconds(3200));  // what changed just now is hashed again in any case
  const auto o = options({scene.string()}, folder.file("s"));
  roam::build_store(o);
  EXPECT_TRUE(roam::build_store(o).unchanged);
  const auto size = fs::file_size(scene);
  const auto time = fs::last_write_time(scene);
  write_ply(scene, field(60, 0.5, {1.0, 0.0, 0.0}));
  fs::last_write_time(scene, time);
  ASSERT_EQ(fs::file_size(scene), size);
  EXPECT_FALSE(roam::build_store(o).unchanged);
}

TEST(StoreBuildAgain, ReadsAndBuildsOnlyWhatChanged) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(548, 0.5, {0.0, 0.0, 0.0}));
  write_ply(folder.file("b.ply"), field(548, 0.5, {9000.0, 0.0, 0.0}));
  const std::vector<std::string> scene{folder.file("a.ply"), folder.file("b.ply")};
  const auto first = roam::build_store(options(scene, folder.file("s")));
  ASSERT_EQ(first.shards, 2U);
  write_ply(folder.file("b.ply"), field(540, 0.5, {9000.0, 0.0, 3.0}));
  const auto second = roam::build_store(options(scene, folder.file("s")));
  EXPECT_FALSE(second.unchanged);
  EXPECT_EQ(second.parts_read, 1U);
  EXPECT_EQ(second.shards_built, 1U);
  expect_whole(folder.file("s"));
  roam::build_store(options(scene, folder.file("fresh")));
  expect_same(folder.file("s"), folder.file("fresh"));
  roam::build_store(options({scene[0]}, folder.file("s")));
  roam::build_store(options({scene[0]}, folder.file("fresh")));
  expect_same(folder.file("s"), folder.file("fresh"));
}

TEST(StoreBuildAgain, KeepsWhatAReaderOfTheOldStoreHolds) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply")}, folder.file("s"));
  roam::build_store(o);
  const auto before = content(folder.file("s"));
  auto reader = roam::Store::open(folder.file("s"));  // and reads nothing yet
  write_ply(folder.file("a.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  roam::build_store(o);
  const auto both = content(folder.file("s"));
  for (const auto& [name, bytes] : before) {
    if (name == "CURRENT" || name.starts_with("spare/")) continue;  // of the store in force alone
    EXPECT_TRUE(both.contains(name) && both.at(name) == bytes) << name;
  }
  std::uint64_t triangles = 0;
  reader->for_each_triangle(reader->info().bounds, [&](auto read, auto) { triangles += read.size(); });
  EXPECT_EQ(triangles, 2U * 60 * 60);
  EXPECT_EQ(roam::Store::open(folder.file("s"))->info().triangles, 2U * 50 * 50);
  reader.reset();
  EXPECT_TRUE(roam::build_store(o).unchanged);
  roam::build_store(options({folder.file("a.ply")}, folder.file("fresh")));
  expect_same(folder.file("s"), folder.file("fresh"));
}

TEST(StoreBuildAgain, RepairsJustWhatIsDamaged) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(548, 0.5, {0.0, 0.0, 0.0}));
  write_ply(folder.file("b.ply"), field(548, 0.5, {9000.0, 0.0, 0.0}));
  auto o = options({folder.file("a.ply"), folder.file("b.ply")}, folder.file("s"));
  o.lossless = true;
  o.import.up = roam::UpAxis::minus_y;
  o.import.unit = roam::LengthUnit::ft;
  o.import.ignore = {"nothing of this name"};
  roam::build_store(o);
  o.lossless = false;  // a repair does as the build did
  o.import = {};
  const auto before = content(folder.file("s"));
  EXPECT_EQ(roam::repair_store(o).shards_built, 0U);
  spoil_pack(folder.file("s"));
  fs::remove(fs::directory_iterator(folder.file("s") + "/parts")->path());
  EXPECT_FALSE(roam::verify_store(folder.file("s")).damage.empty());
  const auto damaged = content(folder.file("s"));
  write_ply(folder.file("c.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  auto other = o;
  other.scene.pop_back();
  for (const bool more : {false, true}) {
    if (more) other.scene.emplace_back(folder.file("c.ply"));
    EXPECT_NE(refusal([&] { roam::repair_store(other); }).find("not made of this scene"), std::string::npos);
    EXPECT_TRUE(content(folder.file("s")) == damaged) << "a part of another scene is left";
  }
  EXPECT_EQ(roam::repair_store(o).shards_built, 1U);
  EXPECT_TRUE(content(folder.file("s")) == before);
  expect_whole(folder.file("s"));
}

TEST(StoreBuildAgain, ARepairPutsNoOtherSceneInForce) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  auto o = options({folder.file("a.ply")}, folder.file("s"));
  roam::build_store(o);
  const auto before = content(folder.file("s"));
  // A build has made the missing pack again, and was stopped; then that pack was damaged, too.
  fs::remove_all(folder.file("s/packs"));
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_task(o, 0, report);
  spoil_pack(folder.file("s"));
  const std::string scene = folder.read("a.ply");
  auto changing = o;
  changing.progress = [&](const roam::StoreBuildProgress& p) {
    if (p.step == roam::StoreBuildProgress::Step::merge) {
      write_ply(folder.file("a.ply"), field(51, 0.5, {0.0, 0.0, 0.0}));
    }
    return true;
  };
  const std::string said = refusal([&] { roam::repair_store(changing); });
  EXPECT_NE(said.find("repair it again"), std::string::npos) << said;
  EXPECT_NE(refusal([&] { roam::repair_store(o); }).find("not made of this scene"), std::string::npos);
  folder.write("a.ply", scene);
  EXPECT_EQ(roam::repair_store(o).shards_built, 1U);
  EXPECT_TRUE(content(folder.file("s")) == before);
}

TEST(StoreBuildAgain, RefusesOutputsThatCannotBe) {
  const TestFolder folder;
  fs::create_directory(folder.file("scene"));
  const std::string scene = write_ply(folder.file("scene/a.ply"), field(10, 1.0, {0.0, 0.0, 0.0}));
  folder.write("file", "text");
  fs::create_directory(folder.file("full"));
  folder.write("full/holiday.jpg", "");
  const auto says = [&](const std::vector<std::string>& from, const std::string& output, const char* what) {
    const std::string text = refusal([&] { roam::build_store(options(from, output)); });
    EXPECT_NE(text.find(what), std::string::npos) << text;
  };
  says({scene}, folder.file("file"), "is a file");
  says({scene}, folder.file("full"), "holds other things");
  says({folder.file("scene")}, folder.file("scene/s"), "lies in the folder of the scene");
  says({scene}, folder.file("scene"), "lies in the output");
  says({folder.file("nothing.ply")}, folder.file("s"), "nothing.ply");
  auto small = options({scene}, folder.file("s"));
  small.memory = 100 << 20;
  EXPECT_NE(refusal([&] { roam::build_store(small); }).find("256 MiB"), std::string::npos);
  EXPECT_EQ(content(folder.file("full")).size(), 1U);
}

TEST(StoreBuildAgain, RefusesASecondBuilder) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(10, 1.0, {0.0, 0.0, 0.0}));
  roam::build_store(options({scene}, folder.file("s")));
  const roam::store::BuildLock lock(folder.file("s"));
  const std::string text = refusal([&] { roam::build_store(options({scene}, folder.file("s"))); });
  EXPECT_NE(text.find("process " + std::to_string(::getpid())), std::string::npos) << text;
}

}  // namespace
