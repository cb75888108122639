#pragma once
/// \file
/// Rooms joined by doors, windows, ducts and shafts, for flying bodies.

#include <algorithm>
#include <array>
#include <vector>

#include "walker_scenes.h"

namespace flight {

using roam::Box;
using roam::Mesh;
using roam::Vec3;
using scenes::add_quad;

/// An opening in a wall: from lower to upper along y and z, or in a floor or ceiling along x and y.
struct Hole {
  double u0, u1, v0, v1;
};

/// A rectangle that spans `u` and `v` from a corner, with a hole given in metres from the corner.
inline void add_pierced(Mesh& mesh, const Vec3& corner, const Vec3& u, const Vec3& v, double width, double height,
                        const std::vector<Hole>& holes) {
  std::vector<double> us{0.0, width}, vs{0.0, height};
  for (const Hole& h : holes) {
    us.insert(us.end(), {h.u0, h.u1});
    vs.insert(vs.end(), {h.v0, h.v1});
  }
  std::sort(us.begin(), us.end());
  std::sort(vs.begin(), vs.end());
  for (std::size_t i = 1; i < us.size(); ++i) {
    for (std::size_t j = 1; j < vs.size(); ++j) {
      const double mu = 0.5 * (us[i - 1] + us[i]), mv = 0.5 * (vs[j - 1] + vs[j]);
      const bool open = std::any_of(holes.begin(), holes.end(),
                                    [&](const Hole& h) { return mu > h.u0 && mu < h.u1 && mv > h.v0 && mv < h.v1; });
      if (open || us[i] <= us[i - 1] || vs[j] <= vs[j - 1]) continue;
      add_quad(mesh, corner + us[i - 1] * u + vs[j - 1] * v, corner + us[i] * u + vs[j - 1] * v,
               corner + us[i] * u + vs[j] * v, corner + us[i - 1] * u + vs[j] * v);
    }
  }
}

/// The sides of a room with holes. Those of x count from its lower y and z, that of z from its lower x and y.
struct Holes {
  std::vector<Hole> low_x, high_x, low_z, high_z;
};

/// The inside of a box, wound to be seen from within.
inline void add_room(Mesh& mesh, const Box& room, const Holes& holes = {}) {
  const Vec3 x(1.0, 0.0, 0.0), y(0.0, 1.0, 0.0), z(0.0, 0.0, 1.0), s = room.size(), lo = room.lower;
  add_pierced(mesh, lo, x, y, s.x, s.y, holes.low_z);
  add_pierced(mesh, lo, y, z, s.y, s.z, holes.low_x);
  add_pierced(mesh, lo, z, x, s.z, s.x, {});
  // The other sides face the other way: opposite corner, and the two directions exchanged.
  const auto mirrored = [&](const std::vector<Hole>& of) {
    std::vector<Hole> turned;
    for (const Hole& h : of) turned.push_back({h.v0, h.v1, h.u0, h.u1});
    return turned;
  };
  add_pierced(mesh, lo + s.z * z, y, x, s.y, s.x, mirrored(holes.high_z));
  add_pierced(mesh, lo + s.x * x, z, y, s.z, s.y, mirrored(holes.high_x));
  add_pierced(mesh, lo + s.y * y, x, z, s.x, s.z, {});
}

/// The four sides of a duct between two outlines of four corners.
inline void add_duct(Mesh& mesh, const std::array<Vec3, 4>& from, const std::array<Vec3, 4>& to) {
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t j = (i + 1) % 4;
    add_quad(mesh, from[i], to[i], to[j], from[j]);
  }
}

/// Two rooms of 5 m by 4 m by 3 m, one `rise` metres higher, with a duct between them. The duct is `width` m wide,
/// `height` m high (in its wall), and `length` m long seen from above.
inline Mesh joined_by_duct(double width, double height, double length, double rise) {
  Mesh m;
  const double half = 0.5 * width, sill = 1.0;
  add_room(m, {Vec3(-5.0, -2.0, 0.0), Vec3(0.0, 2.0, 3.0)},
           {{}, {{2.0 - half, 2.0 + half, sill, sill + height}}, {}, {}});
  add_room(m, {Vec3(length, -2.0, rise), Vec3(length + 5.0, 2.0, rise + 3.0)},
           {{{2.0 - half, 2.0 + half, sill, sill + height}}, {}, {}, {}});
  const auto outline = [&](double x, double z) {
    return std::array<Vec3, 4>{Vec3(x, -half, z + sill), Vec3(x, half, z + sill), Vec3(x, half, z + sill + height),
                               Vec3(x, -half, z + sill + height)};
  };
  add_duct(m, outline(0.0, 0.0), outline(length, rise));
  return m;
}

/// Two rooms of 5 m by 4 m by 3 m one over the other, and a shaft `side` m square and `length` m long between them.
inline Mesh joined_by_shaft(double side, double length) {
  Mesh m;
  const double half = 0.5 * side;
  const Hole hole{2.5 - half, 2.5 + half, 2.0 - half, 2.0 + half};
  add_room(m, {Vec3(-2.5, -2.0, 0.0), Vec3(2.5, 2.0, 3.0)}, {{}, {}, {}, {hole}});
  add_room(m, {Vec3(-2.5, -2.0, 3.0 + length), Vec3(2.5, 2.0, 6.0 + length)}, {{}, {}, {hole}, {}});
  const auto outline = [&](double z) {
    return std::array<Vec3, 4>{Vec3(-half, -half, z), Vec3(half, -half, z), Vec3(half, half, z), Vec3(-half, half, z)};
  };
  add_duct(m, outline(3.0), outline(3.0 + length));
  return m;
}

/// Two rooms of 5 m by 4 m by 3 m with a wall of 0.2 m between them. Its openings are given from its corner.
inline Mesh joined_by_openings(const std::vector<Hole>& openings) {
  Mesh m;
  add_room(m, {Vec3(-5.1, -2.0, 0.0), Vec3(-0.1, 2.0, 3.0)}, {{}, openings, {}, {}});
  add_room(m, {Vec3(0.1, -2.0, 0.0), Vec3(5.1, 2.0, 3.0)}, {openings, {}, {}, {}});
  for (const Hole& h : openings) {
    const auto outline = [&](double x) {
      return std::array<Vec3, 4>{Vec3(x, h.u0 - 2.0, h.v0), Vec3(x, h.u1 - 2.0, h.v0), Vec3(x, h.u1 - 2.0, h.v1),
                                 Vec3(x, h.u0 - 2.0, h.v1)};
    };
    add_duct(m, outline(-0.1), outline(0.1));
  }
  return m;
}

/// Open country under the sky: 16 m by 16 m for each of `n` by `n` blocks, which are at least 2 m high.
inline Mesh open_country(int n) {
  Mesh m;
  for (int i = 0; i < 8 * n; ++i) {
    for (int j = 0; j < 8 * n; ++j) scenes::add_floor(m, 2.0 * i, 2.0 * j, 2.0 * i + 2.0, 2.0 * j + 2.0, 0.0);
  }
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const Vec3 at(2.5 + 16.0 * i, 2.5 + 16.0 * j, 0.0);
      scenes::add_box(m, at, at + Vec3(4.0, 3.0, 2.0 + 0.4 * (n * i + j)));
    }
  }
  return m;
}

}  // namespace flight
