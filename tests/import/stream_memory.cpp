// A scene that is larger than the memory that may be used streams all the same, and the bound is kept.

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>
#include <string>
#include <vector>

#include "import_files.h"
#include "sanitizer.h"

namespace roam::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t least_limit = 64u << 20;

/// Bytes of the line of /proc/PID/status that begins with `what`; 0 when the process is gone.
std::uint64_t memory_of(const std::string& pid, const std::string& what) {
  std::ifstream status("/proc/" + pid + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with(what)) return std::strtoull(line.c_str() + what.size() + 1, nullptr, 10) << 10;
  }
  return 0;
}

/// The most memory that the readers of this process had.
class Watch {
 public:
  void look() {
    for (const pid_t reader : children_of_this_process()) {
      most_ = std::max(most_, memory_of(std::to_string(reader), "VmHWM"));
    }
    here_ = std::max(here_, memory_of("self", "VmRSS"));
  }
  [[nodiscard]] std::uint64_t of_reader() const { return most_; }
  /// What this process took while it was watched.
  [[nodiscard]] std::uint64_t here() const { return here_ - before_; }

 private:
  std::uint64_t most_ = 0;
  std::uint64_t before_ = memory_of("self", "VmRSS"), here_ = before_;
};

/// A strip of squares: vertex i and its place.
Vec3 place_of(std::uint64_t i) {
  return {static_cast<double>(i / 2), static_cast<double>(i % 2), static_cast<double>(i % 1021) / 1021.0};
}

/// Corners of triangle i of the strip, by the numbers that `number` gives its vertices.
template <class Number>
std::array<std::uint64_t, 3> corners_of(std::uint64_t i, Number&& number) {
  return {number(i), number(i + 1), number(i + 2)};
}

/// A file in the making that need not fit the memory.
class Out {
 public:
  explicit Out(const fs::path& path) : file_(path, std::ios::binary) {}
  void text(const std::string& text) { file_.write(text.data(), static_cast<std::streamsize>(text.size())); }
  template <class T>
  void raw(const T& value) {
    file_.write(reinterpret_cast<const char*>(&value), sizeof(T));
  }

 private:
  std::ofstream file_;
};

fs::path write_ply(const fs::path& path, std::uint64_t triangles, std::uint64_t stride) {
  const std::uint64_t vertices = triangles + 2;
  Out out(path);
  out.text("ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices) +
           "\nproperty double x\nproperty double y\nproperty double z\nelement face " + std::to_string(triangles) +
           "\nproperty list uchar uint vertex_indices\nend_header\n");
  // Vertex number n is the strip's vertex n * stride: neighbours in the strip lie far apart in the file.
  for (std::uint64_t n = 0; n < vertices; ++n) out.raw(place_of(n * stride % vertices));
  std::vector<std::uint32_t> number(vertices);
  for (std::uint64_t n = 0; n < vertices; ++n) number[n * stride % vertices] = static_cast<std::uint32_t>(n);
  for (std::uint64_t i = 0; i < triangles; ++i) {
    out.raw(std::uint8_t{3});
    for (const std::uint64_t corner : corners_of(i, [&](std::uint64_t n) { return number[n]; })) {
      out.raw(static_cast<std::uint32_t>(corner));
    }
  }
  return path;
}

/// All vertices, then all faces, as exporters write it.
fs::path write_obj(const fs::path& path, std::uint64_t triangles) {
  Out out(path);
  for (std::uint64_t i = 0; i < triangles + 2; ++i) {
    const Vec3 v = place_of(i);
    out.text("v " + std::to_string(v.x) + " " + std::to_string(v.y) + " 0\n");
  }
  for (std::uint64_t i = 0; i < triangles; ++i) {
    out.text("f " + std::to_string(i + 1) + " " + std::to_string(i + 2) + " " + std::to_string(i + 3) + "\n");
  }
  return path;
}

fs::path write_stl(const fs::path& path, std::uint64_t triangles) {
  Out out(path);
  out.text(std::string(80, ' '));
  out.raw(static_cast<std::uint32_t>(triangles));
  for (std::uint64_t i = 0; i < triangles; ++i) {
    for (int k = 0; k < 3; ++k) out.raw(0.0f);
    for (const std::uint64_t corner : corners_of(i, [](std::uint64_t n) { return n; })) {
      const Vec3 v = place_of(corner);
      for (int k = 0; k < 3; ++k) out.raw(k < 2 ? static_cast<float>(v[k]) : 0.0f);
    }
    out.raw(std::uint16_t{0});
  }
  return path;
}

/// Streams a strip in the least memory and expects its triangles; returns what the watch saw.
Watch expect_strip(const fs::path& path, std::uint64_t triangles, bool level) {
  Watch watch;
  std::uint64_t next = 0, wrong = 0, pieces = 0;
  const auto sink = [&](const Mesh& piece, bool continues) {
    EXPECT_EQ(continues, next > 0);
    for (std::size_t i = 0; i < piece.triangles.size(); ++i, ++next) {
      const Triangle triangle = piece.triangle(i);
      for (std::size_t k = 0; k < 3; ++k) {
        Vec3 expected = place_of(next + k);
        if (level) expected.z = 0.0;
        wrong += triangle[k] != expected;
      }
    }
    if (pieces++ % 4 == 0) watch.look();
  };
  const ImportReport report = stream_scene(std::span(&path, 1), {.memory_limit = least_limit}, sink);
  EXPECT_EQ(report.triangles, triangles);
  EXPECT_EQ(next, triangles);
  EXPECT_EQ(wrong, 0u);
  return watch;
}

