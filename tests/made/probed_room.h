#pragma once
/// \file
/// A room with a wall across it, and the question whether a body gets through the wall's door.

#include "roam/probe.h"
#include "walker_scenes.h"

namespace scenes {

/// From x = 0 to 20, 4 m wide and 3 m high, with a wall across it at x = 10 that has a door of `width`, 2.1 m high.
inline Mesh room(double width) {
  Mesh m;
  add_box(m, {0.0, -2.0, 0.0}, {20.0, 2.0, 3.0});
  add_wall(m, 10.0, -2.0, 10.0, -0.5 * width, 0.0, 3.0);
  add_wall(m, 10.0, 0.5 * width, 10.0, 2.0, 0.0, 3.0);
  add_wall(m, 10.0, -0.5 * width, 10.0, 0.5 * width, 2.1, 3.0);
  return m;
}

/// From one half to the other.
inline const roam::ProbeQuestion across{.from = {2.0, 0.3, 1.0}, .to = {18.0, -0.4, 1.0}};

}  // namespace scenes
