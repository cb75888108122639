// The folder of a store is replaced by a link while it is built into: nothing is done where the link leads.

#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <set>

#include "store_builds.h"

namespace {

/// Calls that change the disk. Before the n-th one this happens; 0: never.
std::atomic<int> calls{0}, meddled_call{0};
std::function<void()> meddle;

void count() {
  if (++calls == meddled_call) meddle();
}

}  // namespace

// These take the place of the C library's in this program.
extern "C" int fsync(int fd) {
  count();
  return static_cast<int>(::syscall(SYS_fsync, fd));
}
extern "C" int renameat(int from_folder, const char* from, int to_folder, const char* to) noexcept {
  count();
  return static_cast<int>(::syscall(SYS_renameat, from_folder, from, to_folder, to));
}
extern "C" int unlinkat(int folder, const char* file, int flags) noexcept {
  count();
  return static_cast<int>(::syscall(SYS_unlinkat, folder, file, flags));
}

namespace {

using namespace store_builds;

TEST(StoreBuildReplaced, WhatTakesThePlaceOfItsFolderIsNotTouched) {
  const TestFolder folder;
  write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0}));
  write_ply(folder.file("b.ply"), field(20, 0.5, {0.0, 0.0, 0.0}));
  write_ply(folder.file("empty.ply"), roam::Mesh{"", {{0, 0, 0}}, {}});
  const std::string theirs = folder.file("theirs"), output = folder.file("s"), aside = folder.file("aside");
  roam::build_store(options({folder.file("b.ply")}, theirs));
  for (const char* name : {"/LOCK", "/sources.json"}) fs::remove(theirs + name);
  // Of the names of what a builder removes.
  for (const char* file : {"/scratch/plan.json", "/CURRENT.1.0.unfinished"}) {
    fs::create_directories(fs::path(theirs + file).parent_path());
    std::ofstream(theirs + file) << "precious";
  }
  const auto all = [&] {
    std::set<std::string> names;
    for (const auto& entry : fs::recursive_directory_iterator(theirs)) names.insert(entry.path());
    return std::pair(names, content(theirs));
  };
  const auto before = all();
  meddle = [&] {
    fs::rename(output, aside);
    fs::create_directory_symlink(theirs, output);
  };
  for (const char* scene : {"a.ply", "empty.ply"}) {
    auto o = options({folder.file(scene)}, output);
    o.key.emplace();
    o.through_link = false;
    const auto build = [&](int at) {
      fs::remove_all(output);
      fs::remove_all(aside);
      calls = 0;
      meddled_call = at;
      static_cast<void>(refusal([&] { roam::build_store(o); }));
      meddled_call = 0;
    };
    build(0);
    const int last = calls;
    ASSERT_GT(last, 2);
    constexpr int samples = 12;
    for (int i = 0; i < samples; ++i) {
      build(1 + (last - 1) * i / (samples - 1));
      EXPECT_TRUE(all() == before) << scene << ": call " << 1 + (last - 1) * i / (samples - 1) << " of " << last;
    }
  }
}

}  // namespace
