// Builds that are killed, repeated, cut into steps, or follow a change give the same bytes as one that is not.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iterator>
#include <thread>
#include <utility>

#include "clutter.h"
#include "killed_builds.h"
#include "store/build/layout.h"
#include "store/build/output_folder.h"
#include "store/files.h"

namespace {

/// Ends the process by SIGKILL in the middle of its n-th call that changes the disk. 0: never.
std::atomic<int> calls{0};
std::atomic<int> fatal_call{0};
/// Whether the fatal call is still done.
std::atomic<bool> dies_after{false};
/// From the n-th call on they fail with this error; if it is ENOSPC, only those that write. 0: none fails.
std::atomic<int> failing_call{0}, failure{0};

template <class Call>
auto counted(Call&& call, bool writes = false) {
  const int number = ++calls;
  if (failing_call > 0 && number >= failing_call && (writes || failure != ENOSPC)) {
    errno = failure;
    return static_cast<decltype(call())>(-1);
  }
  const bool fatal = number == fatal_call;
  if (fatal && !dies_after) ::kill(::getpid(), SIGKILL);
  const auto result = call();
  if (fatal) ::kill(::getpid(), SIGKILL);
  return result;
}

}  // namespace

// These take the place of the C library's in this program.
extern "C" int fsync(int fd) {
  return counted([&] { return static_cast<int>(::syscall(SYS_fsync, fd)); });
}
extern "C" int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  return counted([&] { return static_cast<int>(::syscall(SYS_renameat, from_folder, from, to_folder, to)); });
}
extern "C" ssize_t write(int fd, const void* bytes, std::size_t size) {
  return counted([&] { return static_cast<ssize_t>(::syscall(SYS_write, fd, bytes, size)); }, true);
}
extern "C" int unlinkat(int folder, const char* file, int flags) noexcept {
  return counted([&] { return static_cast<int>(::syscall(SYS_unlinkat, folder, file, flags)); });
}

namespace {

using namespace store_builds;

/// Runs in a process of its own, which dies at a call that changes the disk; returns its wait status.
int killed_at(int call, bool after, const std::function<void()>& work) {
  return in_child([&] {
    calls = 0;
    fatal_call = call;
    dies_after = after;
    work();
  });
}

bool was_killed(int status) { return WIFSIGNALED(status) && WTERMSIG(status) == SIGKILL; }

/// How many calls that change the disk the work makes.
int calls_of(const std::string& file, const std::function<void()>& work) {
  EXPECT_EQ(in_child([&] {
              calls = 0;
              work();
              std::ofstream(file) << calls.load();
            }),
            0);
  int count = 0;
  std::ifstream(file) >> count;
  return count;
}

int kills(int usually) { return how_often("ROAM_TEST_KILLS", usually); }

TEST(StoreBuildResume, AfterBeingKilledAtAnyStepOnTheDisk) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  write_ply(folder.file("b.ply"), field(40, 0.5, {100.0, 0.0, 0.0}));
  const auto build = [&](const std::string& output) {
    auto o = options({folder.file("a.ply"), folder.file("b.ply")}, output);
    o.key.emplace();
    roam::build_store(o);
  };
  const int count = calls_of(folder.file("count"), [&] { build(folder.file("whole")); });
  ASSERT_GT(count, 20);
  expect_whole(folder.file("whole"));
  const std::string output = folder.file("killed");
  const int samples = std::min(count, kills(24));
  for (int i = 0; i < samples; ++i) {
    fs::remove_all(output);
    const int at = 1 + (count - 1) * i / (samples - 1);
    ASSERT_TRUE(was_killed(killed_at(at, i % 2 == 1, [&] { build(output); }))) << at;
    if (fs::exists(output + "/CURRENT")) expect_whole(output);
    ASSERT_EQ(in_child([&] { build(output); }), 0);
    expect_same(folder.file("whole"), output);
  }
}

