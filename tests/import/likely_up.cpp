// The axis that is likely to be up is named where level faces show it, and nothing is said where they do not.
#include "import/likely_up.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

#include "import_files.h"
#include "roam/generate.h"

namespace roam {
namespace {

/// A position with z up, as a file whose `up` points up has it.
Vec3 in_file(UpAxis up, const Vec3& p) {
  const auto rows = SceneFrame{.up = up}.to_file();
  Vec3 q(0.0);
  for (int k = 0; k < 3; ++k) {
    const auto& row = rows[static_cast<std::size_t>(k)];
    q[k] = row[0] * p.x + row[1] * p.y + row[2] * p.z;
  }
  return q;
}

void add_quad(Mesh& mesh, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), {a, b, c, d});
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

/// A room of this size, seen from inside, and a table in it of which only the top is known.
Mesh room(const Vec3& s, bool table = true) {
  Mesh mesh;
  add_quad(mesh, {0, 0, 0}, {s.x, 0, 0}, {s.x, s.y, 0}, {0, s.y, 0});
  add_quad(mesh, {0, 0, s.z}, {0, s.y, s.z}, {s.x, s.y, s.z}, {s.x, 0, s.z});
  add_quad(mesh, {0, 0, 0}, {0, 0, s.z}, {s.x, 0, s.z}, {s.x, 0, 0});
  add_quad(mesh, {0, s.y, 0}, {s.x, s.y, 0}, {s.x, s.y, s.z}, {0, s.y, s.z});
  add_quad(mesh, {0, 0, 0}, {0, s.y, 0}, {0, s.y, s.z}, {0, 0, s.z});
  add_quad(mesh, {s.x, 0, 0}, {s.x, 0, s.z}, {s.x, s.y, s.z}, {s.x, s.y, 0});
  if (table) add_quad(mesh, {1, 1, 0.7}, {4, 1, 0.7}, {4, 3, 0.7}, {1, 3, 0.7});
  return mesh;
}

/// Hills, open below.
Mesh hills() {
  Mesh mesh;
  const auto height = [](int i, int j) { return 2.0 * std::sin(0.7 * i) * std::cos(0.6 * j); };
  for (int i = 0; i < 20; ++i) {
    for (int j = 0; j < 20; ++j) {
      const auto at = [&](int a, int b) { return Vec3(4.0 * a, 4.0 * b, height(a, b)); };
      add_quad(mesh, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return mesh;
}

std::optional<UpAxis> verdict(Mesh mesh, UpAxis up) {
  for (Vec3& v : mesh.vertices) v = in_file(up, v);
  return likely_up({&mesh, 1});
}

TEST(LikelyUp, IsTheAxisOfFloorsAndThings) {
  for (const Mesh& mesh : {room({8, 6, 2.5}), hills()}) {
    for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::minus_x, UpAxis::minus_y}) {
      const auto found = verdict(mesh, up);
      ASSERT_TRUE(found) << to_string(up);
      EXPECT_STREQ(to_string(*found), to_string(up));
    }
    EXPECT_FALSE(verdict(mesh, UpAxis::z));
    EXPECT_FALSE(verdict(mesh, UpAxis::minus_z)) << "that is never said";
  }
}

TEST(LikelyUp, IsNotDoubtedOfWhatStandsUpright) {
  for (const Mesh& mesh : {room({8, 6, 2.5}), hills()}) {
    for (const UpAxis up : {UpAxis::x, UpAxis::y, UpAxis::z, UpAxis::minus_y, UpAxis::minus_z}) {
      Mesh turned = mesh;
      for (Vec3& v : turned.vertices) v = in_file(up, v);
      EXPECT_EQ(stands_upright({&turned, 1}), up == UpAxis::z) << to_string(up);
    }
  }
  EXPECT_FALSE(stands_upright({}));
}

TEST(LikelyUp, IsNotSaidWithoutReason) {
  for (const UpAxis up : {UpAxis::y, UpAxis::z}) {
    EXPECT_FALSE(verdict(room({8, 6, 2.5}, false), up)) << "which end is the floor?";
    EXPECT_FALSE(verdict(room({40, 2, 6}), up)) << "a narrow corridor";
    EXPECT_FALSE(verdict(room({5, 5, 5}), up)) << "a cube";
    Mesh wall;
    add_quad(wall, {0, 0, 0}, {8, 0, 0}, {8, 0, 3}, {0, 0, 3});
    EXPECT_FALSE(verdict(wall, up)) << "a plane";
    EXPECT_FALSE(verdict({}, up));
  }
  Mesh degenerate;
  add_quad(degenerate, {1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  EXPECT_FALSE(likely_up({&degenerate, 1}));
}

TEST(LikelyUp, IsNotSaidOfMadeScenes) {
  EXPECT_FALSE(likely_up(generate::collect(generate::gallery({.triangles = 50'000}))));
  EXPECT_FALSE(likely_up(generate::collect(generate::terrain({.triangles = 50'000}))));
  EXPECT_FALSE(likely_up(generate::collect(generate::city({.triangles = 50'000}))));
}

TEST(LikelyUp, IsLeftToFormatsThatStateIt) {
  for (const char* file : {"a.glb", "a.GLTF", "a.dae", "a.fbx", "a.ifc"}) EXPECT_TRUE(states_up(file)) << file;
  for (const char* file : {"a.obj", "a.ply", "a.stl", "a.osgb"}) EXPECT_FALSE(states_up(file)) << file;
  const test::TemporaryFolder files;
  EXPECT_TRUE(states_up(files.path())) << "a folder of OSGB tiles";
  files.write("tileset.json", "{}");
  EXPECT_FALSE(states_up(files.path()));
}

}  // namespace
}  // namespace roam