void expect_bound_kept(const Watch& watch) {
  if (has_sanitizer) return;
  EXPECT_GT(watch.of_reader(), 0u);
  EXPECT_LE(watch.of_reader() + watch.here(), least_limit)
      << (watch.of_reader() >> 20) << " MiB of the reader, " << (watch.here() >> 20) << " MiB here";
}

TEST(ImportStreamMemory, IsBoundedForPly) {
  const TemporaryFolder folder;
  constexpr std::uint64_t triangles = 5'000'000;  // with 120 MB of vertices
  expect_bound_kept(expect_strip(write_ply(folder.path() / "strip.ply", triangles, 1), triangles, false));
}

TEST(ImportStreamMemory, IsBoundedForObj) {
  const TemporaryFolder folder;
  constexpr std::uint64_t triangles = 4'000'000;
  expect_bound_kept(expect_strip(write_obj(folder.path() / "strip.obj", triangles), triangles, true));
}

TEST(ImportStreamMemory, IsBoundedForStl) {
  const TemporaryFolder folder;
  constexpr std::uint64_t triangles = 4'000'000;
  expect_bound_kept(expect_strip(write_stl(folder.path() / "strip.stl", triangles), triangles, true));
}

TEST(ImportStreamMemory, IsBoundedForFoldersOfTiles) {
  ROAM_NEEDS_TEST_DATA();
  // A real tile and its pages under many names: at once they would take several times the memory.
  const fs::path real = test_data() / "pit_osgb/Data/Tile_+000_+000";
  const TemporaryFolder folder;
  constexpr int tiles = 12;
  for (int i = 0; i < tiles; ++i) {
    const std::string name = "Tile_" + std::to_string(i);
    const fs::path copy = folder.path() / "Data" / name;
    fs::create_directories(copy);
    for (const auto& entry : fs::directory_iterator(real)) {
      const bool root = entry.path().stem() == real.filename();
      fs::create_symlink(entry.path(), copy / (root ? fs::path(name + ".osgb") : entry.path().filename()));
    }
  }
  Watch watch;
  std::uint64_t triangles = 0, pieces = 0;
  const auto sink = [&](const Mesh& piece, bool) {
    triangles += piece.triangles.size();
    if (pieces++ % 16 == 0) watch.look();
  };
  const ImportReport report =
      stream_scene(std::span(&folder.path(), 1), {.memory_limit = least_limit, .allow = {real}}, sink);
  EXPECT_EQ(triangles, tiles * 177'950u);
  EXPECT_EQ(report.missing_pages, 0u);
  expect_bound_kept(watch);
}

TEST(ImportStreamMemory, NeedsNoOrderOfTheVertices) {
  const TemporaryFolder folder;
  constexpr std::uint64_t triangles = 1'000'000;
  // Far enough apart that neighbours share no block, and prime to the number of vertices.
  constexpr std::uint64_t stride = 370'003;
  expect_bound_kept(expect_strip(write_ply(folder.path() / "scattered.ply", triangles, stride), triangles, false));
}

TEST(ImportStreamMemory, KeepsWhatDoesNotFitInTheFolderForTemporaryFiles) {
  const TemporaryFolder folder;
  const fs::path file = write_ply(folder.path() / "strip.ply", 1'500'000, 1);
  const char* before = std::getenv("TMPDIR");
  const std::string kept = before == nullptr ? "" : before;
  setenv("TMPDIR", (folder.path() / "none").c_str(), 1);
  std::string error;
  try {
    stream_scene(std::span(&file, 1), {.memory_limit = least_limit}, [](const Mesh&, bool) {});
  } catch (const Error& refused) {
    error = refused.what();
  }
  // With memory enough it needs none.
  std::uint64_t triangles = 0;
  stream_scene(std::span(&file, 1), {.memory_limit = 4 * least_limit},
               [&](const Mesh& piece, bool) { triangles += piece.triangles.size(); });
  if (before == nullptr) {
    unsetenv("TMPDIR");
  } else {
    setenv("TMPDIR", kept.c_str(), 1);
  }
  EXPECT_TRUE(contains(error, (folder.path() / "none").string())) << error;
  EXPECT_TRUE(contains(error, "TMPDIR")) << error;
  EXPECT_TRUE(contains(error, "No such file or directory. Make that folder, or name another by ")) << error;
  EXPECT_EQ(triangles, 1'500'000u);
  // Nothing that has a name is left, whether it went well or not.
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(ImportStreamMemory, RefusesWhatAForeignReaderCannotHold) {
  const TemporaryFolder folder;
  constexpr std::uint64_t triangles = 400'000;
  const fs::path file = folder.path() / "strip.off";
  {
    Out out(file);
    out.text("OFF\n" + std::to_string(triangles + 2) + " " + std::to_string(triangles) + " 0\n");
    for (std::uint64_t i = 0; i < triangles + 2; ++i) {
      out.text(std::to_string(i / 2) + " " + std::to_string(i % 2) + " 0\n");
    }
    for (std::uint64_t i = 0; i < triangles; ++i) {
      out.text("3 " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n");
    }
  }
  std::uint64_t streamed = 0;
  const auto sink = [&](const Mesh& piece, bool) { streamed += piece.triangles.size(); };
  if (!has_sanitizer) {
    try {
      stream_scene(std::span(&file, 1), {.memory_limit = least_limit}, sink);
      ADD_FAILURE() << "it fitted";
    } catch (const Error& error) {
      EXPECT_TRUE(contains(error.what(), "needs more than the 0.0625 GiB of memory")) << error.what();
    }
  }
  streamed = 0;
  stream_scene(std::span(&file, 1), {.memory_limit = 8 * least_limit}, sink);
  EXPECT_EQ(streamed, triangles);
}

}  // namespace
}  // namespace roam::test
