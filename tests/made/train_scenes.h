#pragma once
/// \file
/// A corridor to train in: 10 m long in x, 4 m wide, 3 m high, floor at z = 0.

#include <utility>
#include <vector>

#include "roam/survey.h"
#include "walker_scenes.h"

struct CorridorOptions {
  double door = 0.0;    ///< m wide, in a wall 0.2 m thick at x = 7; 0: there is none
  double lintel = 3.0;  ///< m above the floor, of the door
  double split = 0.0;   ///< m wide, across the floor at x = 3; 0: there is none
  double depth = 14.0;  ///< m, of the split
};

/// Path of the feet: over the split, through the door.
inline const std::vector<roam::Vec3> corridor_way{{1.0, 0.0, 0.0}, {9.0, 0.0, 0.0}};

inline roam::Mesh corridor_mesh(const CorridorOptions& options) {
  using namespace scenes;
  roam::Mesh mesh;
  constexpr double length = 10.0, half = 2.0, high = 3.0, split_at = 3.0, door_at = 7.0, thick = 0.2;
  add_floor(mesh, 0.0, -half, length, half, high);
  add_wall(mesh, 0.0, -half, 0.0, half, 0.0, high);
  add_wall(mesh, length, -half, length, half, 0.0, high);
  for (const double y : {-half, half}) add_wall(mesh, 0.0, y, length, y, -options.depth, high);
  if (options.split > 0.0) {
    const double near = split_at - 0.5 * options.split, far = split_at + 0.5 * options.split;
    add_floor(mesh, 0.0, -half, near, half, 0.0);
    add_floor(mesh, far, -half, length, half, 0.0);
    add_floor(mesh, near, -half, far, half, -options.depth);
    for (const double x : {near, far}) add_wall(mesh, x, -half, x, half, -options.depth, 0.0);
  } else {
    add_floor(mesh, 0.0, -half, length, half, 0.0);
  }
  if (options.door > 0.0) {
    const double jamb = 0.5 * options.door;
    add_box(mesh, {door_at, -half, 0.0}, {door_at + thick, -jamb, high});
    add_box(mesh, {door_at, jamb, 0.0}, {door_at + thick, half, high});
    if (options.lintel < high) add_box(mesh, {door_at, -jamb, options.lintel}, {door_at + thick, jamb, high});
  }
  return mesh;
}

inline roam::Survey survey_of(std::vector<roam::Mesh> meshes) {
  return roam::Survey::build(std::move(meshes), {.threads = 1, .lossless = true});
}

inline roam::Survey corridor(const CorridorOptions& options) { return survey_of({corridor_mesh(options)}); }
