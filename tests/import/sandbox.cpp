// A reader that was taken over by its file: what it tries is stopped, and reported.

#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <string>
#include <vector>

#include "import_files.h"
#include "roam/import.h"
#include "sanitizer.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

/// The newest Landlock, the one of Debian 12, and none.
class ImportSandbox : public testing::TestWithParam<int> {
 protected:
  void SetUp() override {
    folder_.write("scene/victim", "");
    folder_.write("neighbour", "");
    const auto script = folder_.write_script(
        "reader.sh", "exec '" MISBEHAVING_READER "' --highest-landlock " + std::to_string(GetParam()) + " \"$@\"\n");
    options_.reader = script;
  }
  /// What importing says when the reader is taken over by a file that says `deed`.
  std::string error_of(const std::string& deed) {
    const fs::path scene = folder_.write("scene/scene.obj", deed);
    folder_.write("scene/scene.obj.new.victim", "precious");
    return import_error(scene, options_);
  }
  /// Nothing was made beside the files that this test made, and nothing changed.
  void expect_untouched(const std::string& deed) {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder_.path() / "scene")) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    EXPECT_EQ(names, (std::vector<std::string>{"scene.obj", "scene.obj.new.victim", "victim"})) << deed;
    EXPECT_EQ(fs::file_size(folder_.path() / "scene/scene.obj.new.victim"), 8u) << deed;
  }

  const TemporaryFolder folder_;
  ImportOptions options_;
};

TEST_P(ImportSandbox, EndsAReaderThatDoesWhatNoSceneNeeds) {
  ASSERT_TRUE(reader_confinement().system_calls) << "this kernel has no seccomp";
  for (const char* deed :
       {"exec",    "fork",     "vfork",  "socket", "local-socket", "write",   "overwrite",   "append",
        "unnamed", "truncate", "unlink", "rename", "link",         "symlink", "mkdir",       "chmod",
        "signal",  "code",     "clone",  "thread", "trace",        "ring",    "memory-file", "times"}) {
    const std::string error = error_of(deed);
    EXPECT_TRUE(contains(error, "scene.obj: made its reader try something that no scene needs")) << deed << error;
    expect_untouched(deed);
  }
}

TEST_P(ImportSandbox, RefusesMoreRights) {
  for (const char* deed : {"more-time", "signal-by-descriptor"}) {
    EXPECT_TRUE(contains(error_of(deed), "was refused")) << deed;
  }
}

TEST_P(ImportSandbox, KeepsAReaderToTheScenesFolder) {
  EXPECT_EQ(error_of("scene"), "scene was done");
  for (const char* deed : {"secret", "neighbour", "list", "proc"}) {
    const std::string error = error_of(deed);
    // Without Landlock nothing but roam's own checks says which files are read.
    EXPECT_EQ(error, std::string(deed) + (GetParam() > 0 ? " was refused: Permission denied" : " was done"));
  }
}

TEST_P(ImportSandbox, EndsAReaderThatTakesMemory) {
  ROAM_NEEDS_PLAIN_MEMORY();
  options_.memory_limit = 64u << 20;
  EXPECT_TRUE(contains(error_of("memory"), "memory was refused: Cannot allocate memory"));
}

TEST_P(ImportSandbox, KeepsNoDescriptorOfTheProgramThatStartsIt) {
  for (const char* kernel : {"", "--no-close-range"}) {
    options_.reader = folder_.write_script(
        "inherit.sh", std::string("exec 9< /etc/passwd; exec '" MISBEHAVING_READER "' ") + kernel + " \"$@\"\n");
    EXPECT_EQ(error_of("inherited"), "inherited was refused: Bad file descriptor") << kernel;
  }
}

INSTANTIATE_TEST_SUITE_P(HighestLandlock, ImportSandbox, testing::Values(1 << 20, 2, 0));

/// A kernel, or a container, without seccomp.
class ImportSandboxWithoutSeccomp : public ImportSandbox {
 protected:
  void SetUp() override {
    ImportSandbox::SetUp();
    options_.reader = folder_.write_script("reader.sh", "exec '" MISBEHAVING_READER "' --no-seccomp \"$@\"\n");
  }
};

TEST_P(ImportSandboxWithoutSeccomp, StillKeepsAReaderToTheScenesFolder) {
  if (reader_confinement().landlock < 3) GTEST_SKIP() << "this kernel has no Landlock that knows truncation";
  for (const char* deed : {"secret", "neighbour", "list", "proc", "write", "overwrite", "append", "unnamed", "truncate",
                           "unlink", "rename", "link", "symlink", "mkdir"}) {
    EXPECT_TRUE(contains(error_of(deed), std::string(deed) + " was refused: ")) << error_of(deed);
    expect_untouched(deed);
  }
  EXPECT_EQ(error_of("scene"), "scene was done");
}

