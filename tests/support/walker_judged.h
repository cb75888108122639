#pragma once
/// \file
/// A walk with every step judged by brute force, and the floors of several tests.

#include <gtest/gtest.h>

#include "walker_scenes.h"

namespace scenes {

using roam::EventKind;
using roam::Mode;
using roam::StepReport;
using roam::Walker;
using roam::WalkerSettings;
using roam::World;

constexpr double frame = 1.0 / 60.0;

/// Walks and checks every step against brute force.
struct Walk {
  const Mesh& mesh;
  World world;
  Judge judge;
  Walker walker;
  int events[32] = {};

  Walk(const Mesh& scene, const WalkerSettings& settings, Mode mode, const Vec3& start)
      : mesh(scene), world(build(scene)), judge(scene), walker(world, settings, mode, start) {
    EXPECT_GE(margin(judge, walker.report(), settings.radius), 0.0);
  }

  const StepReport& step(const Vec3& velocity, double dt = frame, bool jump = false, bool crouch = false) {
    const StepReport& r = walker.step({velocity, jump, crouch}, dt);
    EXPECT_GE(margin(judge, r, walker.settings().radius), 0.0);
    for (const roam::Event& e : r.events) ++events[static_cast<int>(e.kind)];
    return r;
  }
  void go(const Vec3& velocity, double seconds, double dt = frame) {
    for (double t = 0.0; t < seconds - 0.5 * dt; t += dt) step(velocity, dt);
  }
  [[nodiscard]] int count(EventKind kind) const { return events[static_cast<int>(kind)]; }
  [[nodiscard]] double feet() const { return walker.feet().z; }
};

/// A floor of 40 m by 20 m at height 0 with its middle at the origin.
inline Mesh floor_mesh() {
  Mesh m;
  add_floor(m, -20.0, -10.0, 20.0, 10.0, 0.0);
  return m;
}

constexpr double near_ground = 0.01;  // metres: skin and storage error

inline WalkerSettings ball(double radius) { return {.radius = radius, .height = 2.0 * radius, .eye = radius}; }

/// A slab with its lower side at `height`, from x = 1 to x = 4.
inline Mesh low_passage(double height) {
  Mesh m = floor_mesh();
  add_box(m, {1.0, -8.0, height}, {4.0, 8.0, height + 0.4});
  return m;
}

/// About 2.7 n^2 triangles that cover 20 m by 20 m at height 0, with random diagonals and vertices in the middle of
/// edges.
inline Mesh rough_tiling(int n, std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  const double size = 20.0 / n;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double x = -10.0 + i * size, y = -10.0 + j * size;
      const Vec3 a(x, y, 0.0), b(x + size, y, 0.0), c(x + size, y + size, 0.0), d(x, y + size, 0.0);
      const double pick = random.unit();
      if (pick < 0.3) {
        add_quad(m, a, b, c, d);
      } else if (pick < 0.6) {
        add_quad(m, b, c, d, a);
      } else {  // a fan around a point on one edge: a T-junction with the neighbour
        const Vec3 e = a + (b - a) * random.between(0.02, 0.98);
        add_triangle(m, a, e, d);
        add_triangle(m, e, c, d);
        add_triangle(m, e, b, c);
        if (random.chance(0.5)) add_triangle(m, e, b, e + (c - e) * random.between(0.01, 0.1));
      }
    }
  }
  return m;
}

}  // namespace scenes
