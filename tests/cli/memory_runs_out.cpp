// Where memory runs out, each verb says so and ends with status 1, or does all its work. What it writes is whole.
// ROAM_TEST_FAILURES=N: tries N allocations of each verb (default: 10), each alone and with all that follow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <string>
#include <vector>

#include "messages.h"
#include "program.h"
#include "web_servers.h"

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
namespace {

namespace fs = std::filesystem;

struct VerbCase {
  const char* name;
  const char* arguments;  ///< in the folder of a run
};

const std::string room =
    "v 0 0 0\nv 10 0 0\nv 10 10 0\nv 0 10 0\nv 0 0 3\nv 10 0 3\nv 10 10 3\nv 0 10 3\n"
    "f 1 2 3\nf 1 3 4\nf 1 2 6\nf 1 6 5\nf 3 4 8\nf 3 8 7\nf 2 3 7\nf 2 7 6\nf 4 1 5\nf 4 5 8\n";

std::string without_times(const std::string& report) {
  static const std::regex time(R"re([0-9.]+ m?s\b|"(median|p99|max)": [0-9.e+-]+)re");
  return std::regex_replace(report, time, "T");
}

class MemoryRunsOut : public testing::Test {
 protected:
  struct Ended {
    ProgramResult result;
    std::map<std::string, std::string> files;  ///< by their names; without those that only an unfinished build has
    long allocations = 0;
  };

  void SetUp() override {
    given_.write("room.obj", room);
    given_.write("way.path", "# roam: mode walk radius 0.25 height 1.7 eye 1.5 step 0.3 slope 45\n2 2 1\n8 8 1\n");
    given_.write("sizes.txt", "0.2x1.8                          # so wide and high\n0.3x1.8\n");
    given_.write("queries.csv", "1,1,1,2,0,0,0.3\n");
    given_.write("settings.json", R"({"quality": "full", "keys": {"jump": "j"}})");
    for (const char* const arguments :
         {"build room.obj -o room.roam", "walk room.obj --path way.path --certify walk.cert",
          "build room.obj -o hurt.roam"})
      ASSERT_EQ(run(given_.file(""), arguments).status, 0);
    for (const auto& entry : fs::recursive_directory_iterator(given_.file("hurt.roam"))) {
      if (entry.path().extension() == ".pack") fs::resize_file(entry.path(), fs::file_size(entry.path()) / 2);
    }
  }

  /// Runs the program with `environment` in front of it.
  [[nodiscard]] static ProgramResult run(const std::string& folder, const std::string& arguments,
                                         const std::string& environment = "") {
    const std::string home = "cd " + folder + " && HOME=$PWD/home XDG_DATA_HOME=$PWD/home XDG_CONFIG_HOME=$PWD/home ";
    return run_program("/bin/sh", {"-c", home + environment + " exec " ROAM_PROGRAM " " + arguments});
  }

  /// Runs the verb in a new folder.
  [[nodiscard]] Ended run_with(const std::string& arguments, const std::string& failing) const {
    const TestFolder folder;
    fs::copy(given_.file(""), folder.file(""), fs::copy_options::recursive);
    Ended ended;
    ended.result = run(folder.file(""), arguments,
                       "LD_PRELOAD=" FAILING_ALLOCATIONS " FAILING_PROGRAM=roam FAILING_COUNT=count " + failing);
    for (const auto& entry : fs::recursive_directory_iterator(folder.file(""))) {
      const std::string name = fs::relative(entry.path(), folder.file("")).string();
      if (!entry.is_regular_file() || name == "count" || name.starts_with("home/")) continue;
      if (contains(name, "/scratch/") || name.ends_with("/LOCK") || name.ends_with("/sources.json")) continue;
      ended.files[name] = folder.read(name);
    }
    const std::string count = folder.read("count");
    ended.allocations = std::atol(count.c_str());
    return ended;
  }

