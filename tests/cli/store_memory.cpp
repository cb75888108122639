// The memory of a program that reads a store: --memory, and 25 MiB for itself and its libraries.
#include <gtest/gtest.h>

#include <fstream>
#include <random>

#include "store/files.h"
#include "store_builds.h"

// Instrumented programs take more, of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace {

using roam::Vec3;
namespace fs = std::filesystem;
using store_builds::field;
using store_builds::write_ply;

ProgramResult run(const std::vector<std::string>& arguments, const std::string& input = {}) {
  return run_program(ROAM_PROGRAM, arguments, {.input = input});
}

/// MiB of a program beside what --memory says.
constexpr long own = 25;

/// Three stores, made once: by the program, so that this process stays small.
class StoreMemory : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TestFolder;
    for (const char* kind : {"gallery", "terrain"}) {
      const std::string scene = folder_->file(std::string(kind) + ".ply");
      ASSERT_EQ(run({"make", kind, "-o", scene, "--triangles", kind[0] == 'g' ? "2M" : "3M"}).status, 0);
      const ProgramResult built = run({"build", scene, "-o", folder_->file(kind)});
      ASSERT_EQ(built.status, 0) << built.err;
    }
    std::vector<std::string> build{"build", "-o", folder_->file("parts")};
    for (std::uint32_t i = 0; i < 120; ++i) {
      const Vec3 corner(20.0 * (i % 12), 20.0 * (i / 12), 0.0);
      build.push_back(write_ply(folder_->file("part" + std::to_string(i) + ".ply"), field(20, 1.0, corner)));
    }
    const ProgramResult built = run(build);
    ASSERT_EQ(built.status, 0) << built.err;
    folder_->write("gallery.way", "-13739 253 182\n-12504 1566 182\n");
    folder_->write("terrain.way", "5 5 60\n500 500 60\n5 500 60\n");
    folder_->write("parts.way", "5 5 3\n235 195 3\n5 195 3\n");
  }
  static void TearDownTestSuite() { delete folder_; }

  /// Sweeps all over a store.
  static std::string queries(const Vec3& lower, const Vec3& upper) {
    std::mt19937 random(1);
    const auto between = [&](double a, double b) {
      return std::to_string(std::uniform_real_distribution(a, b)(random));
    };
    std::string rows;
    for (int i = 0; i < 200; ++i) {
      for (int k = 0; k < 3; ++k) rows += between(lower[k], upper[k]) + ',';
      for (int k = 0; k < 3; ++k) rows += between(-30.0, 30.0) + ',';
      rows += "0.3\n";
    }
    return rows;
  }

  static void check_verbs();
  static void check_all_that_a_walk_does_besides();
  static void check_text_files();
  static void check_long_walks();
  static void check_hostile_stores();

  static inline TestFolder* folder_ = nullptr;
};

// One test, because ctest runs each in a process of its own, which would make the stores again.
TEST_F(StoreMemory, IsWhatMemorySaysAndLittleMore) {
  check_verbs();
  check_all_that_a_walk_does_besides();
  check_text_files();
  check_long_walks();
  check_hostile_stores();
}

void StoreMemory::check_verbs() {
  const struct {
    const char* name;
    Vec3 lower, upper;
  } stores[] = {{"gallery", {-13739.0, 253.0, 182.0}, {-12504.0, 1566.0, 183.0}},
                {"terrain", {0.0, 0.0, 20.0}, {600.0, 600.0, 45.0}},
                {"parts", {0.0, 0.0, 1.0}, {240.0, 200.0, 4.0}}};
  for (const auto& store : stores) {
    const std::string folder = folder_->file(store.name);
    for (const long mebibytes : {8, 64, 200}) {
      const std::string memory = std::to_string(mebibytes) + "M";
      const ProgramResult walked =
          run({"walk", folder, "--path", folder + ".way", "--mode", "fly", "--speed", "60", "--memory", memory});
      const ProgramResult swept = run({"sweep", folder, "--memory", memory}, queries(store.lower, store.upper));
      ASSERT_EQ(walked.status, 0) << walked.err;
      ASSERT_EQ(swept.status, 0) << swept.err;
      for (const ProgramResult* r : {&walked, &swept}) {
        EXPECT_LE(r->peak, (mebibytes + own) << 10)
            << store.name << ' ' << memory << (r == &walked ? " walk" : " sweep");
        EXPECT_GE(r->peak, mebibytes << 10) << "this does not measure what it says";
      }
    }
    for (const char* verb : {"info", "verify"}) EXPECT_LE(run({verb, folder}).peak, 2 * own << 10) << verb;
  }
}

