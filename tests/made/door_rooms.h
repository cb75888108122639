#pragma once
/// A room with a door, as an OBJ file, for the tests of the command line.

#include <string>

#include "cli_scenes.h"

/// room_obj() with a wall across it at x = 10. Its door in the middle is 2.1 m high; width 0: no door.
inline std::string door_obj(double width) {
  const std::string half = std::to_string(0.5 * width), other = "-" + half;
  std::string text = room_obj();  // 8 vertices
  text += "v 10 -2 0\nv 10 " + other + " 0\nv 10 " + other + " 3\nv 10 -2 3\n";
  text += "v 10 " + half + " 0\nv 10 2 0\nv 10 2 3\nv 10 " + half + " 3\n";
  text += "v 10 " + other + " 2.1\nv 10 " + half + " 2.1\n";
  return text + "o wall\nf 9 10 11 12\nf 13 14 15 16\nf 17 18 16 11\n";
}
