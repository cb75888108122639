/// \file
/// A million seeded random steps in every kind of scene. After each, brute force in long double judges every corner of
/// the move, every straight piece between them, and the certified clearances.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "roam/walker.h"
#include "test_seed.h"
#include "walker_scenes.h"

namespace {

using roam::Mesh;
using roam::Mode;
using roam::Vec3;
using roam::WalkerSettings;

constexpr double side = 6.0;  // metres: half the width of the scenes

/// A closed hall, so that nothing leaves: 12 m by 12 m by 4 m.
Mesh hall() {
  Mesh m;
  scenes::add_box(m, {-side, -side, 0.0}, {side, side, 4.0});
  return m;
}

Vec3 anywhere(scenes::Random& random) {
  return {random.between(-side, side), random.between(-side, side), random.between(0.0, 2.0)};
}

/// Boxes, steps and boards that stand and lean about.
Mesh clutter(scenes::Random& random) {
  Mesh m = hall();
  for (int i = 0; i < 14; ++i) {
    const Vec3 lo = anywhere(random);
    scenes::add_box(
        m, {lo.x, lo.y, 0.0},
        Vec3(lo.x, lo.y, 0.0) + Vec3(random.between(0.05, 2.0), random.between(0.05, 2.0), random.between(0.05, 2.5)));
  }
  for (int i = 0; i < 12; ++i) {
    const Vec3 a = anywhere(random);
    const auto leg = [&] {
      return Vec3(random.between(-1.5, 1.5), random.between(-1.5, 1.5), random.between(-1.0, 1.0));
    };
    scenes::add_triangle(m, a, a + leg(), a + leg());
  }
  return m;
}

/// A vaulted corridor with rough walls, a step, a narrow door and a joint in the floor.
Mesh gallery(scenes::Random& random) {
  Mesh m;
  const int rings = 14, parts = 9;
  std::vector<Vec3> ring[rings + 1];
  for (int i = 0; i <= rings; ++i) {
    const double x = -side + 2.0 * side * i / rings;
    for (int k = 0; k <= parts; ++k) {
      const double a = std::numbers::pi * k / parts, r = random.between(1.15, 1.35);
      ring[i].push_back({x, r * std::cos(a), 1.2 + 1.1 * r * std::sin(a)});
    }
    ring[i].insert(ring[i].begin(), Vec3(x, 1.25, random.between(-0.04, 0.04)));
    ring[i].push_back({x, -1.25, random.between(-0.04, 0.04)});
  }
  for (int i = 0; i < rings; ++i) {
    const std::size_t n = ring[i].size();
    const double sunk = i == 9 ? -3.0 : 0.0;  // one floor field is a shaft
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t l = (k + 1) % n;
      const Vec3 down(0.0, 0.0, l == 0 ? sunk : 0.0);
      scenes::add_quad(m, ring[i][k] + down, ring[i + 1][k] + down, ring[i + 1][l] + down, ring[i][l] + down);
    }
  }
  for (const std::size_t end : {std::size_t{0}, std::size_t{rings}}) {
    for (std::size_t k = 1; k + 1 < ring[end].size(); ++k) {
      scenes::add_triangle(m, ring[end][0], ring[end][k], ring[end][k + 1]);
    }
  }
  scenes::add_box(m, {-2.1, -1.4, -0.1}, {-2.0, -0.35, 3.0});
  scenes::add_box(m, {-2.1, 0.35, -0.1}, {-2.0, 1.4, 3.0});
  scenes::add_box(m, {0.0, -1.5, -0.1}, {1.2, 1.5, 0.22});
  return m;
}

/// Hills with scarps, closed by walls.
Mesh terrain(scenes::Random& random) {
  Mesh m = hall();
  const int n = 16;
  std::vector<double> z;
  for (int i = 0; i < (n + 1) * (n + 1); ++i)
    z.push_back(random.chance(0.12) ? random.between(0.3, 2.2) : 0.5 * random.unit());
  const auto at = [&](int i, int j) {
    return Vec3(-side + 2.0 * side * i / n, -side + 2.0 * side * j / n, z[static_cast<std::size_t>(i * (n + 1) + j)]);
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      if (random.chance(0.5)) {
        scenes::add_quad(m, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
      } else {
        scenes::add_quad(m, at(i + 1, j), at(i + 1, j + 1), at(i, j + 1), at(i, j));
      }
    }
  }
  return m;
}

/// Needles, splinters, points, segments and sheets met edge-on, in a hall.
Mesh slivers(scenes::Random& random) {
  Mesh m = hall();
  for (int i = 0; i < 90; ++i) {
    const Vec3 a = anywhere(random);
    const Vec3 along(random.between(-3.0, 3.0), random.between(-3.0, 3.0), random.between(-1.0, 1.0));
    const double width = random.chance(0.3) ? 5e-6 : (random.chance(0.4) ? 3e-3 : 0.0);
    const Vec3 across(width * random.between(-1.0, 1.0), width * random.between(-1.0, 1.0), width);
    if (random.chance(0.1)) {
      scenes::add_triangle(m, a, a, a);
    } else {
      scenes::add_triangle(m, a, a + along, a + 0.5 * along + across);
    }
  }
  return m;
}

struct Scene {
  const char* name;
  Mesh (*make)(scenes::Random&);
  double half_width;  ///< metres: bodies are put within this of the middle line
};

