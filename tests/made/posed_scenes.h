#pragma once
/// \file
/// Scenes with moving parts, and their triangles in their poses, for brute force.

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "clutter.h"
#include "roam/instances.h"
#include "walker_scenes.h"

namespace posed {

using roam::Instances;
using roam::Mesh;
using roam::ObjectId;
using roam::Pose;
using roam::Vec3;
using roam::World;

inline std::shared_ptr<const World> shared(const Mesh& mesh, bool lossless = true) {
  return std::make_shared<World>(scenes::build(mesh, lossless));
}

inline void append(Mesh& to, const Mesh& mesh, const Pose& pose) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const roam::Triangle t = mesh.triangle(i);
    scenes::add_triangle(to, pose.to_scene(t[0]), pose.to_scene(t[1]), pose.to_scene(t[2]));
  }
}

/// A mesh that stands still, and meshes with poses.
struct Scene {
  Mesh still;
  World base;
  Instances space;
  std::vector<Mesh> parts;
  std::vector<ObjectId> ids;

  explicit Scene(Mesh mesh, bool lossless = true)
      : still(std::move(mesh)), base(scenes::build(still, lossless)), space(base) {}
  Scene(const Scene&) = delete;

  ObjectId add(const Mesh& mesh, const Pose& pose, std::string name = {}, std::uint64_t user_data = 0) {
    parts.push_back(mesh);
    ids.push_back(space.add(shared(mesh), pose, std::move(name), user_data));
    return ids.back();
  }
  /// All triangles in their present places: first the fixed ones, then those of the instances.
  [[nodiscard]] Mesh whole() const {
    Mesh all = still;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      if (space.has(ids[i])) append(all, parts[i], space.pose(ids[i]));
    }
    return all;
  }
};

inline Pose some_pose(clutter::Random& random, double half) { return {random.in_box(half), random.between(-4.0, 4.0)}; }

/// Clutter with six parts in random poses.
inline std::unique_ptr<Scene> clutter_scene(std::uint64_t seed, bool lossless, const Vec3& centre = Vec3(0.0)) {
  clutter::Random random(seed);
  auto scene = std::make_unique<Scene>(
      clutter::make(random, {.count = 200, .half = 5.0, .small = 0.05, .large = 3.0, .centre = centre}), lossless);
  for (int i = 0; i < 6; ++i) {
    Pose pose = some_pose(random, 4.0);
    pose.position += centre;
    scene->add(clutter::make(random, {.count = 40, .half = 1.5, .small = 0.05, .large = 2.0}), pose);
  }
  return scene;
}

}  // namespace posed
