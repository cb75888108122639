#pragma once
/// \file
/// A box of triangles: a room or a solid.

#include "walker_scenes.h"

namespace scenes {

/// A box. Its triangles show their fronts to the inside, or with `solid` to the outside.
inline void add_room(roam::Mesh& mesh, const roam::Vec3& lo, const roam::Vec3& hi, bool solid = false) {
  const auto face = [&](const roam::Vec3& a, const roam::Vec3& b, const roam::Vec3& c, const roam::Vec3& d) {
    if (solid)
      add_quad(mesh, d, c, b, a);
    else
      add_quad(mesh, a, b, c, d);
  };
  face({lo.x, lo.y, lo.z}, {hi.x, lo.y, lo.z}, {hi.x, hi.y, lo.z}, {lo.x, hi.y, lo.z});
  face({lo.x, lo.y, hi.z}, {lo.x, hi.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, lo.y, hi.z});
  face({lo.x, lo.y, lo.z}, {lo.x, lo.y, hi.z}, {hi.x, lo.y, hi.z}, {hi.x, lo.y, lo.z});
  face({lo.x, hi.y, lo.z}, {hi.x, hi.y, lo.z}, {hi.x, hi.y, hi.z}, {lo.x, hi.y, hi.z});
  face({lo.x, lo.y, lo.z}, {lo.x, hi.y, lo.z}, {lo.x, hi.y, hi.z}, {lo.x, lo.y, hi.z});
  face({hi.x, lo.y, lo.z}, {hi.x, lo.y, hi.z}, {hi.x, hi.y, hi.z}, {hi.x, hi.y, lo.z});
}

}  // namespace scenes
