#pragma once
/// Builds in processes of their own, which end at some moment, and a scene that changes between two builds.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <vector>

#include "store_builds.h"

namespace store_builds {

/// Runs in a process of its own; returns its wait status. A process that has threads cannot be forked again.
inline int in_child(const std::function<void()>& work) {
  const pid_t child = ::fork();
  if (child == 0) {
    int status = 0;
    try {
      work();
    } catch (const std::exception& e) {
      fprintf(stderr, "%s\n", e.what());
      status = 1;
    }
    ::_exit(status);
  }
  int status = 0;
  ::waitpid(child, &status, 0);
  return status;
}

/// How often a test disturbs a build: the environment variable, if it is set.
inline int how_often(const char* variable, int usually) {
  const char* text = std::getenv(variable);
  return text != nullptr ? std::atoi(text) : usually;
}

/// A scene of two files, the second of which has changed since `old` was built. `updated` is built of the new scene.
struct ChangedScene {
  TestFolder folder;
  std::vector<std::string> scene{write_ply(folder.file("a.ply"), field(60, 0.5, {0.0, 0.0, 0.0})),
                                 write_ply(folder.file("b.ply"), field(40, 0.5, {100.0, 0.0, 0.0}))};
  std::string old = folder.file("old"), updated = folder.file("updated"), output = folder.file("disturbed");

  ChangedScene() {
    EXPECT_EQ(in_child([&] { build(old); }), 0);
    write_ply(scene[1], field(50, 0.5, {100.0, 0.0, 0.0}));
    EXPECT_EQ(in_child([&] { build(updated); }), 0);
  }
  void build(const std::string& store) const { roam::build_store(options(scene, store)); }

  /// Makes `output` the old store, or nothing.
  void begin_again(bool updating) const {
    fs::remove_all(output);
    if (updating) fs::copy(old, output, fs::copy_options::recursive);
  }
  /// Whether `output` is the old store. Else it is the new one.
  [[nodiscard]] bool is_old() const {
    const auto triangles = [](const std::string& store) { return roam::Store::open(store)->info().triangles; };
    expect_whole(output);
    const bool old_one = triangles(output) == triangles(old);
    EXPECT_TRUE(old_one || triangles(output) == triangles(updated));
    return old_one;
  }
};

}  // namespace store_builds
