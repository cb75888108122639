// Shares of a scene that are read before the plan: it reads what they left, and the store is the same.

#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <future>
#include <thread>
#include <utility>

#include "store/build/layout.h"
#include "store/build/run.h"
#include "store/files.h"
#include "store_builds.h"

namespace {

using namespace store_builds;
using roam::StoreBuildReport;

/// A scene of a few files, its store, and another one that is built in steps.
class StoreShares : public testing::Test {
 protected:
  StoreShares() {
    for (std::uint32_t i = 0; i < parts; ++i) {
      const std::string file = folder_.file("f" + std::to_string(i) + ".ply");
      scene_.push_back(write_ply(file, field(20 + 5 * i, 0.5, {30.0 * i, 0.0, 0.0})));
    }
    roam::build_store(in("whole", 0));
  }

  /// With a key, as the program does.
  roam::StoreBuildOptions in(const std::string& output, std::uint64_t tasks) const {
    auto o = options(scene_, folder_.file(output));
    o.tasks = tasks;
    o.key.emplace();
    return o;
  }
  StoreBuildReport read(std::uint64_t share, std::uint64_t shares) const {
    StoreBuildReport report;
    roam::read_share(in("steps", shares), share, report);
    return report;
  }
  /// The rest of the build. Returns how many parts the plan read.
  std::uint64_t plan_and_build(const std::string& output = "steps", std::uint64_t tasks = 2) const {
    StoreBuildReport report;
    const auto o = in(output, tasks);
    roam::plan_store(o, report);
    const std::uint64_t parts_read = report.parts_read;
    for (std::uint64_t i = 0; i < report.tasks; ++i) roam::build_task(o, i, report);
    roam::merge_store(o, report);
    return parts_read;
  }
  /// Reads and plans the build. Returns one of its runs.
  fs::path planned_run(const roam::StoreBuildOptions& planned) const {
    read(0, 1);
    StoreBuildReport report;
    roam::plan_store(planned, report);
    return scratch("scratch/runs")[1];
  }
  void expect_the_same() const { expect_same(folder_.file("whole"), folder_.file("steps")); }
  /// The files of a folder of the scratch.
  std::vector<fs::path> scratch(const std::string& of) const {
    std::vector<fs::path> files;
    for (const auto& entry : fs::directory_iterator(folder_.file("steps/" + of))) files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
  }