TEST(StoreBuildResume, AnUpdateThatIsKilledLeavesTheOldStoreOrTheNew) {
  const ChangedScene changed;
  const auto build = [&] { changed.build(changed.output); };
  changed.begin_again(true);
  const int count = calls_of(changed.folder.file("count"), build);
  ASSERT_GT(count, 10);
  int old_ones = 0;
  const int samples = std::min(count, kills(24));
  for (int i = 0; i < samples; ++i) {
    changed.begin_again(true);
    const int at = 1 + (count - 1) * i / (samples - 1);
    ASSERT_TRUE(was_killed(killed_at(at, i % 2 == 1, build))) << at;
    old_ones += changed.is_old() ? 1 : 0;
    ASSERT_EQ(in_child(build), 0);
    expect_same(changed.updated, changed.output);
  }
  EXPECT_GT(old_ones, samples / 4);
  EXPECT_LT(old_ones, samples);
}

TEST(StoreBuildResume, SharesOfTheSceneThatAreKilledAtAnyStepOnTheDisk) {
  const TestFolder folder;
  auto o = options({write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0})),
                    write_ply(folder.file("b.ply"), field(40, 0.5, {100.0, 0.0, 0.0}))},
                   folder.file("killed"));
  o.tasks = 2;
  o.key.emplace();
  roam::StoreBuildReport report;
  const auto build = [&] { roam::build_store(o); };
  const auto share = [&](std::uint64_t i) { return [&, i] { roam::read_share(o, i, report); }; };
  ASSERT_EQ(in_child(build), 0);
  fs::rename(o.output, folder.file("whole"));
  const int count = calls_of(folder.file("count"), share(0));
  ASSERT_GT(count, 8);
  const int samples = std::min(count, kills(8));
  for (int i = 0; i < samples; ++i) {
    fs::remove_all(o.output);
    const int at = 1 + (count - 1) * i / (samples - 1);
    ASSERT_TRUE(was_killed(killed_at(at, i % 2 == 1, share(0)))) << at;
    if (i % 3 > 0) {
      ASSERT_EQ(in_child(share(1)), 0);
    }
    if (i % 3 > 1) {
      ASSERT_EQ(in_child(share(0)), 0);
    }
    ASSERT_EQ(in_child(build), 0);
    expect_same(folder.file("whole"), o.output.string());
  }
}

TEST(StoreBuildResume, SaysThatTheDiskIsFullAndGoesOnWhenItIsNot) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  const auto build = [&](const std::string& output) { roam::build_store(options({scene}, output)); };
  const int count = calls_of(folder.file("count"), [&] { build(folder.file("whole")); });
  const std::string output = folder.file("full");
  for (const int error : {ENOSPC, EIO}) {
    for (int i = 0; i < 8; ++i) {
      fs::remove_all(output);
      const int status = in_child([&] {
        failure = error;
        failing_call = 1 + (count / 2) * i / 7;
        const std::string text = refusal([&] { build(output); });
        failing_call = 0;
        std::ofstream(folder.file("said")) << text;
      });
      ASSERT_EQ(status, 0);
      const std::string said = folder.read("said");
      EXPECT_NE(said.find(std::strerror(error)), std::string::npos) << said;
      EXPECT_FALSE(roam::Store::is_store(output));
      ASSERT_EQ(in_child([&] { build(output); }), 0);
      expect_same(folder.file("whole"), output);
    }
  }
}

TEST(StoreBuildResume, AfterBeingKilledAgainAndAgainAtAnyTime) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(760, 0.5, {0.0, 0.0, 0.0}));  // two shards
  const auto build = [&](const std::string& output) { roam::build_store(options({folder.file("a.ply")}, output)); };
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(in_child([&] { build(folder.file("whole")); }), 0);
  const auto whole = std::chrono::steady_clock::now() - start;
  clutter::Random random(1);
  const std::string output = folder.file("killed");
  for (int i = 0; i < kills(6); ++i) {
    const pid_t child = ::fork();
    if (child == 0) {
      build(output);
      ::_exit(0);
    }
    std::this_thread::sleep_for(whole * random.unit());
    ::kill(child, SIGKILL);
    ::waitpid(child, nullptr, 0);
  }
  ASSERT_EQ(in_child([&] { build(output); }), 0);
  expect_same(folder.file("whole"), output);
}

