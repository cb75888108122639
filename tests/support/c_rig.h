#pragma once
/// \file
/// Scenes behind handles of the C interface, and the same in C++.

#include <gtest/gtest.h>

#include <fstream>
#include <string>
#include <vector>

#include "clutter.h"
#include "roam/roam.h"
#include "roam/world.h"
#include "store_made.h"

namespace c_rig {

inline roam_vec3 of(const roam::Vec3& v) { return {v.x, v.y, v.z}; }

inline roam_query of(const roam::Query& query) {
  roam_query result{};
  result.size = sizeof result;
  result.from = of(query.from);
  result.motion = of(query.motion);
  result.radius = query.body.radius;
  result.half_height = query.body.half_height;
  return result;
}

inline roam_mesh of(const roam::Mesh& mesh) {
  roam_mesh result{};
  result.size = sizeof result;
  result.name = mesh.name.c_str();
  result.vertices = &mesh.vertices[0].x;
  result.vertex_count = mesh.vertices.size();
  result.triangles = mesh.triangles[0].data();
  result.triangle_count = mesh.triangles.size();
  return result;
}

inline roam_space* built(const std::vector<roam::Mesh>& meshes) {
  std::vector<roam_mesh> all;
  for (const roam::Mesh& mesh : meshes) all.push_back(of(mesh));
  roam_space* world = nullptr;
  if (roam_world_build(all.data(), all.size(), nullptr, &world) != ROAM_OK) throw roam::Error(roam_error());
  return world;
}

/// Clutter with random queries of spheres, capsules and points.
struct Scene {
  explicit Scene(std::uint64_t seed, int count = 2000) {
    clutter::Random random(seed);
    const roam::Mesh mesh = clutter::make(random, {});
    world = roam::World::build({&mesh, 1});
    handle = built({mesh});
    for (int i = 0; i < count; ++i) {
      const roam::Body body{i % 5 == 0 ? 0.0 : random.between(0.0, 0.5), i % 3 == 0 ? random.between(0.0, 1.0) : 0.0};
      queries.push_back({body, random.in_box(6.0), random.between(0.0, 8.0) * random.direction(), nullptr});
    }
  }
  ~Scene() { roam_space_free(handle); }
  Scene(const Scene&) = delete;
  Scene& operator=(const Scene&) = delete;

  roam::World world;
  roam_space* handle = nullptr;
  std::vector<roam::Query> queries;
};

/// A floor of 9 m by 9 m, and a wall 3 m high along x = 5.
inline std::vector<roam::Mesh> room_meshes() {
  return {{"floor", {{0, -4, 0}, {9, -4, 0}, {9, 5, 0}, {0, 5, 0}}, {{0, 1, 2}, {0, 2, 3}}},
          {"wall", {{5, -4, 0}, {5, 5, 0}, {5, 5, 3}, {5, -4, 3}}, {{0, 1, 2}, {0, 2, 3}}}};
}

struct Room {
  Room() : handle(built(room_meshes())) {}
  ~Room() { roam_space_free(handle); }
  Room(const Room&) = delete;
  Room& operator=(const Room&) = delete;

  /// The room as an OBJ file.
  [[nodiscard]] std::string file(const std::string& name) const {
    const std::string path = (folder.path() / name).string();
    std::ofstream out(path);
    std::size_t first = 1;
    for (const roam::Mesh& mesh : room_meshes()) {
      out << "o " << mesh.name << '\n';
      for (const roam::Vec3& v : mesh.vertices) out << "v " << v.x << ' ' << v.y << ' ' << v.z << '\n';
      for (const auto& t : mesh.triangles)
        out << "f " << first + t[0] << ' ' << first + t[1] << ' ' << first + t[2] << '\n';
      first += mesh.vertices.size();
    }
    return path;
  }

  roam_space* handle;
  made::Folder folder{"c_room"};
};

#define EXPECT_SAME_VEC(a, b) EXPECT_TRUE((a).x == (b).x && (a).y == (b).y && (a).z == (b).z)

inline void expect_same(const roam_impact& impact, const roam::Impact& expected) {
  EXPECT_EQ(impact.hit != 0, expected.hit);
  EXPECT_EQ(impact.time, expected.time);
  EXPECT_EQ(impact.gap, expected.distance);
  EXPECT_SAME_VEC(impact.point, expected.point);
  EXPECT_SAME_VEC(impact.normal, expected.normal);
  EXPECT_EQ(impact.triangle, expected.triangle);
  EXPECT_EQ(impact.object, expected.object);
  EXPECT_EQ(impact.unknown != 0, expected.unknown);
  EXPECT_EQ(impact.feature, static_cast<int>(expected.feature));
}

}  // namespace c_rig
