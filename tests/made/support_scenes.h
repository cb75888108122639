#pragma once
/// \file
/// Splits that a foot must bridge, and walks over them, for the tests of WalkerSettings::support_radius.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "walker_judged.h"

namespace scenes {

/// A slim person with a support disc.
inline WalkerSettings person(double support_radius, double radius = 0.3) {
  WalkerSettings s;
  s.radius = radius;
  s.support_radius = support_radius;
  return s;
}

/// A floor with a split across it that begins at x = 0, with sides `depth` deep and a bottom. `rise`: of the far side.
inline Mesh split(double width, double depth = 50.0, double rise = 0.0) {
  Mesh m;
  add_floor(m, -20.0, -10.0, 0.0, 10.0, 0.0);
  add_floor(m, width, -10.0, 20.0, 10.0, rise);
  add_wall(m, 0.0, -10.0, 0.0, 10.0, -depth, 0.0);
  add_wall(m, width, -10.0, width, 10.0, -depth, rise);
  add_floor(m, 0.0, -10.0, width, 10.0, -depth);
  return m;
}

inline void turn(Mesh& mesh, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  for (Vec3& v : mesh.vertices) v = {std::cos(a) * v.x - std::sin(a) * v.y, std::sin(a) * v.x + std::cos(a) * v.y, v.z};
}

inline void tilt(Mesh& mesh, double degrees) {
  const double a = degrees * std::numbers::pi / 180.0;
  for (Vec3& v : mesh.vertices) v = {std::cos(a) * v.x - std::sin(a) * v.z, v.y, std::sin(a) * v.x + std::cos(a) * v.z};
}

inline constexpr std::array speeds{0.4, 1.4, 7.0, 50.0};
inline constexpr std::array steps{1.0 / 240.0, 1.0 / 60.0, 1.0 / 25.0};

/// The result of a walk towards +x over a crack.
struct Crossing {
  bool across = false;
  bool fell = false;
  double lowest = 0.0;   ///< of the feet, up to the far side
  double highest = 0.0;  ///< likewise
  int carried = 0;       ///< steps
};

inline Crossing cross(Walk& w, const Vec3& velocity, double dt, double goal) {
  Crossing c;
  const double way = goal - w.walker.position().x;
  const int most = static_cast<int>(2.0 * way / (std::abs(velocity.x) * dt)) + 60;
  for (int i = 0; i < most && w.walker.position().x < goal; ++i) {
    const StepReport& r = w.step(velocity, dt);
    c.carried += r.bridging ? 1 : 0;
    c.lowest = std::min(c.lowest, w.feet());
    c.highest = std::max(c.highest, w.feet());
    c.fell |= r.has(EventKind::fell) || w.feet() < -1.0;
    if (c.fell) return c;
  }
  c.across = w.walker.position().x >= goal;
  return c;
}

}  // namespace scenes
