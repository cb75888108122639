#pragma once
/// \file
/// Seeded galleries with both ends known by construction: a straight corridor with three doors (oblique, 0 to 0.4 m
/// thick, some with a sill) and three splits across its floor. The widest body that passes is half the narrowest door.
/// The smallest foot that falls into no split is half the widest split. No noise: every plane is exact.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "walker_scenes.h"

namespace seeded {

using roam::Mesh;
using roam::Vec3;

struct Door {
  Vec3 point{0.0};   ///< its middle, on the floor
  Vec3 across{0.0};  ///< unit, from jamb to jamb
  double width = 0.0, thickness = 0.0, sill = 0.0;
};
struct Split {
  Vec3 point{0.0};   ///< its middle, at the level of the floor
  Vec3 across{0.0};  ///< unit, from rim to rim
  double width = 0.0, depth = 0.0;
};

struct Gallery {
  Mesh mesh;
  Vec3 from{0.0}, to{0.0};  ///< of the feet
  std::vector<Door> doors;
  std::vector<Split> splits;

  /// The radius of the widest body that gets from one end to the other.
  [[nodiscard]] double upper() const {
    double least = 1e9;
    for (const Door& d : doors) least = std::min(least, 0.5 * d.width);
    return least;
  }
  /// The radius of the smallest foot that falls into no split.
  [[nodiscard]] double lower() const {
    double most = 0.0;
    for (const Split& s : splits) most = std::max(most, 0.5 * s.width);
    return most;
  }
};

inline constexpr double half_width = 1.4;  ///< of the corridor, m
inline constexpr double ceiling = 2.6;
inline constexpr double stride = 6.0;  ///< from one door or split to the next

/// The two jambs, from below the floor to above the ceiling, and the sill.
inline void add_door(Mesh& mesh, const Door& d) {
  const Vec3 t = d.across, n(t.y, -t.x, 0.0);
  const auto at = [&](double along, double through) { return d.point + t * along + n * through; };
  const auto wall = [&](const Vec3& a, const Vec3& b) {
    scenes::add_wall(mesh, a.x, a.y, b.x, b.y, -0.1, ceiling + 0.1);
  };
  const double half = 0.5 * d.width, deep = 0.5 * d.thickness, far = 2.0 * half_width + 1.0;
  for (const double side : {-1.0, 1.0}) {
    wall(at(side * half, -deep), at(side * far, -deep));
    if (!(d.thickness > 0.0)) continue;
    wall(at(side * half, deep), at(side * far, deep));
    wall(at(side * half, -deep), at(side * half, deep));
  }
  if (!(d.sill > 0.0)) return;
  const double half_sill = std::max(deep, 0.05);
  const Vec3 a = at(-half, -half_sill), b = at(half, -half_sill), c = at(half, half_sill), e = at(-half, half_sill);
  const Vec3 up(0.0, 0.0, d.sill);
  scenes::add_quad(mesh, a + up, b + up, c + up, e + up);
  scenes::add_wall(mesh, a.x, a.y, b.x, b.y, 0.0, d.sill);
  scenes::add_wall(mesh, e.x, e.y, c.x, c.y, 0.0, d.sill);
}

/// The corners of the floor's edge beside a split, at y = -half_width and half_width.
inline std::pair<Vec3, Vec3> rim(const Split& s, double side) {
  const Vec3 p = s.point + s.across * (side * 0.5 * s.width);
  const double slant = -s.across.y / s.across.x;  // dx / dy along the rim
  return {Vec3(p.x + slant * (-half_width - p.y), -half_width, 0.0),
          Vec3(p.x + slant * (half_width - p.y), half_width, 0.0)};
}

/// The splits' own walls and bottoms, and the floor between them.
inline void add_floors(Mesh& mesh, const std::vector<Split>& splits, double length) {
  std::pair<Vec3, Vec3> begin{Vec3(0.0, -half_width, 0.0), Vec3(0.0, half_width, 0.0)};
  for (const Split& s : splits) {
    const auto near = rim(s, -1.0), far = rim(s, 1.0);
    scenes::add_quad(mesh, begin.first, near.first, near.second, begin.second);
    scenes::add_wall(mesh, near.first.x, near.first.y, near.second.x, near.second.y, -s.depth, 0.0);
    scenes::add_wall(mesh, far.first.x, far.first.y, far.second.x, far.second.y, -s.depth, 0.0);
    scenes::add_wall(mesh, near.first.x, near.first.y, far.first.x, far.first.y, -s.depth, 0.0);
    scenes::add_wall(mesh, near.second.x, near.second.y, far.second.x, far.second.y, -s.depth, 0.0);
    const Vec3 down(0.0, 0.0, -s.depth);
    scenes::add_quad(mesh, near.first + down, far.first + down, far.second + down, near.second + down);
    begin = far;
  }
  const std::pair<Vec3, Vec3> end{Vec3(length, -half_width, 0.0), Vec3(length, half_width, 0.0)};
  scenes::add_quad(mesh, begin.first, end.first, end.second, begin.second);
}

/// A corridor along x from 0 to `stride` beyond its last door or split. Doors and splits are ordered by x and do not
/// overlap.
inline Gallery build(std::vector<Door> doors, std::vector<Split> splits) {
  Gallery g;
  double length = stride;
  for (const Door& d : doors) length = std::max(length, d.point.x + stride);
  for (const Split& s : splits) length = std::max(length, s.point.x + stride);
  add_floors(g.mesh, splits, length);
  scenes::add_floor(g.mesh, 0.0, -half_width, length, half_width, ceiling);
  for (const double y : {-half_width, half_width}) scenes::add_wall(g.mesh, 0.0, y, length, y, 0.0, ceiling);
  for (const double x : {0.0, length}) scenes::add_wall(g.mesh, x, -half_width, x, half_width, 0.0, ceiling);
  for (const Door& d : doors) add_door(g.mesh, d);
  g.from = Vec3(1.5, 0.1, 0.0);
  g.to = Vec3(length - 1.5, -0.1, 0.0);
  g.doors = std::move(doors);
  g.splits = std::move(splits);
  return g;
}

inline Gallery gallery(std::uint64_t seed) {
  // Streams of neighbouring seeds are shifted copies of each other, so take distant ones.
  scenes::Random random(scenes::Random(seed).bits());
  std::vector<int> order{0, 0, 0, 1, 1, 1};  // a door or a split
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  std::vector<Door> doors;
  std::vector<Split> splits;
  for (std::size_t i = 0; i < order.size(); ++i) {
    const double x = stride * static_cast<double>(i + 1) + random.between(-0.3, 0.3);
    if (order[i] == 0) {
      const double angle = random.chance(0.3) ? 0.0 : random.between(-0.6, 0.6);
      Door d;
      d.width = random.between(0.5, 1.2);
      d.thickness = random.chance(0.25) ? 0.0 : random.between(0.05, 0.4);
      d.sill = random.chance(0.4) ? 0.15 : 0.0;
      // At least 15 cm of jamb shows in the corridor on either side.
      const double room =
          half_width - 0.15 - 0.5 * d.width * std::cos(angle) - 0.5 * d.thickness * std::abs(std::sin(angle));
      d.point = Vec3(x, random.between(-room, room), 0.0);
      d.across = Vec3(std::sin(angle), std::cos(angle), 0.0);
      doors.push_back(d);
    } else {
      const double angle = random.chance(0.5) ? 0.0 : random.between(-0.5, 0.5);
      Split s;
      s.width = random.between(0.1, 1.25);
      s.depth = random.chance(0.3) ? 50.0 : random.between(0.5, 3.0);
      s.point = Vec3(x, 0.0, 0.0);
      s.across = Vec3(std::cos(angle), std::sin(angle), 0.0);
      splits.push_back(s);
    }
  }
  return build(std::move(doors), std::move(splits));
}

/// Changes that must not affect a result. Each returns the changed gallery.
inline Gallery moved(Gallery g, const Vec3& by) {
  scenes::shift(g.mesh, by);
  g.from += by;
  g.to += by;
  for (Door& d : g.doors) d.point += by;
  for (Split& s : g.splits) s.point += by;
  return g;
}

inline Gallery turned(Gallery g, double angle) {
  const auto turn = [c = std::cos(angle), s = std::sin(angle)](Vec3& p) {
    p = Vec3(c * p.x - s * p.y, s * p.x + c * p.y, p.z);
  };
  for (Vec3& v : g.mesh.vertices) turn(v);
  turn(g.from);
  turn(g.to);
  for (Door& d : g.doors) turn(d.point), turn(d.across);
  for (Split& s : g.splits) turn(s.point), turn(s.across);
  return g;
}

inline Gallery reordered(Gallery g, std::uint64_t seed) {
  scenes::Random random(seed);
  auto& t = g.mesh.triangles;
  for (std::size_t i = t.size(); i > 1; --i) std::swap(t[i - 1], t[random.bits() % i]);
  return g;
}

inline Gallery flipped(Gallery g, std::uint64_t seed) {
  scenes::Random random(seed);
  for (auto& t : g.mesh.triangles)
    if (random.chance(0.5)) std::swap(t[1], t[2]);
  return g;
}

inline Gallery doubled(Gallery g) {
  const auto once = g.mesh.triangles;
  for (const auto& t : once) g.mesh.triangles.push_back({t[0], t[2], t[1]});
  return g;
}

/// Divides each triangle into three around a point inside.
inline Gallery split(Gallery g, std::uint64_t seed) {
  scenes::Random random(seed);
  Mesh fine;
  for (std::size_t i = 0; i < g.mesh.triangles.size(); ++i) {
    const roam::Triangle t = g.mesh.triangle(i);
    const double u = random.between(0.1, 0.45), v = random.between(0.1, 0.45);
    const Vec3 p = t[0] + u * (t[1] - t[0]) + v * (t[2] - t[0]);
    for (int k = 0; k < 3; ++k) scenes::add_triangle(fine, t[k], t[(k + 1) % 3], p);
  }
  g.mesh = std::move(fine);
  return g;
}

}  // namespace seeded
