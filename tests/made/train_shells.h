#pragma once
/// \file
/// Closed shells with consistent windings, and floors with dividing walls, to make rooms of.

#include <algorithm>
#include <cmath>
#include <vector>

#include "box_made.h"
#include "training/places/places.h"
#include "walker_scenes.h"

namespace shells {

using roam::Mesh;
using roam::Vec3;

using scenes::add_room;

inline void flip(Mesh& mesh) {
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
}

/// The same triangles again, wound the other way.
inline void add_backs(Mesh& mesh) {
  Mesh backs = mesh;
  flip(backs);
  mesh.triangles.insert(mesh.triangles.end(), backs.triangles.begin(), backs.triangles.end());
}

/// A wall along y = `y` from x0 to x1 with an opening of `width` about `x`, 3 m high.
inline void add_wall_with_door(Mesh& mesh, double x0, double x1, double y, double x, double width) {
  scenes::add_wall(mesh, x0, y, x - 0.5 * width, y, 0.0, 3.0);
  scenes::add_wall(mesh, x + 0.5 * width, y, x1, y, 0.0, 3.0);
}

/// A person's body.
inline roam::ways::Measure person() {
  roam::ways::Measure m;
  m.height = 1.9;
  m.narrowest = 0.1;
  return m;
}

/// A scene and its places.
struct Look {
  roam::Survey survey;
  roam::ways::Measure measure = person();
  roam::ways::WidestTree tree;
  std::vector<roam::training::Component> components;

  explicit Look(const Mesh& mesh, double spacing = 0.2, std::uint64_t most_places = 500'000)
      : survey(roam::Survey::build({mesh}, {.threads = 1, .lossless = true, .progress = {}})),
        tree(survey, measure, spacing),
        components(roam::training::find_components(survey, measure, tree, 1, {}, most_places)) {}

  /// The component with a place within half a metre of this one.
  [[nodiscard]] const roam::training::Component* at(const Vec3& place) const {
    for (const auto& c : components)
      for (const auto id : c.nodes) {
        const Vec3 to = tree.node(id).place - place;
        if (std::abs(to.x) < 0.5 && std::abs(to.y) < 0.5 && std::abs(to.z) < 0.5) return &c;
      }
    return nullptr;
  }
};

}  // namespace shells