TEST(StoreBuildResume, GivesTheSameBytesForAnyThreadsAndMemory) {
  const TestFolder folder;
  clutter::Random random(2);
  write_ply(folder.file("a.ply"), field(740, 0.25, {0.0, 0.0, 0.0}));
  write_ply(folder.file("b.ply"), clutter::make(random, {30'000, 90.0, 1e-3, 300.0, {50.0, 60.0, 0.0}}));
  const auto build = [&](const std::string& output, int threads, std::uint64_t memory, bool near) {
    auto o = options({folder.file("a.ply"), folder.file("b.ply")}, output);
    o.threads = threads;
    o.memory = memory;
    if (near) o.nearest_first = roam::Vec3(180.0, 180.0, 0.0);
    EXPECT_GT(roam::build_store(o).shards, 1U);
  };
  ASSERT_EQ(in_child([&] { build(folder.file("1"), 1, roam::StoreBuildOptions::least_memory, false); }), 0);
  ASSERT_EQ(in_child([&] { build(folder.file("2"), 2, 1ull << 30, true); }), 0);
  expect_same(folder.file("1"), folder.file("2"));
}

TEST(StoreBuildResume, InStepsByManyProcessesInAnyOrder) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(760, 0.5, {0.0, 0.0, 0.0}));
  ASSERT_EQ(in_child([&] { roam::build_store(options({folder.file("a.ply")}, folder.file("whole"))); }), 0);
  auto o = options({folder.file("a.ply")}, folder.file("steps"));
  o.tasks = 64;
  roam::StoreBuildReport report;
  std::uint64_t count = 0;
  ASSERT_EQ(in_child([&] { std::ofstream(folder.file("count")) << roam::plan_store(o, report); }), 0);
  std::ifstream(folder.file("count")) >> count;
  ASSERT_GT(count, 1U);
  o.scene.clear();
  const std::string missing = refusal([&] { roam::merge_store(o, report); });
  EXPECT_NE(missing.find("missing shards: 2, damaged shards: 0, in tasks 0-1 of 2;"), std::string::npos) << missing;
  for (std::uint64_t i = count; i-- > 0;) {
    ASSERT_EQ(in_child([&] { roam::build_task(o, i, report); }), 0);
    ASSERT_EQ(in_child([&] { roam::build_task(o, i, report); }), 0);
  }
  EXPECT_NE(refusal([&] { roam::build_task(o, count, report); }).find("there is no task"), std::string::npos);
  ASSERT_EQ(in_child([&] { roam::merge_store(o, report); }), 0);
  expect_same(folder.file("whole"), folder.file("steps"));
  EXPECT_NE(refusal([&] { roam::build_task(o, 0, report); }).find("no plan"), std::string::npos);
}

TEST(StoreBuildResume, AnotherNumberOfTasksKeepsShardsThatAreThere) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(760, 0.5, {0.0, 0.0, 0.0}));
  ASSERT_EQ(in_child([&] { roam::build_store(options({folder.file("a.ply")}, folder.file("whole"))); }), 0);
  const auto counts = [&](auto&& step) {
    // In a child, because a process that has threads cannot be forked again.
    EXPECT_EQ(in_child([&] {
                auto o = options({folder.file("a.ply")}, folder.file("steps"));
                roam::StoreBuildReport report;
                std::ofstream out(folder.file("counts"));
                step(o, report);
                out << report.tasks << ' ' << report.shards_to_build << ' ' << report.shards_built;
              }),
              0);
    std::ifstream in(folder.file("counts"));
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const auto plan = [&](std::uint64_t tasks) {
    return counts([&](auto& o, auto& report) {
      o.tasks = tasks;
      roam::plan_store(o, report);
    });
  };
  const auto build = [&](std::uint64_t i) {
    return counts([&](auto& o, auto& report) { roam::build_task(o, i, report); });
  };
  EXPECT_EQ(plan(64), "2 2 0") << "no task is empty";
  EXPECT_EQ(build(1), "2 2 1");
  EXPECT_EQ(plan(0), "1 2 0") << "two would not be equally long";
  EXPECT_EQ(build(0), "1 2 1");
  EXPECT_EQ(build(0), "1 2 0");
  EXPECT_EQ(plan(2), "2 2 0");
  EXPECT_EQ(build(1), "2 2 0");
  counts([](auto& o, auto& report) { roam::merge_store(o, report); });
  expect_same(folder.file("whole"), folder.file("steps"));
}

