// What the disk makes of a build: scratch that cannot be removed, folders that are not synced, files that may not be
// read.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <functional>

#include "store/files.h"
#include "store_builds.h"

namespace {

std::atomic<bool> removes_nothing{false};
std::atomic<int> syncs{0};

}  // namespace

// These take the place of the C library's in this program.
extern "C" int unlinkat(int folder, const char* file, int flags) noexcept {
  if (removes_nothing) {
    errno = EACCES;
    return -1;
  }
  return static_cast<int>(::syscall(SYS_unlinkat, folder, file, flags));
}
extern "C" int fsync(int fd) {
  ++syncs;
  return static_cast<int>(::syscall(SYS_fsync, fd));
}

namespace {

using namespace store_builds;

TEST(StoreBuildDisk, SaysWhatOfAPublishedBuildCouldNotBeRemoved) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(20, 1.0, {0.0, 0.0, 0.0}));
  const std::string store = folder.file("s");
  removes_nothing = true;
  const roam::StoreBuildReport report = roam::build_store(options({scene}, store));
  removes_nothing = false;
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find(store + "/scratch could not be removed"), std::string::npos) << report.notes[0];
  EXPECT_TRUE(fs::exists(store + "/scratch"));
  expect_whole(store);
  const roam::StoreBuildReport again = roam::build_store(options({scene}, store));
  EXPECT_TRUE(again.unchanged && again.notes.empty());
  EXPECT_FALSE(fs::exists(store + "/scratch"));
}

TEST(StoreBuildDisk, SaysWhatOfARepairCouldNotBeRemoved) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(20, 1.0, {0.0, 0.0, 0.0}));
  const std::string store = folder.file("s");
  roam::build_store(options({scene}, store));
  const auto pack = fs::directory_iterator(store + "/packs")->path();
  fs::resize_file(pack, fs::file_size(pack) - 1);
  removes_nothing = true;
  const roam::StoreBuildReport report = roam::repair_store(options({scene}, store));
  removes_nothing = false;
  EXPECT_EQ(report.shards_built, 1U);
  ASSERT_EQ(report.notes.size(), 1U);
  EXPECT_NE(report.notes[0].find(store + "/scratch could not be removed"), std::string::npos) << report.notes[0];
  expect_whole(store);
}

TEST(StoreBuildDisk, SyncsTheFolderAboveEachThatItMakes) {
  const TestFolder folder;
  syncs = 0;
  std::vector<roam::store::MadeFolder> made;
  static_cast<void>(roam::store::Folder::held_or_made(folder.file("a/b/c"), false, made));
  EXPECT_EQ(made.size(), 3U);
  EXPECT_TRUE(fs::is_directory(folder.file("a/b/c")));
  EXPECT_EQ(syncs, 3);
  static_cast<void>(roam::store::Folder::held_or_made(folder.file("a/b/c"), false, made));
  EXPECT_EQ(made.size(), 3U);
  EXPECT_EQ(syncs, 3);
}

TEST(StoreBuildDisk, AFileThatMayNotBeReadAsksForTheRightToReadIt) {
  const TestFolder folder;
  fs::permissions(folder.file(""), fs::perms::all);
  fs::permissions(folder.write("secret", "text"), fs::perms::none);
  constexpr uid_t nobody = 65534;
  const bool root = ::geteuid() == 0;
  if (root) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  const std::string text = refusal([&] { static_cast<void>(roam::store::read_file(folder.file(""), "secret", 100)); });
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_NE(text.find("right to read it"), std::string::npos) << text;
  EXPECT_EQ(text.find("write"), std::string::npos) << text;
}

/// Holds the lock of a store that names another process.
class HeldLock {
 public:
  HeldLock(const TestFolder& folder, pid_t named) {
    fs::create_directory(folder.file("s"));
    const std::string file = folder.write("s/LOCK", std::to_string(named) + "\n");
    descriptor_ = ::open(file.c_str(), O_RDWR | O_CLOEXEC);
    EXPECT_EQ(::flock(descriptor_, LOCK_EX | LOCK_NB), 0);
  }
  ~HeldLock() { end(); }
  HeldLock(const HeldLock&) = delete;
  HeldLock& operator=(const HeldLock&) = delete;
  void end() {
    if (descriptor_ >= 0) ::close(descriptor_);
    descriptor_ = -1;
  }

 private:
  int descriptor_ = -1;
};

pid_t ended_process() {
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  return ended;
}

TEST(StoreBuildDisk, WaitsForTheLockOfAProcessThatWasEndedWhileItStartedAnother) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(10, 1.0, {0.0, 0.0, 0.0}));
  const pid_t ended = ended_process();
  ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
  HeldLock held(folder, ended);
  // What it was starting holds the lock as it inherited it, for a moment: longer than a living holder is waited for.
  const pid_t started = ::fork();
  if (started == 0) {
    ::usleep(2'000'000);
    ::_exit(0);
  }
  held.end();
  EXPECT_EQ(refusal([&] { roam::build_store(options({scene}, folder.file("s"))); }), "");
  ::waitpid(started, nullptr, 0);
}

TEST(StoreBuildDisk, SaysThatTheHolderOfALockHasEndedAndAsksMeanwhileWhetherToGoOn) {
  const TestFolder folder;
  const std::string scene = write_ply(folder.file("a.ply"), field(10, 1.0, {0.0, 0.0, 0.0}));
  const pid_t ended = ended_process();
  ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
  const HeldLock held(folder, ended);
  auto asking = options({scene}, folder.file("s"));
  int asked = 0;
  asking.progress = [&](const roam::StoreBuildProgress&) { return ++asked > 0; };
  const std::string text = refusal([&] { roam::build_store(asking); });
  EXPECT_NE(text.find("still locked, though process " + std::to_string(ended)), std::string::npos) << text;
  EXPECT_GT(asked, 5);
  EXPECT_LT(asked, 150) << "50 ms each: one wait, not many";
  for (const auto& build : std::initializer_list<std::function<void()>>{[&] { roam::build_store(asking); },
                                                                        [&] {
                                                                          roam::StoreBuildReport report;
                                                                          roam::merge_store(asking, report);
                                                                        }}) {
    asked = 0;
    asking.progress = [&](const roam::StoreBuildProgress&) { return ++asked < 3; };
    EXPECT_THROW(build(), roam::Cancelled);
    EXPECT_EQ(asked, 3);
  }
}

TEST(StoreBuildDisk, TakesAProcessThatNobodyHasWaitedForForEnded) {
  const TestFolder folder;
  const pid_t ended = ended_process();
  siginfo_t how{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(ended), &how, WEXITED | WNOWAIT), 0);
  const HeldLock held(folder, ended);
  bool knows = false;
  try {
    const roam::store::BuildLock lock(folder.file("s"));
  } catch (const roam::store::LockedError& error) {
    knows = error.holder_ended;
  }
  EXPECT_TRUE(knows);
  ::waitpid(ended, nullptr, 0);
}

}  // namespace
