#pragma once
/// \file
/// Rooms to probe: one with a wall across it, and the question whether a body gets through the wall's door; one with a
/// crack.

#include "roam/probe.h"
#include "walker_scenes.h"

namespace scenes {

inline roam::Survey survey_of(const Mesh& mesh, bool lossless = true) {
  return roam::Survey::build({mesh}, {.threads = 1, .lossless = lossless, .progress = {}});
}

/// From x = 0 to 20, 4 m wide and 3 m high, with a wall across it at x = 10 that has a door of `width`, 2.1 m high.
inline Mesh room(double width) {
  Mesh m;
  add_box(m, {0.0, -2.0, 0.0}, {20.0, 2.0, 3.0});
  add_wall(m, 10.0, -2.0, 10.0, -0.5 * width, 0.0, 3.0);
  add_wall(m, 10.0, 0.5 * width, 10.0, 2.0, 0.0, 3.0);
  add_wall(m, 10.0, -0.5 * width, 10.0, 0.5 * width, 2.1, 3.0);
  return m;
}

/// From x = 0 to `end`, 4 m wide, with a crack across its floor between `near` and `far`.
inline Mesh cracked(double near, double far, double end, double depth) {
  Mesh m;
  add_floor(m, 0.0, -2.0, near, 2.0, 0.0);
  add_floor(m, far, -2.0, end, 2.0, 0.0);
  add_floor(m, near, -2.0, far, 2.0, -depth);
  for (const double x : {near, far}) add_wall(m, x, -2.0, x, 2.0, -depth, 0.0);
  for (const double y : {-2.0, 2.0}) add_wall(m, 0.0, y, end, y, -depth, 3.0);
  return m;
}

/// From one half to the other.
inline const roam::ProbeQuestion across{.from = {2.0, 0.3, 1.0}, .to = {18.0, -0.4, 1.0}};

}  // namespace scenes