TEST(StoreBuildResume, MergingRefusesAPackThatWasChanged) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply")}, folder.file("s"));
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_task(o, 0, report);
  spoil_pack(folder.file("s"));
  const std::string text = refusal([&] { roam::merge_store(o, report); });
  EXPECT_NE(text.find("missing shards: 0, damaged shards: 1, in tasks 0 of 1;"), std::string::npos) << text;
  EXPECT_FALSE(fs::exists(folder.file("s") + "/CURRENT"));
  roam::build_task(o, 0, report);
  roam::merge_store(o, report);
  expect_whole(folder.file("s"));
}

TEST(StoreBuildResume, BuildsAPackAgainThatWasChanged) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply")}, folder.file("s"));
  roam::build_store(options({folder.file("a.ply")}, folder.file("whole")));
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_task(o, 0, report);
  spoil_pack(folder.file("s"));
  EXPECT_EQ(refusal([&] { EXPECT_EQ(roam::build_store(o).shards_built, 1U); }), "");
  expect_same(folder.file("whole"), folder.file("s"));
  // So does the build that made the pack itself.
  auto disturbed = options({folder.file("a.ply")}, folder.file("t"));
  bool spoilt = false;
  disturbed.progress = [&](const roam::StoreBuildProgress& p) {
    if (p.step == roam::StoreBuildProgress::Step::merge && !std::exchange(spoilt, true)) spoil_pack(folder.file("t"));
    return true;
  };
  report = roam::build_store(disturbed);
  EXPECT_TRUE(spoilt);
  EXPECT_EQ(report.shards_built, 1U) << "of one";
  expect_same(folder.file("whole"), folder.file("t"));
}

