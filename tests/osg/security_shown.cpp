// What SECURITY.md shows to programs that read scenes with OpenSceneGraph themselves does what is said of it.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <osgDB/ReadFile>
#include <osgDB/Registry>

#include "hostile_scene.h"

namespace {

void close_the_door() {
#include "security.inc"
}

/// Reads a scene in a process of its own. Returns whether it gave anything.
bool read_elsewhere(const std::string& scene, bool closed) {
  const pid_t child = ::fork();
  if (child == 0) {
    if (closed) close_the_door();
    ::_exit(osgDB::readRefNodeFile(scene) != nullptr ? 0 : 1);
  }
  int status = -1;
  return ::waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
}

TEST(SecurityShown, KeepsAChildThatIsAProgramFromRunning) {
  const TestFolder folder;
  write_bait(folder.file(""), HOSTILE_PLUGIN);
  const std::string scene =
      folder.write("scene.osg", hostile_group({hostile_triangle("0"), proxy_of("evil.lua"), proxy_of("a.xyz")}));
  std::filesystem::current_path(folder.file(""));
  if (!read_elsewhere(scene, false) || marks_in(folder.file("")).empty()) {
    GTEST_SKIP() << "this OpenSceneGraph runs nothing of a scene anyway";
  }
  for (const std::string& mark : marks_in(folder.file(""))) std::filesystem::remove(folder.file(mark));
  // The rest of the scene is read.
  EXPECT_TRUE(read_elsewhere(scene, true)) << "is the plugin where the example says?";
  EXPECT_EQ(marks_in(folder.file("")), std::vector<std::string>());
}

}  // namespace
