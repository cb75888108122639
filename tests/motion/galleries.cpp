// Galleries with doors that only a slim body passes and splits that only a wide foot bears: both at once.

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "roam/route.h"
#include "walker_scenes.h"

namespace {

using namespace scenes;
using roam::World;

/// A corridor along x, 3 m wide and high, whose floor ends at its walls, with three oblique doors and three oblique
/// splits from wall to wall.
struct Gallery {
  static constexpr double half_width = 1.5, length = 62.0;
  Mesh mesh;
  std::vector<Vec3> path;       ///< of the body's centre, 0.95 m above the floor
  double narrowest_door = 9.0;  ///< metres
  double widest_split = 0.0;

  explicit Gallery(std::uint64_t seed) {
    Random random(1000003 * seed);  // neighbouring seeds share their numbers
    for (const double y : {-half_width, half_width}) add_wall(mesh, 0.0, y, length, y, -60.0, 3.0);
    add_floor(mesh, 0.0, -half_width, length, half_width, 3.0);
    path.emplace_back(1.5, 0.0, 0.95);
    double left[2] = {0.0, 0.0};  // where the floor begins at either wall
    double level = 0.0;
    for (int i = 0; i < 3; ++i) {
      add_door(random, 10.0 + 17.0 * i + random.between(-1.0, 1.0), level);
      const double next = random.chance(0.5) ? level + random.between(-0.2, 0.2) : level;
      add_split(random, 18.0 + 17.0 * i + random.between(-1.0, 1.0), left, level, next);
      level = next;
    }
    add_floor_between(left, length, length, level);
    path.emplace_back(length - 1.5, 0.0, level + 0.95);
  }

 private:
  void add_floor_between(const double (&left)[2], double right_low, double right_high, double level) {
    add_quad(mesh, {left[0], -half_width, level}, {right_low, -half_width, level}, {right_high, half_width, level},
             {left[1], half_width, level});
  }

  /// The floor up to a split, and the split.
  void add_split(Random& random, double x, double (&left)[2], double level, double next) {
    const double width = random.between(0.3, 1.25), angle = random.between(-0.5, 0.5);
    const double depth = random.chance(0.5) ? 2.0 : 50.0, lean = half_width * std::tan(angle);
    widest_split = std::max(widest_split, width);
    const double across = width / std::cos(angle);
    add_floor_between(left, x - lean, x + lean, level);
    left[0] = x - lean + across;
    left[1] = x + lean + across;
    add_wall(mesh, x - lean, -half_width, x + lean, half_width, level - depth, level);
    add_wall(mesh, left[0], -half_width, left[1], half_width, level - depth, next);
    add_quad(mesh, {x - lean, -half_width, level - depth}, {left[0], -half_width, level - depth},
             {left[1], half_width, level - depth}, {x + lean, half_width, level - depth});
  }

  void add_door(Random& random, double x, double level) {
    const double width = random.between(0.7, 1.1), thick = random.between(0.0, 0.4), angle = random.between(-0.5, 0.5);
    const double sill = random.chance(0.4) ? 0.15 : 0.0, y = random.between(-0.4, 0.4);
    narrowest_door = std::min(narrowest_door, width);
    const Vec3 across(-std::sin(angle), std::cos(angle), 0.0), ahead(std::cos(angle), std::sin(angle), 0.0);
    const Vec3 middle(x, y, level);
    const auto block = [&](double from, double to, double top) {
      Mesh box;
      add_box(box, {-0.5 * thick, from, -0.5}, {0.5 * thick, to, top});
      for (std::size_t i = 0; i < box.triangles.size(); ++i) {
        roam::Triangle t = box.triangle(i);
        for (Vec3& v : t) v = middle + v.x * ahead + v.y * across + Vec3(0.0, 0.0, v.z);
        add_triangle(mesh, t[0], t[1], t[2]);
      }
    };
    block(-4.0, -0.5 * width, 3.0);
    block(0.5 * width, 4.0, 3.0);
    if (sill > 0.0) block(-0.5 * width, 0.5 * width, sill);
    for (const double beside : {-1.5, 1.5}) path.push_back(middle + beside * ahead + Vec3(0.0, 0.0, 0.95));
  }
};

roam::RouteResult walk(const Gallery& gallery, const World& world, double radius, double support_radius) {
  roam::WalkerSettings s;
  s.radius = radius;
  s.support_radius = support_radius;
  s.height = 1.9;
  s.slope_degrees = 50.0;
  roam::Walker walker(world, s, roam::Mode::walk, gallery.path.front());
  return roam::follow(walker, gallery.path, {.speed = 1.4, .dt = 1.0 / 60.0});
}

TEST(Galleries, AreWalkedByASlimBodyWithAWideDiscAndByNoOther) {
  int fallen = 0;
  for (std::uint64_t seed = 0; seed < 50; ++seed) {
    const Gallery gallery(seed);
    const World world = build(gallery.mesh);
    const double slim = 0.97 * 0.5 * gallery.narrowest_door, half = 0.5 * gallery.widest_split;
    const roam::RouteResult result = walk(gallery, world, slim, half + 0.02);
    EXPECT_EQ(result.outcome, roam::Outcome::reached)
        << "seed " << seed << ": " << roam::to_string(result.outcome) << " at " << result.end.x << " " << result.end.y
        << " " << result.end.z;
    EXPECT_GE(result.least_gap, -1e-6);
    EXPECT_EQ(walk(gallery, world, 1.02 * 0.5 * gallery.narrowest_door, half + 0.02).outcome, roam::Outcome::blocked)
        << "seed " << seed;
    if (slim > half - 0.02) continue;  // it bears itself, or nearly
    ++fallen;
    EXPECT_EQ(walk(gallery, world, slim, half - 0.02).outcome, roam::Outcome::fell) << "seed " << seed;
  }
  EXPECT_GE(fallen, 30);
}

}  // namespace
