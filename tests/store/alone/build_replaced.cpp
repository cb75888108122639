// The folder of a store is replaced by a link while it is built into: nothing is done where the link leads.

#include <dirent.h>
#include <dlfcn.h>
#include <gtest/gtest.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <functional>
#include <set>

#include "store_builds.h"

namespace {

/// Calls that change the disk, and ends of looking into a folder. Before the n-th one this happens; 0: never.
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
extern "C" int closedir(DIR* folder) {
  count();
  static const auto next = reinterpret_cast<int (*)(DIR*)>(::dlsym(RTLD_NEXT, "closedir"));
  return next(folder);
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

/// Builds an empty scene and another one into `output` with `meddle` before each call in turn. `prepare` puts all back.
void build_at_each_call(const TestFolder& folder, const std::string& output, const std::function<void()>& prepare,
                        const std::function<void(const std::string&)>& look) {
  write_ply(folder.file("a.ply"), field(20, 0.5, {0.0, 0.0, 0.0}));
  write_ply(folder.file("empty.ply"), roam::Mesh{"", {{0, 0, 0}}, {}});
  for (const char* scene : {"a.ply", "empty.ply"}) {
    auto o = options({folder.file(scene)}, output);
    o.key.emplace();
    const auto build = [&](int at) {
      prepare();
      calls = 0;
      meddled_call = at;
      static_cast<void>(refusal([&] { roam::build_store(o); }));
      meddled_call = 0;
      return calls.load();
    };
    const int last = build(0);
    ASSERT_GT(last, 10);
    for (int at = 1; at <= std::min(last, 20); ++at) {
      build(at);
      look(std::string(scene) + ": call " + std::to_string(at) + " of " + std::to_string(last));
    }
  }
}

TEST(StoreBuildReplaced, AFolderThatTookItsPlaceBeforeItWasOpenedIsLookedAt) {
  const TestFolder folder;
  const std::string theirs = folder.file("theirs"), output = folder.file("s"), aside = folder.file("aside");
  for (const char* file : {"/notes.txt", "/packs/x", "/CURRENT.1.0.unfinished"}) {
    fs::create_directories(fs::path(theirs + file).parent_path());
    std::ofstream(theirs + file) << "precious";
  }
  const auto before = content(theirs);
  meddle = [&] {
    fs::rename(output, aside);
    fs::create_directory_symlink(theirs, output);
  };
  build_at_each_call(
      folder, output,
      [&] {
        fs::remove_all(output);
        fs::remove_all(aside);
        fs::create_directory(output);
      },
      [&](const std::string& when) {
        EXPECT_TRUE(content(theirs) == before) << when;
        EXPECT_FALSE(fs::exists(theirs + "/manifests") || fs::exists(theirs + "/LOCK")) << when;
        fs::remove_all(theirs + "/manifests");
        fs::remove(theirs + "/LOCK");
      });
}

TEST(StoreBuildReplaced, AFileOrALinkInThePlaceOfAFolderThatWasMadeStays) {
  const TestFolder folder;
  const std::string above = folder.file("new"), aside = folder.file("aside");
  for (const bool link : {false, true}) {
    meddle = [&] {
      if (!fs::exists(above)) return;
      fs::rename(above, aside);
      if (link) {
        fs::create_symlink("elsewhere", above);
      } else {
        std::ofstream(above) << "precious";
      }
    };
    build_at_each_call(
        folder, above + "/s",
        [&] {
          fs::remove_all(above);
          fs::remove_all(aside);
        },
        [&](const std::string& when) {
          EXPECT_TRUE(!fs::exists(aside) || fs::exists(fs::symlink_status(above))) << when;
        });
  }
}

}  // namespace
