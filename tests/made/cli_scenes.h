#pragma once
/// Tiny scenes that the tests of the command line write as OBJ files, in metres, z up.

#include <string>

/// The six sides of a box seen from inside: 20 m long in x, 4 m wide, 3 m high, its floor at z = 0. Each wall is an
/// object: floor, ceiling, left, right, back (x = 0), front (x = 20).
inline std::string room_obj() {
  return "v 0 -2 0\nv 20 -2 0\nv 20 2 0\nv 0 2 0\nv 0 -2 3\nv 20 -2 3\nv 20 2 3\nv 0 2 3\n"
         "o floor\nf 1 2 3 4\no ceiling\nf 5 8 7 6\no right\nf 1 5 6 2\no left\nf 4 3 7 8\n"
         "o back\nf 1 4 8 5\no front\nf 2 6 7 3\n";
}

/// Two floors at z = 0, from x = 0 to 5 and from 5 + `gap` to 15, 4 m wide, and a third 10 m below both.
inline std::string gap_obj(const std::string& gap_end) {
  return "v 0 -2 0\nv 5 -2 0\nv 5 2 0\nv 0 2 0\nv " + gap_end + " -2 0\nv 15 -2 0\nv 15 2 0\nv " + gap_end +
         " 2 0\nv 0 -2 -10\nv 15 -2 -10\nv 15 2 -10\nv 0 2 -10\n"
         "o near\nf 1 2 3 4\no far\nf 5 6 7 8\no bottom\nf 9 10 11 12\n";
}