  static constexpr std::uint32_t parts = 3;
  TestFolder folder_;
  std::vector<std::string> scene_;
};

TEST_F(StoreShares, LeaveThePlanNothingToReadInAnyNumberAndOrder) {
  for (const std::uint64_t shares : {2, 4}) {
    fs::remove_all(folder_.file("steps"));
    std::uint64_t all = 0;
    for (std::uint64_t i = shares; i-- > 0;) {
      const StoreBuildReport first = read(i, shares), again = read(i, shares);
      EXPECT_EQ(first.parts, parts);
      EXPECT_EQ(first.parts_read, first.share_parts);
      EXPECT_EQ(again.parts_read, 0U) << "it is there";
      EXPECT_EQ(again.share_parts, first.share_parts);
      all += first.parts_read;
    }
    EXPECT_EQ(all, parts) << "each part once";
    EXPECT_EQ(plan_and_build(), 0U);
    expect_the_same();
    EXPECT_EQ(read(0, shares).parts_read, 0U) << "too late, and harmless";
    EXPECT_FALSE(fs::exists(folder_.file("steps/scratch")));
  }
}

TEST_F(StoreShares, ThatAreMissingAreReadByThePlan) {
  const std::uint64_t done = read(1, 2).parts_read;
  ASSERT_GT(done, 0U);
  ASSERT_LT(done, parts);
  EXPECT_EQ(plan_and_build(), parts - done);
  expect_the_same();
}

TEST_F(StoreShares, MayRunTwiceAtOnceAndBesideOtherNumbers) {
  {
    std::vector<std::jthread> threads;
    for (const auto& [share, shares] : {std::pair(0, 2), {0, 2}, {1, 2}, {0, 1}}) {
      threads.emplace_back(
          [this, i = share, n = shares] { read(static_cast<std::uint64_t>(i), static_cast<std::uint64_t>(n)); });
    }
  }
  EXPECT_EQ(plan_and_build(), 0U);
  expect_the_same();
}

TEST_F(StoreShares, MayRunWhileThePlanReads) {
  StoreBuildReport report;
  const auto o = in("steps", 2);
  {
    const std::jthread share([this] { read(0, 1); });
    roam::plan_store(o, report);
  }
  for (std::uint64_t i = 0; i < report.tasks; ++i) roam::build_task(o, i, report);
  roam::merge_store(o, report);
  expect_the_same();
}

TEST_F(StoreShares, LoseNothingToAPlanThatFails) {
  auto o = in("steps", 2);
  const std::string run = folder_.file("steps/scratch/runs/of_a_share.run");
  bool read = false;
  o.progress = [&](const auto&) {
    // A share reads while the plan has the lock.
    if (!read && fs::exists(fs::path(run).parent_path())) {
      std::ofstream(run) << 'x';
      for (const std::string& file : scene_) std::ofstream(file, std::ios::trunc) << "no ply";
      read = true;
    }
    return true;
  };
  StoreBuildReport report;
  EXPECT_NE(refusal([&] { roam::plan_store(o, report); }), "");
  EXPECT_TRUE(read);
  EXPECT_TRUE(fs::exists(run));
}

TEST_F(StoreShares, AreReadForAStoreOfWhichTheRootIsDamaged) {
  for (const char* damage : {"", "no name of a manifest\n"}) {
    fs::remove_all(folder_.file("steps"));
    plan_and_build();
    std::ofstream(folder_.file("steps/CURRENT"), std::ios::trunc) << damage;
    write_ply(scene_[1], field(20, 0.5, {30.0, 0.0, 1.0 + std::string(damage).size()}));
    read(0, 2);
    read(1, 2);
    EXPECT_EQ(plan_and_build(), 0U) << damage;
    roam::build_store(in("whole", 0));
    expect_the_same();
  }
}

TEST_F(StoreShares, TakeNoLongerToReadThanAllTheyDo) {
  StoreBuildReport report;
  const auto begin = std::chrono::steady_clock::now();
  roam::read_share(in("steps", 1), 0, report);
  EXPECT_GT(report.read_seconds, 0.0);
  EXPECT_LE(report.read_seconds, std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
}

TEST_F(StoreShares, OfWhichARecordIsTooLargeAreReadAgain) {
  read(0, 1);
  fs::resize_file(scratch("scratch/parts")[1], std::uintmax_t{65} << 20);
  EXPECT_EQ(plan_and_build(), 1U);
  expect_the_same();
}

TEST_F(StoreShares, AreSharedOutInAnyNumber) { EXPECT_LE(read(0, std::uint64_t{1} << 62).parts_read, 1U); }

TEST_F(StoreShares, OfWhichFilesAreDamagedOrForeignAreReadAgain) {
  const auto flip = [](const fs::path& path, std::uintmax_t at) {
    std::fstream file(path, std::ios::in | std::ios::out | std::ios::binary);
    file.seekg(static_cast<std::streamoff>(at));
    const auto byte = static_cast<char>(file.get() ^ 1);
    file.seekp(static_cast<std::streamoff>(at));
    file.put(byte);
  };
  const auto other = [this](const std::string& of, const fs::path& than) {
    const std::vector<fs::path> files = scratch(of);
    return files.front() == than ? files.back() : files.front();
  };
  const std::vector<std::pair<const char*, std::function<void(const fs::path&)>>> harms = {
      {"scratch/runs", [](const fs::path& path) { fs::resize_file(path, fs::file_size(path) - 48); }},
      {"scratch/runs", [&](const fs::path& path) { flip(path, fs::file_size(path) - 1); }},
      {"scratch/runs",
       [&](const fs::path& path) {
         fs::copy_file(other("scratch/runs", path), path, fs::copy_options::overwrite_existing);
       }},
      {"scratch/runs", [](const fs::path& path) { fs::remove(path); }},
      {"parts", [&](const fs::path& path) { flip(path, fs::file_size(path) / 2); }},
      {"parts", [](const fs::path& path) { fs::resize_file(path, 8); }},
      {"scratch/parts", [&](const fs::path& path) { flip(path, 100); }},
      {"scratch/parts", [](const fs::path& path) { fs::resize_file(path, 0); }},
      {"scratch/parts",
       [&](const fs::path& path) {
         fs::copy_file(other("scratch/parts", path), path, fs::copy_options::overwrite_existing);
       }},
  };
  read(0, 1);
  fs::rename(folder_.file("steps"), folder_.file("unharmed"));
  for (std::size_t i = 0; i < harms.size(); ++i) {
    SCOPED_TRACE(i);
    fs::remove_all(folder_.file("steps"));
    fs::copy(folder_.file("unharmed"), folder_.file("steps"), fs::copy_options::recursive);
    harms[i].second(scratch(harms[i].first)[1]);
    EXPECT_EQ(plan_and_build(), 1U);
    expect_the_same();
  }
  fs::remove_all(folder_.file("steps"));
  auto stranger = in("steps", 1);
  stranger.key->bytes[0] = std::byte{1};
  StoreBuildReport report;
  roam::read_share(stranger, 0, report);
  EXPECT_EQ(plan_and_build(), parts) << "of another key";
  expect_the_same();
}

TEST_F(StoreShares, WithADamagedBlockAreRefusedByATaskAndReadAgainByTheNextPlan) {
  const auto o = in("steps", 1);
  const fs::path run = planned_run(o);
  StoreBuildReport report;
  std::fstream(run, std::ios::in | std::ios::out | std::ios::binary).seekp(100).put('?');
  const std::string said = refusal([&] { roam::build_task(o, 0, report); });
  EXPECT_NE(said.find(run.string() + " was damaged (a block of it is damaged)"), std::string::npos) << said;
  EXPECT_NE(refusal([&] { roam::build_task(o, 0, report); }).find("is gone: plan or build again"), std::string::npos);
  EXPECT_EQ(plan_and_build(), 1U);
  expect_the_same();
}

TEST_F(StoreShares, ThatOneMachineReadsWronglyStay) {
  const auto o = in("steps", 1);
  const fs::path run = planned_run(o);
  StoreBuildReport report;
  const roam::store::Folder store = roam::store::Folder::held(folder_.file("steps"), true);
  const auto bytes = roam::store::read_file(store, "scratch/runs/" + run.filename().string(), 1 << 26);
  std::uint64_t hash = 0;
  std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
  const roam::store::RunReader reader(store, "scratch/runs/" + run.filename().string(), hash);
  // The open file is damaged, and another file has taken its name.
  std::fstream(run, std::ios::in | std::ios::out | std::ios::binary).seekp(100).put('?');
  fs::rename(run, folder_.file("old"));
  std::ofstream(run, std::ios::binary)
      .write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  roam::store::RunBlock block;
  const std::string said = refusal([&] { reader.read(0, block); });
  EXPECT_NE(said.find("is right when read again"), std::string::npos) << said;
  roam::build_task(o, 0, report);
  roam::merge_store(o, report);
  expect_the_same();
}

TEST_F(StoreShares, OfAnOlderSceneAreReadAgain) {
  read(0, 1);
  write_ply(scene_[2], field(21, 0.5, {60.0, 0.0, 1.0}));
  EXPECT_EQ(plan_and_build(), 1U);
  roam::build_store(in("whole", 0));
  expect_the_same();
  // An update reads only the changed part.
  write_ply(scene_[1], field(22, 0.5, {30.0, 0.0, 1.0}));
  EXPECT_EQ(read(0, 2).parts_read + read(1, 2).parts_read, 1U);
  EXPECT_EQ(plan_and_build(), parts - 1U) << "those that lie in shards with it";
  roam::build_store(in("whole", 0));
  expect_the_same();
}

TEST_F(StoreShares, ReadAllForAStoreOfWhichEachShardIsBuiltAnew) {
  ASSERT_EQ(plan_and_build(), parts);
  const auto lossless = [this](const std::string& output) {
    auto o = in(output, 1);
    o.lossless = true;
    return o;
  };
  StoreBuildReport report;
  roam::read_share(lossless("steps"), 0, report);
  EXPECT_EQ(report.parts_read, parts);
  report = roam::build_store(lossless("steps"));
  EXPECT_EQ(report.parts_read, 0U);
  roam::build_store(lossless("whole"));
  expect_the_same();
}

TEST_F(StoreShares, OutliveAPlanThatFailsMeanwhile) {
  std::promise<void> reading, failed;
  std::future<void> share;
  auto wrong = in("steps", 1);
  wrong.scene = {folder_.file("absent.ply")};
  wrong.progress = [&](const roam::StoreBuildProgress&) {
    if (share.valid()) return true;
    // It begins when the plan has the folder, and has no run when the plan fails.
    share = std::async(std::launch::async, [&] {
      auto o = in("steps", 1);
      bool waited = false;
      o.progress = [&](const roam::StoreBuildProgress& p) {
        if (p.bytes_total == 0 || std::exchange(waited, true)) return true;
        reading.set_value();
        failed.get_future().wait();
        return true;
      };
      StoreBuildReport report;
      roam::read_share(o, 0, report);
    });
    reading.get_future().wait();
    return true;
  };
  StoreBuildReport report;
  const std::string said = refusal([&] { roam::plan_store(wrong, report); });
  EXPECT_NE(said.find("absent.ply"), std::string::npos) << said;
  failed.set_value();
  EXPECT_NO_THROW(share.get());
  EXPECT_EQ(scratch("scratch/parts").size(), parts) << "nothing but records stays";
  EXPECT_EQ(plan_and_build(), 0U);
  expect_the_same();
}

TEST_F(StoreShares, AreNotReadIntoWhatIsNoStoreOfTheUser) {
  EXPECT_THROW(read(3, 3), roam::NoSuchTask);
  folder_.write("other.txt", "x");
  StoreBuildReport report;
  auto o = in("", 1);
  EXPECT_NE(refusal([&] { roam::read_share(o, 0, report); }), "") << "in the folder of the scene";
  o = in("whole", 1);
  o.key->bytes[0] = std::byte{1};
  EXPECT_NE(refusal([&] { roam::read_share(o, 0, report); }).find("it was not built with your key"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_.file("whole/scratch")));
  fs::create_directory(folder_.file("steps"));
  folder_.write("steps/letter.txt", "x");
  EXPECT_NE(refusal([&] { read(0, 1); }).find("letter.txt"), std::string::npos);
  fs::remove_all(folder_.file("steps"));
  scene_.push_back(folder_.file("absent.ply"));
  EXPECT_NE(refusal([&] { read(0, 1); }).find("absent.ply"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_.file("steps"))) << "nothing is made for a scene that is not there";
}

}  // namespace