INSTANTIATE_TEST_SUITE_P(Kernel, ImportSandboxWithoutSeccomp, testing::Values(1 << 20));

/// What the kernel says of a reader that waits: the value behind a name in /proc/PID/status.
std::string status_of(pid_t process, const std::string& name) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string word; status >> word;) {
    if (word == name + ":" && status >> word) return word;
  }
  return "";
}

TEST(ImportSandboxRights, AreNoneOfRootAndTheFirstToGoWhereMemoryRunsOut) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.reader = MISBEHAVING_READER;
  bool walled = false;
  options.progress = [&](const ImportProgress&) {
    const std::vector<pid_t> children = children_of_this_process();
    if (children.size() != 1 || status_of(children.front(), "Seccomp") != "2") return true;
    walled = true;
    for (const char* set : {"CapInh", "CapPrm", "CapEff", "CapBnd", "CapAmb"}) {
      // Only root may take rights from the set that bounds them, and only for root do they come back.
      if (geteuid() != 0 && set == std::string("CapBnd")) continue;
      EXPECT_EQ(status_of(children.front(), set), "0000000000000000") << set;
    }
    int score = 0;
    std::ifstream("/proc/" + std::to_string(children.front()) + "/oom_score_adj") >> score;
    EXPECT_EQ(score, 1000);
    return false;
  };
  EXPECT_THROW(static_cast<void>(import_scene(folder.write("scene.obj", "drip"), options)), Cancelled);
  EXPECT_TRUE(walled);
}

TEST(ImportSandboxTime, EndsAReaderThatComputesWithoutEnd) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.reader = MISBEHAVING_READER;
  options.silence_limit = 1000;  // on a busy machine 12 s of processor take long
  // What it read counts although it says nothing after it has opened the file: 3 s for each 10^6 bytes.
  const std::string error = import_error(folder.write("scene.obj", "loop\n" + std::string(3'999'995, 'x')), options);
  EXPECT_TRUE(contains(error, "scene.obj: its reader computed for more than 12 s on 4000000 bytes")) << error;
}

TEST(ImportSandboxTime, EndsAReaderThatSpeaksAndNeverGetsDone) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.reader = MISBEHAVING_READER;
  options.silence_limit = 0.5;
  const std::string error = import_error(folder.write("scene.obj", "drip"), options);
  EXPECT_TRUE(contains(error, "scene.obj: its reader did not get done in 3 s, for ")) << error;
}

TEST(ImportSandboxReport, SaysWhichWallsHold) {
  const TemporaryFolder folder;
  const auto scene = folder.write("scene.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  const Confinement here = reader_confinement();
  EXPECT_TRUE(here.no_new_privileges && here.limits != has_sanitizer && here.empty_folder);
  for (const int highest : {0, 2}) {
    ImportOptions options;
    options.reader = folder.write_script(
        "reader.sh", "exec '" ROAM_READER_PROGRAM "' --highest-landlock " + std::to_string(highest) + " \"$@\"\n");
    const ImportedScene read = import_scene(scene, options);
    ASSERT_TRUE(read.report.confinement);
    EXPECT_EQ(read.report.confinement->landlock, std::min(here.landlock, highest));
    EXPECT_EQ(read.report.confinement->system_calls, here.system_calls);
    EXPECT_EQ(read.report.triangles, 1u);
  }
  EXPECT_EQ(import_scene(scene).report.confinement->landlock, here.landlock);
}

TEST(ImportSandboxReport, GivesAReaderNothingOfTheEnvironment) {
  const TemporaryFolder folder;
  ImportOptions options;
  options.reader = folder.write_script("reader.sh", "env >&2; pwd >&2; exit 5\n");
  setenv("OSG_LIBRARY_PATH", "/tmp", 1);
  setenv("LD_LIBRARY_PATH", ":.:relative:/absolute", 1);
  const std::string error = import_error(folder.write("scene.obj", ""), options);
  unsetenv("OSG_LIBRARY_PATH");
  unsetenv("LD_LIBRARY_PATH");
  EXPECT_TRUE(contains(error, "its last words: /)")) << error;
  options.reader = folder.write_script("words.sh", "env | tr '\\n' ' ' >&2; exit 5\n");
  setenv("LD_LIBRARY_PATH", ":.:relative:/absolute", 1);
  const std::string words = import_error(folder.write("scene.obj", ""), options);
  unsetenv("LD_LIBRARY_PATH");
  EXPECT_TRUE(contains(words, "LD_LIBRARY_PATH=/absolute ")) << words;
  EXPECT_FALSE(contains(words, "OSG_") || contains(words, "HOME=") || contains(words, "relative")) << words;
}

}  // namespace
}  // namespace roam::test