TEST(StoreBuildResume, KeepsNoRunsOfAnEarlierStateOfTheScene) {
  const TestFolder folder;
  write_ply(folder.file("b.ply"), field(30, 0.5, {100.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply"), folder.file("b.ply")}, folder.file("s"));
  std::uint32_t size = 60;
  const auto runs_after_a_change = [&] {
    write_ply(folder.file("a.ply"), field(--size, 0.5, {0.0, 0.0, 0.0}));
    roam::StoreBuildReport report;
    EXPECT_EQ(roam::plan_store(o, report), 1U);
    std::vector<std::string> runs = roam::store::files_in(folder.file("s"), "scratch/runs");
    std::sort(runs.begin(), runs.end());
    return runs;
  };
  const auto first = runs_after_a_change(), second = runs_after_a_change();
  EXPECT_EQ(first.size(), 2U);
  EXPECT_EQ(second.size(), 2U);
  EXPECT_NE(first, second);
  {
    const roam::store::ReadingSign sign(folder.file("s"));
    EXPECT_EQ(runs_after_a_change().size(), 3U) << "a share may be reading it";
  }
  EXPECT_EQ(runs_after_a_change().size(), 2U);
  roam::build_store(o);
  roam::build_store(options({folder.file("a.ply"), folder.file("b.ply")}, folder.file("fresh")));
  expect_same(folder.file("fresh"), folder.file("s"));
}

TEST(StoreBuildResume, KeepsNoShardsOfAnEarlierStateOfTheScene) {
  const TestFolder folder;
  // More than a shard, so that b has one of its own.
  write_ply(folder.file("b.ply"), field(600, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({folder.file("a.ply"), folder.file("b.ply")}, folder.file("s"));
  std::uint32_t size = 410;
  std::uint64_t tasks = 0;
  const auto plan_after_a_change = [&] {
    write_ply(folder.file("a.ply"), field(--size, 0.5, {5000.0, 0.0, 0.0}));
    roam::StoreBuildReport report;
    tasks = roam::plan_store(o, report);
    return report.shards;
  };
  const auto build = [&] {
    roam::StoreBuildReport report;
    for (std::uint64_t task = 0; task < tasks; ++task) roam::build_task(o, task, report);
  };
  const auto files = [&](const char* in) {
    std::vector<std::string> there = roam::store::files_in(folder.file("s"), in);
    std::sort(there.begin(), there.end());
    return there;
  };
  ASSERT_EQ(plan_after_a_change(), 2U);
  build();
  const auto shards = files("scratch/shards"), packs = files("packs");
  ASSERT_EQ(shards.size(), 2U);
  ASSERT_EQ(packs.size(), 2U);
  ASSERT_EQ(plan_after_a_change(), 2U);
  const auto kept = files("scratch/shards"), kept_packs = files("packs");
  ASSERT_EQ(kept.size(), 1U) << "the shard of b";
  ASSERT_EQ(kept_packs.size(), 1U);
  EXPECT_EQ(std::count(shards.begin(), shards.end(), kept[0]), 1);
  EXPECT_EQ(std::count(packs.begin(), packs.end(), kept_packs[0]), 1);
  build();
  EXPECT_EQ(files("packs").size(), 2U);
  // Packs that a manifest names stay.
  roam::StoreBuildReport report;
  roam::merge_store(o, report);
  const auto published = files("packs");
  ASSERT_EQ(plan_after_a_change(), 2U);
  build();
  EXPECT_EQ(files("packs").size(), 3U);
  ASSERT_EQ(plan_after_a_change(), 2U);
  EXPECT_EQ(files("packs"), published);
  roam::build_store(o);
  roam::build_store(options({folder.file("a.ply"), folder.file("b.ply")}, folder.file("fresh")));
  expect_same(folder.file("fresh"), folder.file("s"));
}

/// Writes a record of a shard that no plan names.
void write_former_shard(const std::string& store, const std::string& text) {
  std::ofstream(store + "/" + roam::store::shard_file(std::string(64, 'a'))) << text;
}

TEST(StoreBuildResume, RemovesDamagedShardsOfAnEarlierStateOfTheScene) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({scene}, folder.file("s"));
  ASSERT_FALSE(o.key) << "with a key it does not count as a shard";
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_task(o, 0, report);
  for (const char* text : {"", "{}", "no JSON"}) {
    write_former_shard(o.output, text);
    EXPECT_EQ(refusal([&] { EXPECT_EQ(roam::plan_store(o, report), 1U); }), "") << text;
    EXPECT_EQ(roam::store::files_in(o.output, "scratch/shards").size(), 1U) << text;
  }
  roam::build_store(o);
  roam::build_store(options({scene}, folder.file("fresh")));
  expect_same(folder.file("fresh"), folder.file("s"));
}

TEST(StoreBuildResume, KeepsAPackThatAShardOfAnEarlierStateSharesWithThePlan) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(50, 0.5, {0.0, 0.0, 0.0}));
  const auto o = options({scene}, folder.file("s"));
  roam::StoreBuildReport report;
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  roam::build_task(o, 0, report);
  const auto shards = roam::store::files_in(o.output, "scratch/shards"),
             packs = roam::store::files_in(o.output, "packs");
  ASSERT_EQ(shards.size(), 1U);
  ASSERT_EQ(packs.size(), 1U);
  std::ifstream in(o.output / shards[0]);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string key = fs::path(shards[0]).stem();
  ASSERT_NE(text.find(key), std::string::npos);
  write_former_shard(o.output, text.replace(text.find(key), key.size(), std::string(64, 'a')));
  ASSERT_EQ(roam::plan_store(o, report), 1U);
  EXPECT_EQ(roam::store::files_in(o.output, "scratch/shards"), shards);
  EXPECT_EQ(roam::store::files_in(o.output, "packs"), packs);
  EXPECT_EQ(roam::build_store(o).shards_built, 0U);
}

TEST(StoreBuildResume, StopsWhenTheCallerSaysSoAndGoesOnLater) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(300, 0.5, {0.0, 0.0, 0.0}));
  roam::build_store(options({scene}, folder.file("whole")));
  for (const auto step : {roam::StoreBuildProgress::Step::read, roam::StoreBuildProgress::Step::plan,
                          roam::StoreBuildProgress::Step::shards, roam::StoreBuildProgress::Step::merge}) {
    auto o = options({scene}, folder.file("s"));
    o.progress = [&](const roam::StoreBuildProgress& p) { return p.step != step; };
    EXPECT_THROW(roam::build_store(o), roam::Cancelled);
  }
  roam::build_store(options({scene}, folder.file("s")));
  expect_same(folder.file("whole"), folder.file("s"));
}

}  // namespace
