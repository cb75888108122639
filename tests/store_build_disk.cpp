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
  roam::store::make_folder(folder.file("a/b/c"));
  EXPECT_TRUE(fs::is_directory(folder.file("a/b/c")));
  EXPECT_EQ(syncs, 3);
  roam::store::make_folder(folder.file("a/b/c"));
  EXPECT_EQ(syncs, 3);
}

TEST(StoreBuildDisk, AFileThatMayNotBeReadAsksForTheRightToReadIt) {
  const TestFolder folder;
  fs::permissions(folder.file(""), fs::perms::all);
  const std::string file = folder.write("secret", "text");
  fs::permissions(file, fs::perms::none);
  constexpr uid_t nobody = 65534;
  const bool root = ::geteuid() == 0;
  if (root) {
    ASSERT_EQ(::seteuid(nobody), 0);
  }
  const std::string text = refusal([&] { static_cast<void>(roam::store::read_file(file, 100)); });
  if (root) {
    ASSERT_EQ(::seteuid(0), 0);
  }
  EXPECT_NE(text.find("right to read it"), std::string::npos) << text;
  EXPECT_EQ(text.find("write"), std::string::npos) << text;
}

TEST(StoreBuildDisk, WaitsForTheLockOfAProcessThatWasEndedWhileItStartedAnother) {
  const TestFolder folder;
  const pid_t ended = ::fork();
  if (ended == 0) ::_exit(0);
  ASSERT_EQ(::waitpid(ended, nullptr, 0), ended);
  // What it was starting holds the lock as it inherited it, for a moment.
  const std::string file = folder.write("LOCK", std::to_string(ended) + "\n");
  const int descriptor = ::open(file.c_str(), O_RDWR);
  ASSERT_EQ(::flock(descriptor, LOCK_EX | LOCK_NB), 0);
  const pid_t started = ::fork();
  if (started == 0) {
    ::usleep(300'000);
    ::_exit(0);
  }
  ::close(descriptor);
  EXPECT_EQ(refusal([&] { const roam::store::BuildLock lock(folder.file("")); }), "");
  ::waitpid(started, nullptr, 0);
}

}  // namespace