void StoreMemory::check_text_files() {
  const std::string store = folder_->file("gallery"), start = "-13739 253 182\n", way = start + "-12504 1566 182\n";
  const auto walk = [&](const std::string& path) {
    return run({"walk", store, "--path", path, "--mode", "fly", "--speed", "60", "--memory", "8M"});
  };
  // Line by line: the memory of this process counts as the child's before that runs roam.
  const auto write = [&](const char* name, const std::string& begin, const char* line, int lines,
                         const std::string& end) {
    std::ofstream file(folder_->file(name));
    file << begin;
    for (int i = 0; i < lines; ++i) file << line;
    file << end;
    return folder_->file(name);
  };
  const ProgramResult commented = walk(
      write("comments.way", "", "# a comment that is as long as comments are, and says nothing\n", 1'000'000, way));
  EXPECT_EQ(commented.status, 0) << commented.err;
  EXPECT_LE(commented.peak, (8 + own) << 10);
  // As docs/stores.md says.
  constexpr long of_a_path = 120, of_a_profile = 120;
  const ProgramResult placed = walk(write("places.way", "", start.c_str(), 999'998, way));
  EXPECT_EQ(placed.status, 0) << placed.err;
  EXPECT_LE(placed.peak, (8 + own + of_a_path) << 10);
  write("gallery.roam.json", R"({"roam_profile":1,"frame":{"up":"z","unit":"m"},"x":[0)", R"(,"abcdefghijklm")",
        999'900, "]}");
  const ProgramResult profiled = walk(folder_->file("gallery.way"));
  EXPECT_LE(profiled.peak, (8 + own + of_a_profile) << 10);
  EXPECT_GE(profiled.peak, of_a_profile << 9) << "this does not measure what it says";
  fs::remove(folder_->file("gallery.roam.json"));
}

void StoreMemory::check_all_that_a_walk_does_besides() {
  const std::string scene = folder_->file("gallery.ply"), drawing = folder_->file("way.svg");
  const std::vector<std::vector<std::string>> extras{{"--verify", "--picture", drawing},
                                                     {"--picture", folder_->file("way.png")}};
  for (const char* store : {"gallery", "terrain", "parts"}) {
    const std::string folder = folder_->file(store);
    for (const long mebibytes : {8, 64}) {
      const auto walk = [&](std::vector<std::string> call, const std::vector<std::string>& extra) {
        if (mebibytes == 8 && !extra.empty() && extra.back().ends_with(".png"))
          return;  // its pixels take more: docs/stores.md
        call.insert(call.end(), {"--memory", std::to_string(mebibytes) + "M"});
        call.insert(call.end(), extra.begin(), extra.end());
        const ProgramResult r = run(call);
        EXPECT_EQ(r.status, 0) << r.err;
        EXPECT_LE(r.peak, (mebibytes + own) << 10)
            << store << ' ' << mebibytes << "M " << call[2] << ' ' << (extra.empty() ? "" : extra.back());
      };
      walk({"walk", folder, "--wander", "5", "--height", "1.8"}, {});
      for (const auto& extra : extras) {
        walk({"walk", folder, "--wander", "5", "--height", "1.8"}, extra);
        walk({"walk", folder, "--path", folder + ".way", "--mode", "fly", "--speed", "60"}, extra);
      }
    }
  }
  const ProgramResult against = run({"walk", folder_->file("gallery"), "--path", folder_->file("gallery.way"), "--mode",
                                     "fly", "--speed", "60", "--against", scene});
  EXPECT_EQ(against.status, 0) << against.err;
  EXPECT_LE(against.peak, (64 + own) << 10) << "--against";
}

void StoreMemory::check_long_walks() {
  const std::string folder = folder_->file("parts");
  for (const char* extra : {"--verify", "--picture"}) {
    std::vector<std::string> call{"walk", folder, "--wander", "150", "--dt", "0.001", "--memory", "8M", extra};
    if (call.back() == "--picture") call.push_back(folder_->file("long.svg"));
    const ProgramResult r = run(call);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_LE(r.peak, (8 + own) << 10) << extra;
  }
}

void StoreMemory::check_hostile_stores() {
  const TestFolder hostile;
  const std::string store = hostile.file("s");
  fs::copy(folder_->file("parts"), store, fs::copy_options::recursive);
  for (const auto& [start, piece] :
       {std::pair<std::string, std::string>{"{\"x\": ", "["}, {"{\"notes\": [\"\"", ",\"\""}}) {
    roam::store::NewFile file(store, roam::store::manifest_file("new"));
    // Little by little: this process must stay small.
    std::string some;
    for (int i = 0; i < 10'000; ++i) some += piece;
    file.write(std::as_bytes(std::span(start)));
    while (file.size() < 50'000'000) file.write(std::as_bytes(std::span(some)));
    roam::store::write_file(store, "CURRENT", "roam store 1\n" + file.commit_by_hash() + "\n");
    for (const std::vector<std::string>& call :
         {std::vector<std::string>{"sweep", store, "--memory", "64M"},
          {"walk", store, "--path", folder_->file("parts.way"), "--memory", "64M"},
          {"probe", store, "--from=5,5,3", "--to=6,6,3"},
          {"info", store},
          {"verify", store}}) {
      const ProgramResult r = run(call);
      EXPECT_NE(r.status, 0) << call[0];
      const bool limited = call.back() == "64M";
      // Without --memory a manifest may take 256 MiB.
      EXPECT_LE(r.peak, ((limited ? 64 : 256) + own) << 10) << call[0] << r.err;
    }
  }
}

}  // namespace

#endif
