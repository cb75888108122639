#pragma once
/// \file
/// Files that a test writes, imports and removes, and the scenes in the folder of test data.

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "roam/import.h"

namespace roam::test {

/// A folder of its own, removed with its contents.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "roam-import-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    path_ = pattern;
  }
  ~TemporaryFolder() {
    std::error_code none;
    std::filesystem::remove_all(path_, none);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  /// Writes a file and the folders above it. Returns its path.
  std::filesystem::path write(const std::string& name, std::string_view content) const {
    const std::filesystem::path file = path_ / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return file;
  }
  /// Writes a shell script.
  std::filesystem::path write_script(const std::string& name, const std::string& commands) const {
    const std::filesystem::path file = write(name, "#!/bin/sh\n" + commands);
    std::filesystem::permissions(file, std::filesystem::perms::owner_all);
    return file;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Child processes of this process, whichever thread started them.
inline std::vector<pid_t> children_of_this_process() {
  std::vector<pid_t> all;
  for (const auto& thread : std::filesystem::directory_iterator("/proc/self/task")) {
    std::ifstream children(thread.path() / "children");
    for (pid_t child = 0; children >> child;) all.push_back(child);
  }
  return all;
}

/// All triangles of a scene in order, by their corners.
inline std::vector<Triangle> triangles_of(const ImportedScene& scene) {
  std::vector<Triangle> all;
  for (const Mesh& mesh : scene.meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) all.push_back(mesh.triangle(i));
  }
  return all;
}

inline Box bounds_of(const ImportedScene& scene) {
  Box box;
  for (const Triangle& triangle : triangles_of(scene)) {
    for (const Vec3& corner : triangle) box.include(corner);
  }
  return box;
}

/// The message of the Error that importing throws; empty if it throws none.
inline std::string import_error(const std::filesystem::path& path, const ImportOptions& options = {}) {
  try {
    const ImportedScene scene = import_scene(path, options);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

inline bool contains(const std::string& text, std::string_view part) { return text.find(part) != std::string::npos; }

/// Whether one of the report's sentences contains this text.
inline bool notes_contain(const ImportedScene& scene, std::string_view part) {
  for (const std::string& note : scene.report.notes) {
    if (contains(note, part)) return true;
  }
  return false;
}

/// The bytes of a value as a file holds them.
template <class T>
std::string bytes_of(T value, bool big_endian = false) {
  std::string bytes(sizeof(T), '\0');
  std::memcpy(bytes.data(), &value, sizeof(T));
  return big_endian ? std::string(bytes.rbegin(), bytes.rend()) : bytes;
}

/// The folder of the test scenes; empty if there is none.
inline std::filesystem::path test_data() {
  const char* named = std::getenv("ROAM_TEST_DATA");
  const std::filesystem::path folder = named != nullptr ? named : "";
  std::error_code none;
  return std::filesystem::is_directory(folder, none) ? folder : std::filesystem::path();
}

}  // namespace roam::test

/// Skips the test, by name, if there are no scenes.
#define ROAM_NEEDS_TEST_DATA() \
  if (roam::test::test_data().empty()) GTEST_SKIP() << "set ROAM_TEST_DATA to the folder of test scenes"
