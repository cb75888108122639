// Builds whose machine loses its power: of all that was not synced, each part may be on the disk or not. The store is
// the old one, the new one or none, and the same command continues the build.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <mutex>
#include <optional>
#include <random>
#include <string>
#include <utility>

#include "killed_builds.h"

namespace {

using Inode = std::pair<dev_t, ino_t>;

Inode inode_of(int file) {
  struct stat status {};
  ::fstat(file, &status);
  return {status.st_dev, status.st_ino};
}

/// A disk that keeps its writes to itself until they are synced.
struct Disk {
  struct Rename {
    Inode folder_inode;
    int folder;
    std::string from, to;
    std::optional<std::string> replaced;  ///< the content that `to` had
  };

  std::mutex mutex;
  std::map<Inode, int> unsynced;  ///< files; opened anew, because a copied descriptor would keep their locks
  std::vector<Rename> renames;    ///< in folders that are not synced
  int calls = 0;
  int fatal_call = 0;  ///< the power goes before this one; 0: never
  std::minstd_rand random;

  void step() {
    if (++calls != fatal_call) return;
    for (const auto& [inode, file] : unsynced) {
      const auto size = ::lseek(file, 0, SEEK_END);
      if (const auto kept = random() % 3; kept < 2) static_cast<void>(!::ftruncate(file, size * off_t(kept) / 2));
    }
    for (auto it = renames.rbegin(); it != renames.rend(); ++it) {
      if (random() % 2 == 0) continue;
      ::syscall(SYS_renameat, it->folder, it->to.c_str(), it->folder, it->from.c_str());
      if (!it->replaced) continue;
      const int file = ::openat(it->folder, it->to.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
      ::syscall(SYS_write, file, it->replaced->data(), it->replaced->size());
    }
    ::kill(::getpid(), SIGKILL);
  }

  static std::optional<std::string> content(int folder, const char* name) {
    const int file = ::openat(folder, name, O_RDONLY);
    if (file < 0) return std::nullopt;
    std::string text(static_cast<std::size_t>(::lseek(file, 0, SEEK_END)), '\0');
    static_cast<void>(!::pread(file, text.data(), text.size(), 0));
    ::close(file);
    return text;
  }
};

/// Of a process that builds; none in the test itself.
Disk* disk = nullptr;

template <class Call>
auto written(int file, Call&& call) {
  if (disk == nullptr) return call();
  const std::lock_guard lock(disk->mutex);
  disk->step();
  if (const Inode inode = inode_of(file); !disk->unsynced.contains(inode)) {
    const int opened = ::open(("/proc/self/fd/" + std::to_string(file)).c_str(), O_RDWR);
    if (opened < 0) std::abort();
    disk->unsynced[inode] = opened;
  }
  return call();
}

}  // namespace

// These take the place of the C library's in this program.
extern "C" ssize_t write(int file, const void* bytes, std::size_t size) {
  return written(file, [&] { return static_cast<ssize_t>(::syscall(SYS_write, file, bytes, size)); });
}
extern "C" ssize_t pwrite(int file, const void* bytes, std::size_t size, off_t offset) {
  return written(file, [&] { return static_cast<ssize_t>(::syscall(SYS_pwrite64, file, bytes, size, offset)); });
}
extern "C" int fsync(int file) {
  if (disk == nullptr) return static_cast<int>(::syscall(SYS_fsync, file));
  const std::lock_guard lock(disk->mutex);
  disk->step();
  const Inode inode = inode_of(file);
  if (const auto it = disk->unsynced.find(inode); it != disk->unsynced.end()) {
    ::close(it->second);
    disk->unsynced.erase(it);
  }
  std::erase_if(disk->renames, [&](const Disk::Rename& it) {
    if (it.folder_inode != inode) return false;
    ::close(it.folder);
    return true;
  });
  return 0;
}
extern "C" int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  const auto call = [&] { return static_cast<int>(::syscall(SYS_renameat, from_folder, from, to_folder, to)); };
  if (disk == nullptr) return call();
  const std::lock_guard lock(disk->mutex);
  disk->step();
  disk->renames.push_back({inode_of(to_folder), ::dup(to_folder), from, to, Disk::content(to_folder, to)});
  return call();
}
extern "C" int unlinkat(int folder, const char* file, int flags) noexcept {
  if (disk != nullptr) {
    const std::lock_guard lock(disk->mutex);
    disk->step();
  }
  return static_cast<int>(::syscall(SYS_unlinkat, folder, file, flags));
}

namespace {

using namespace store_builds;

/// Runs in a process of its own, whose power goes at a call that changes the disk; returns its wait status, and writes
/// the number of calls into the file `count`, if any.
int on_a_disk(const std::function<void()>& work, int fatal_call = 0, int seed = 0, const std::string& count = {}) {
  return in_child([&] {
    disk = new Disk;
    disk->fatal_call = fatal_call;
    disk->random.seed(static_cast<unsigned>(seed + 1));
    work();
    const int calls = std::exchange(disk, nullptr)->calls;
    if (!count.empty()) std::ofstream(count) << calls;
  });
}

TEST(StoreBuildPower, ACutAtAnyStepLeavesTheOldStoreTheNewOrNone) {
  const ChangedScene changed;
  const auto build = [&] { changed.build(changed.output); };
  const int cuts = how_often("ROAM_TEST_CUTS", 30);
  int old_ones = 0, new_ones = 0;
  for (const bool updating : {false, true}) {
    changed.begin_again(updating);
    const std::string counted = changed.folder.file("count");
    ASSERT_EQ(on_a_disk(build, 0, 0, counted), 0);
    const int count = std::atoi(changed.folder.read("count").c_str());
    ASSERT_GT(count, 20);
    for (int i = 0; i < cuts; ++i) {
      changed.begin_again(updating);
      const int at = 1 + (count - 1) * i / (cuts - 1);
      SCOPED_TRACE((updating ? "update, call " : "call ") + std::to_string(at) + " of " + std::to_string(count));
      // The order of calls may differ from run to run, and so may their number.
      on_a_disk(build, at, i);
      if (updating || fs::exists(changed.output + "/CURRENT")) {
        const bool is_old = changed.is_old();
        EXPECT_TRUE(updating || !is_old);
        ++(is_old ? old_ones : new_ones);
      }
      ASSERT_EQ(on_a_disk(build), 0);
      expect_same(changed.updated, changed.output);
      if (HasFailure()) return;
    }
  }
  EXPECT_GT(old_ones, cuts / 4);
  EXPECT_GT(new_ones, 0);
}

}  // namespace