struct WalkTally {
  long steps = 0, moved = 0, touched = 0, grounded = 0, held = 0;
  double worst = 1.0;
};

/// One random walk: it wanders, turns when blocked, and is now and then put elsewhere. Speeds and time steps are drawn
/// over four decades.
void wander(const roam::World& world, const scenes::Judge& judge, const WalkerSettings& settings, Mode mode,
            const Vec3& origin, double half_width, scenes::Random& random, int steps, WalkTally& tally) {
  const auto somewhere = [&] {
    const Vec3 p = anywhere(random);
    return origin + Vec3(p.x, p.y * (half_width / side), p.z + 0.5 * settings.height);
  };
  roam::Walker walker(world, settings, mode, somewhere());
  double heading = random.between(0.0, 2.0 * std::numbers::pi), climb = 0.0;
  for (int i = 0; i < steps; ++i) {
    if (walker.held() || random.chance(0.002)) {
      walker.place(somewhere());
      if (walker.held()) {
        ++tally.held;
        continue;
      }
      tally.worst = std::min(tally.worst, scenes::margin(judge, walker.report(), settings.radius));
    }
    if (walker.report().blocked || random.chance(0.02)) heading = random.between(0.0, 2.0 * std::numbers::pi);
    if (random.chance(0.05)) climb = random.between(-1.0, 1.0);
    const double speed = random.chance(0.9) ? random.between(0.2, 3.0) : std::pow(10.0, random.between(-2.0, 2.0));
    const double dt = random.chance(0.9) ? 1.0 / 60.0 : std::pow(10.0, random.between(-5.0, -0.5));
    const Vec3 velocity(speed * std::cos(heading), speed * std::sin(heading), speed * climb);
    const roam::StepReport& r = walker.step({velocity, random.chance(0.01), random.chance(0.05)}, dt);
    ++tally.steps;
    tally.moved += r.to != r.from;
    tally.touched += !r.contacts.empty();
    tally.grounded += r.grounded;
    if (speed * dt < 0.06) {
      const auto climbs = std::count_if(r.events.begin(), r.events.end(),
                                        [](const roam::Event& e) { return e.kind == roam::EventKind::stepped_up; });
      ASSERT_LE(climbs, 3) << "it creeps instead of stepping, at " << r.to.x << " " << r.to.y << " " << r.to.z;
    }
    const double margin = scenes::margin(judge, r, settings.radius);
    tally.worst = std::min(tally.worst, margin);
    ASSERT_GE(margin, 0.0) << "step " << i << " from " << r.from.x << " " << r.from.y << " " << r.from.z;
  }
}

class RandomWalks : public testing::TestWithParam<Scene> {
 protected:
  /// 50,000 steps: 5 scenes, each flown and walked by a ball and by a capsule.
  void judge_at(const Vec3& origin, std::uint64_t seed) {
    constexpr int rounds = 5, steps = 2500;
    WalkTally tally;
    for (int round = 0; round < rounds; ++round) {
      scenes::Random random(test_seed(seed * 100 + static_cast<std::uint64_t>(round)));
      Mesh mesh = GetParam().make(random);
      scenes::shift(mesh, origin);
      const roam::World world = scenes::build(mesh, round == 4);
      const scenes::Judge judge(mesh);
      const double radius = random.between(0.15, 0.5);
      const WalkerSettings ball{.radius = radius, .height = 2.0 * radius, .eye = radius, .step = 0.5 * radius};
      for (const WalkerSettings& settings : {WalkerSettings{}, ball}) {
        for (const Mode mode : {Mode::fly, Mode::walk}) {
          wander(world, judge, settings, mode, origin, GetParam().half_width, random, steps, tally);
          if (HasFatalFailure()) return;
        }
      }
    }
    EXPECT_GE(tally.worst, 0.0);
    // The walks are no proof unless they move, touch and stand.
    EXPECT_GT(tally.steps, 45'000);
    EXPECT_GT(tally.moved, tally.steps / 4);
    EXPECT_GT(tally.touched, tally.steps / 20);
    EXPECT_GT(tally.grounded, tally.steps / 10);
    RecordProperty("held", std::to_string(tally.held));
  }
};

TEST_P(RandomWalks, KeepTheirRadiusFromEverythingAtTheOrigin) {
  judge_at({0.0, 0.0, 0.0}, 1);
  judge_at({0.0, 0.0, 0.0}, 2);
}

TEST_P(RandomWalks, KeepTheirRadiusFromEverythingInTheDamGallery) { judge_at({-13739.0, 253.0, 182.0}, 3); }

TEST_P(RandomWalks, KeepTheirRadiusFromEverythingAt6400Kilometres) {
  judge_at({6.4e6, -6.4e6, 6.4e6}, 4);
  judge_at({-6.4e6, 1e5, 3e3}, 5);
}

const Scene kinds[] = {
    {"Clutter", clutter, side}, {"Gallery", gallery, 0.9}, {"Terrain", terrain, side}, {"Slivers", slivers, side}};

INSTANTIATE_TEST_SUITE_P(Scenes, RandomWalks, testing::ValuesIn(kinds),
                         [](const testing::TestParamInfo<Scene>& scene) { return std::string(scene.param.name); });

}  // namespace
