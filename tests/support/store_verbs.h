#pragma once
/// Shared by the tests of stores on the command line.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "messages.h"
#include "program.h"
#include "roam/generate.h"

namespace store_verbs {

namespace fs = std::filesystem;

inline ProgramResult run(const std::vector<std::string>& arguments, const std::string& input = {}) {
  return run_program(ROAM_PROGRAM, arguments, {.input = input});
}

/// A gallery, its store, and the straight way through it, cut short; made once.
class StoreVerbs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TestFolder;
    roam::generate::write_scene(roam::generate::gallery({.triangles = 60'000, .seed = 1}), scene());
    folder_->write("straight.path", "-13739 253 182\n-13639 359.3 182\n");
    const ProgramResult built = run({"build", scene()});
    ASSERT_EQ(built.status, 0) << built.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static std::string scene() { return folder_->file("gallery.ply"); }
  static std::string store() { return folder_->file("gallery.ply.roam"); }
  static std::string path() { return folder_->file("straight.path"); }
  /// A copy that a test may damage.
  static std::string copy(const TestFolder& folder) {
    fs::copy(store(), folder.file("copy.roam"), fs::copy_options::recursive);
    return folder.file("copy.roam");
  }
  static fs::path only_pack(const std::string& of) { return fs::directory_iterator(of + "/packs")->path(); }
  static void flip(const fs::path& file, std::streamoff at) {
    std::fstream bytes(file, std::ios::binary | std::ios::in | std::ios::out);
    bytes.seekg(at);
    const int was = bytes.get();
    bytes.seekp(at);
    bytes.put(static_cast<char>(was ^ 16));
  }

  static inline TestFolder* folder_ = nullptr;
};

}  // namespace store_verbs
