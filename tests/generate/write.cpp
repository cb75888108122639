// Made scenes as files: what is written reads back, and what is not finished is not there.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

#include "roam/error.h"
#include "roam/generate.h"

namespace roam::generate {
namespace {

namespace fs = std::filesystem;

class GenerateWrite : public ::testing::Test {
 protected:
  void SetUp() override {
    std::string pattern = (fs::temp_directory_path() / "roam-write-XXXXXX").string();
    ASSERT_NE(::mkdtemp(pattern.data()), nullptr);
    folder_ = pattern;
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] fs::path file(const char* name) const { return folder_ / name; }
  [[nodiscard]] std::size_t files() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator()));
  }

  fs::path folder_;
  const Scene scene_ = gallery({.triangles = 20'000, .seed = 11});
};

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

template <class T>
T take(const char*& at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  at += sizeof value;
  return value;
}

TEST_F(GenerateWrite, PlyReadsBackBitByBit) {
  write_scene(scene_, file("gallery.ply"));
  const std::string data = contents(file("gallery.ply"));
  const std::size_t end = data.find("end_header\n");
  ASSERT_NE(end, std::string::npos);
  const std::string header = data.substr(0, end);
  EXPECT_NE(header.find("format binary_little_endian 1.0\n"), std::string::npos);
  EXPECT_NE(header.find("element vertex " + std::to_string(scene_.vertices()) + "\n"), std::string::npos);
  EXPECT_NE(header.find("element face " + std::to_string(scene_.triangles()) + "\n"), std::string::npos);
  const std::size_t body = end + std::strlen("end_header\n");
  ASSERT_EQ(data.size(), body + scene_.vertices() * 24 + scene_.triangles() * 13);
  const char* vertex = data.data() + body;
  const char* face = vertex + scene_.vertices() * 24;
  std::uint32_t first = 0;
  for (const Mesh& m : collect(scene_)) {
    for (const Vec3& p : m.vertices) {
      for (int k = 0; k < 3; ++k) ASSERT_EQ(take<double>(vertex), p[k]);
    }
    for (const auto& t : m.triangles) {
      ASSERT_EQ(take<std::uint8_t>(face), 3);
      for (const std::uint32_t i : t) ASSERT_EQ(take<std::uint32_t>(face), first + i);
    }
    first += static_cast<std::uint32_t>(m.vertices.size());
  }
}

TEST_F(GenerateWrite, ObjReadsBackBitByBitWithNames) {
  write_scene(scene_, file("gallery.OBJ"));
  std::istringstream in(contents(file("gallery.OBJ")));
  std::string word;
  std::getline(in, word);
  EXPECT_EQ(word[0], '#');
  std::uint64_t first = 1;
  for (const Mesh& m : collect(scene_)) {
    in >> word;
    ASSERT_EQ(word, "o");
    in >> word;
    ASSERT_EQ(word, m.name);
    for (const Vec3& p : m.vertices) {
      in >> word;
      ASSERT_EQ(word, "v");
      for (int k = 0; k < 3; ++k) {
        in >> word;
        ASSERT_EQ(std::strtod(word.c_str(), nullptr), p[k]) << word;
      }
    }
    for (const auto& t : m.triangles) {
      in >> word;
      ASSERT_EQ(word, "f");
      for (const std::uint32_t i : t) {
        in >> word;
        ASSERT_EQ(std::stoull(word), first + i);
      }
    }
    first += m.vertices.size();
  }
  EXPECT_FALSE(in >> word);
}

TEST_F(GenerateWrite, StlHoldsTheNearestFloatsAndOutwardNormals) {
  write_scene(scene_, file("gallery.stl"));
  const std::string data = contents(file("gallery.stl"));
  ASSERT_EQ(data.size(), 84 + 50 * scene_.triangles());
  const char* at = data.data() + 80;
  EXPECT_EQ(take<std::uint32_t>(at), scene_.triangles());
  for (const Mesh& m : collect(scene_)) {
    for (std::size_t i = 0; i < m.triangles.size(); ++i) {
      Vec3 normal;
      for (int k = 0; k < 3; ++k) normal[k] = take<float>(at);
      const Triangle t = m.triangle(i);
      for (const Vec3& p : t) {
        for (int k = 0; k < 3; ++k) ASSERT_EQ(take<float>(at), static_cast<float>(p[k]));
      }
      at += 2;
      const Vec3 a = t[1] - t[0], b = t[2] - t[0];
      const Vec3 n{a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
      ASSERT_GT(n.x * normal.x + n.y * normal.y + n.z * normal.z, 0.0);
      ASSERT_NEAR(normal.x * normal.x + normal.y * normal.y + normal.z * normal.z, 1.0, 1e-5);
    }
  }
}

TEST_F(GenerateWrite, StlIsRefusedWhereFloatsLoseMoreThanAMillimetre) {
  const Scene far = gallery({.triangles = 10'000, .origin = {500'000.0, 0.0, 0.0}});
  EXPECT_THROW(write_scene(far, file("far.stl")), Error);
  EXPECT_EQ(files(), 0u);
  EXPECT_NO_THROW(write_scene(far, file("far.ply")));
}

TEST_F(GenerateWrite, UnknownExtensionsAndMissingFoldersAreRefusedByName) {
  for (const char* name : {"gallery.xyz", "gallery", "missing/gallery.ply"}) {
    try {
      write_scene(scene_, file(name));
      ADD_FAILURE() << name;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(file(name).string()), std::string::npos) << e.what();
    }
  }
  EXPECT_EQ(files(), 0u);
}

TEST_F(GenerateWrite, CancellingLeavesWhatWasThere) {
  std::ofstream(file("gallery.ply")) << "precious";
  for (const char* name : {"gallery.ply", "new.obj", "new.stl"}) {
    std::uint64_t calls = 0;
    EXPECT_THROW(write_scene(scene_, file(name), [&](std::uint64_t) { return ++calls < 10; }), Cancelled);
    EXPECT_EQ(calls, 10u);
  }
  EXPECT_EQ(contents(file("gallery.ply")), "precious");
  EXPECT_EQ(files(), 1u);
}

TEST_F(GenerateWrite, AFullDiskIsAnErrorThatLeavesNothing) {
  // A limit on the size of files stands for the full disk: the write fails in the same place.
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  rlimit small = before;
  small.rlim_cur = 100'000;
  const auto old = std::signal(SIGXFSZ, SIG_IGN);
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  for (const char* name : {"a.ply", "a.obj", "a.stl"}) EXPECT_THROW(write_scene(scene_, file(name)), Error) << name;
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &before), 0);
  std::signal(SIGXFSZ, old);
  EXPECT_EQ(files(), 0u);
}

TEST_F(GenerateWrite, ProgressCountsUpToTheWhole) {
  std::uint64_t last = 0;
  write_scene(scene_, file("gallery.ply"), [&](std::uint64_t done) {
    EXPECT_GT(done, last);
    last = done;
    return true;
  });
  EXPECT_EQ(last, scene_.triangles());
}

}  // namespace
}  // namespace roam::generate
