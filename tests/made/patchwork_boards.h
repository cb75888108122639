#pragma once
/// Boards over a square, for the tests of patchworks, and a falling ball.

#include <gtest/gtest.h>

#include <string>

#include "roam/patchwork.h"
#include "walker_scenes.h"

namespace boards {

using roam::Body;
using roam::Box;
using roam::Mesh;
using roam::PatchId;
using roam::Patchwork;
using roam::Vec3;
using roam::World;

inline const Box unit{{0.0, 0.0, 0.0}, {1.0, 1.0, 1.0}};
inline const Body ball{0.25, 0.0};

/// A board over the unit square at the height z.
inline World board(double z, const char* name = "board") {
  Mesh m;
  m.name = name;
  scenes::add_floor(m, 0.0, 0.0, 1.0, 1.0, z);
  return scenes::build(m);
}

/// The left or the right half of it.
inline World half_board(double z, bool right) {
  Mesh m;
  m.name = right ? "right" : "left";
  scenes::add_floor(m, right ? 0.5 : 0.0, 0.0, right ? 1.0 : 0.5, 1.0, z);
  return scenes::build(m);
}

/// The height, less its radius, at which a ball that falls beside the middle is stopped; -1 if it is not. Also names
/// the object that stops it.
inline double stopped_at(const Patchwork& space, double x, std::string* by = nullptr) {
  const auto s = space.sweep(ball, {x, 0.5, 3.0}, {0.0, 0.0, -4.0});
  if (!s.hit) return -1.0;
  if (by) *by = space.object_name(s.triangle);
  return 3.0 - 4.0 * s.time - ball.radius;
}

inline constexpr double stored = 3e-3;  // metres: margin, storing and sweep tolerance together

}  // namespace boards
