#pragma once
/// \file
/// Seeded random scenes and directions: the same on every machine.

#include <cmath>
#include <random>

#include "roam/mesh.h"

namespace clutter {

struct Random {
  std::mt19937_64 engine;

  explicit Random(std::uint64_t seed) : engine(seed) {}
  double unit() { return double(engine() >> 11) * 0x1p-53; }
  double between(double a, double b) { return a + (b - a) * unit(); }
  roam::Vec3 in_box(double half) { return {between(-half, half), between(-half, half), between(-half, half)}; }
  roam::Vec3 direction() {
    for (;;) {
      const roam::Vec3 v = in_box(1.0);
      const double n = std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
      if (n > 0.1 && n < 1.0) return v / n;
    }
  }
};

/// Parameters of a scene: `count` triangles of sizes from `small` to `large` (m) in a box of half side `half` around
/// `centre`.
struct Recipe {
  int count = 600;
  double half = 5.0, small = 0.05, large = 3.0;
  roam::Vec3 centre{0.0};
};

/// One in three triangles is degenerate: a segment, a point, three corners in a row, a sliver.
inline roam::Mesh make(Random& random, const Recipe& recipe) {
  roam::Mesh mesh;
  mesh.name = "clutter";
  for (int i = 0; i < recipe.count; ++i) {
    const double size = recipe.small * std::pow(recipe.large / recipe.small, random.unit());
    const roam::Vec3 at = recipe.centre + random.in_box(recipe.half);
    roam::Vec3 corner[3] = {at, at + size * random.in_box(0.5), at + size * random.in_box(0.5)};
    switch (random.engine() % 12) {
      case 0:
        corner[2] = corner[1];
        break;
      case 1:
        corner[1] = corner[2] = corner[0];
        break;
      case 2:
        corner[2] = corner[0] + 0.3 * (corner[1] - corner[0]);
        break;
      case 3:
        corner[2] = corner[1] + 1e-5 * random.in_box(0.5);
        break;
      default:
        break;
    }
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), corner, corner + 3);
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

}  // namespace clutter