  /// Runs the verb without a failure, and then again and again.
  void try_all(const std::string& arguments, bool loads_tiles = false) const {
    const Ended good = run_with(arguments, "");
    ASSERT_EQ(good.result.status, 0) << good.result.err;
    // Nearly all before that are of the options of all verbs. Their number varies by some hundreds from run to run.
    const long first = std::min(run_with("--version", "").allocations, good.allocations) - 300;
    ASSERT_GT(first, 1000);
    const char* const wanted = std::getenv("ROAM_TEST_FAILURES");
    const long tries = wanted != nullptr ? std::atol(wanted) : 10;
    long failures = 0;
    for (long i = 0; i < tries; ++i) {
      const long at = i == 0 ? first / 2 : first + i * (good.allocations - first) / tries;
      for (const char* const on : {"", " FAILING_ON=1"}) {
        const std::string failing = "FAILING_AT=" + std::to_string(at) + on;
        SCOPED_TRACE(failing);
        const Ended ended = run_with(arguments, failing);
        failures += i > 0 && ended.result.status != 0 ? 1 : 0;
        expect_right(ended, good, loads_tiles);
        if (HasFailure()) return;
      }
    }
    EXPECT_GT(failures, 0);
  }

  void expect_right(const Ended& ended, const Ended& good, bool loads_tiles) const {
    // A tile of a store that could not be loaded was solid, and the report says so.
    const bool went_without = loads_tiles && contains(ended.result.out, "no memory left");
    if (ended.result.status == 0) {
      EXPECT_TRUE(went_without || without_times(ended.result.out) == without_times(good.result.out))
          << ended.result.out;
      EXPECT_EQ(ended.files.size(), good.files.size());
    } else {
      EXPECT_TRUE(ended.result.status == 1 || (went_without && ended.result.status == 3))
          << ended.result.status << ended.result.out;
      EXPECT_TRUE(went_without || contains(ended.result.err, "memory")) << ended.result.err;
    }
    for (const auto& [name, text] : ended.files) {
      const auto same = good.files.find(name);
      ASSERT_NE(same, good.files.end()) << name;
      const bool as_before = fs::exists(given_.file(name)) && text == given_.read(name);
      EXPECT_TRUE(same->second == text || as_before) << name << " is neither whole nor as before";
    }
    for (const auto& [name, whole] : good.files) {
      EXPECT_TRUE(ended.files.contains(name) || !fs::exists(given_.file(name))) << name << " is lost";
    }
  }

  const TestFolder given_;
};
class VerbWithoutMemory : public MemoryRunsOut, public testing::WithParamInterface<VerbCase> {};

TEST_P(VerbWithoutMemory, SaysSoOrDoesItsWork) { try_all(GetParam().arguments); }

TEST_F(MemoryRunsOut, WithAStoreOnAWebServer) {
  const support::Misbehaving server(given_.file(""));
  try_all("walk " + server.address("good", "room.roam") + " --path way.path", true);
}

INSTANTIATE_TEST_SUITE_P(
    Verbs, VerbWithoutMemory,
    testing::Values(VerbCase{"info", "info room.obj"},
                    VerbCase{"walk", "walk room.obj --path way.path --certify new.cert --trace t.csv --verify"},
                    VerbCase{"json", "walk room.obj --path way.path --json"},
                    VerbCase{"svg", "walk room.obj --path way.path --picture p.svg"},
                    VerbCase{"dxf", "walk room.obj --path way.path --picture p.dxf"},
                    VerbCase{"png", "walk room.obj --path way.path --picture p.png"},
                    VerbCase{"probe", "probe room.obj --from 2,2,1 --to 8,8,1 --matrix sizes.txt"},
                    VerbCase{"sweep", "sweep room.obj < queries.csv"}, VerbCase{"train", "train room.obj"},
                    VerbCase{"make", "make city --triangles 10000 -o new.ply"},
                    VerbCase{"build", "build room.obj -o new.roam"}, VerbCase{"verify", "verify room.roam"},
                    VerbCase{"repair", "verify hurt.roam --repair room.obj"},
                    VerbCase{"check", "check walk.cert room.obj"}, VerbCase{"publish", "publish room.roam web"},
                    VerbCase{"settings", "view --settings settings.json --keys"}),
    [](const auto& verb) { return verb.param.name; });

}  // namespace
#endif
