#pragma once
/// Scenes, builds and comparisons shared by the tests of the builder.

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include "program.h"
#include "roam/generate.h"
#include "roam/store.h"
#include "roam/store_build.h"

namespace store_builds {

namespace fs = std::filesystem;

/// A binary PLY of doubles, or of floats.
template <class Number = double>
std::string write_ply(const std::string& file, const std::vector<roam::Vec3>& vertices,
                      const std::vector<std::array<std::uint32_t, 3>>& triangles) {
  const char* type = sizeof(Number) == 8 ? "double" : "float";
  std::string text = "ply\nformat binary_little_endian 1.0\nelement vertex " + std::to_string(vertices.size());
  for (const char* axis : {"x", "y", "z"}) text += std::string("\nproperty ") + type + " " + axis;
  text +=
      "\nelement face " + std::to_string(triangles.size()) + "\nproperty list uchar uint vertex_indices\nend_header\n";
  for (const roam::Vec3& v : vertices) {
    const Number n[3] = {static_cast<Number>(v.x), static_cast<Number>(v.y), static_cast<Number>(v.z)};
    text.append(reinterpret_cast<const char*>(n), sizeof n);
  }
  for (const auto& t : triangles) {
    text.push_back(3);
    text.append(reinterpret_cast<const char*>(t.data()), sizeof t);
  }
  std::ofstream(file, std::ios::binary) << text;
  return file;
}

inline std::string write_ply(const std::string& file, const roam::Mesh& mesh) {
  return write_ply(file, mesh.vertices, mesh.triangles);
}

/// A wavy field of n * n * 2 triangles, `cell` m each, beginning at `corner`.
inline roam::Mesh field(std::uint32_t n, double cell, const roam::Vec3& corner) {
  roam::Mesh mesh;
  for (std::uint32_t y = 0; y <= n; ++y) {
    for (std::uint32_t x = 0; x <= n; ++x) {
      // A relief of whole numbers, the same on every machine.
      const double z = double((x * 7919U ^ y * 104729U) % 64U) * cell / 64.0;
      mesh.vertices.push_back(corner + roam::Vec3(x * cell, y * cell, z));
    }
  }
  const auto at = [n](std::uint32_t x, std::uint32_t y) { return y * (n + 1) + x; };
  for (std::uint32_t y = 0; y < n; ++y) {
    for (std::uint32_t x = 0; x < n; ++x) {
      mesh.triangles.push_back({at(x, y), at(x + 1, y), at(x, y + 1)});
      mesh.triangles.push_back({at(x + 1, y), at(x + 1, y + 1), at(x, y + 1)});
    }
  }
  return mesh;
}

/// The files of a store: those that its manifest names, the manifest and CURRENT. Not the lock, and not the saved state
/// of the scene's files.
inline std::map<std::string, std::string> content(const std::string& store) {
  std::map<std::string, std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(store)) {
    if (!entry.is_regular_file()) continue;
    const std::string name = entry.path().lexically_relative(store).string();
    if (name == "LOCK" || name == "sources.json") continue;
    std::ifstream in(entry.path(), std::ios::binary);
    files[name] = {std::istreambuf_iterator<char>(in), {}};
  }
  return files;
}

inline std::vector<std::string> names(const std::map<std::string, std::string>& files) {
  std::vector<std::string> list;
  for (const auto& [name, bytes] : files) list.push_back(name);
  return list;
}

inline void expect_same(const std::string& a, const std::string& b) {
  const auto first = content(a), second = content(b);
  EXPECT_EQ(names(first), names(second));
  EXPECT_TRUE(first == second) << a << " and " << b << " differ";
}

/// Changes a byte of a pack.
inline void spoil_pack(const std::string& store) {
  std::fstream file(fs::directory_iterator(store + "/packs")->path(), std::ios::in | std::ios::out | std::ios::binary);
  file.seekp(500);
  file.put('?');
}

inline roam::StoreBuildOptions options(const std::vector<std::string>& scene, const std::string& output) {
  roam::StoreBuildOptions o;
  o.scene.assign(scene.begin(), scene.end());
  o.output = output;
  return o;
}

template <class Call>
std::string refusal(Call&& call) {
  try {
    call();
  } catch (const roam::Error& e) {
    return e.what();
  }
  return "";
}

inline void expect_whole(const std::string& store) {
  const roam::StoreVerification v = roam::verify_store(store);
  for (const auto& damage : v.damage) ADD_FAILURE() << damage.what << ": " << damage.why;
  EXPECT_GT(v.tiles, 0U);
}

}  // namespace store_builds
