/// \file
/// Bodies that something keeps from going on: what they say, and how much they ask of the space.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "changing_room.h"

namespace {

using namespace scenes;

TEST(Wedged, ABodyIsSaidToBeBlockedOnce) {
  Mesh m = floor_mesh();
  add_wall(m, 2.0, -10.0, 2.0, 10.0, 0.0, 3.0);
  for (const Mode mode : {Mode::walk, Mode::fly}) {
    for (const double speed : {1.4, 60.0}) {
      SCOPED_TRACE(testing::Message() << to_string(mode) << ' ' << speed);
      Walk w(m, {}, mode, {0.0, 0.0, 0.91});
      while (!w.step({speed, 0.0, 0.0}).blocked) {
      }
      for (int i = 0; i < 60; ++i) EXPECT_TRUE(w.step({speed, 0.0, 0.0}).blocked);
      EXPECT_EQ(w.count(EventKind::blocked), 1);
      w.go({-1.0, 0.0, 0.0}, 0.2);
      EXPECT_FALSE(w.walker.report().blocked);
      w.go({speed, 0.0, 0.0}, 1.0);
      EXPECT_TRUE(w.walker.report().blocked);
      EXPECT_EQ(w.count(EventKind::blocked), 2);
      w.walker.place({1.0, 5.0, 0.91});
      w.go({speed, 0.0, 0.0}, 1.0);
      EXPECT_EQ(w.count(EventKind::blocked), 3);
      // What says no wish leaves it as it is.
      w.walker.resize(0.3, 0.0);
      EXPECT_FALSE(w.step({speed, 0.0, 0.0}).has(EventKind::blocked));
      EXPECT_TRUE(w.walker.report().blocked);
    }
  }
}

/// A slope that goes down along y, and a steep bank beside it that leans away.
Mesh bank(double slope, double lean) {
  Mesh m;
  const auto z = [&](double y) { return -y * std::tan(slope * std::numbers::pi / 180.0); };
  const double over = 4.0 * std::tan(lean * std::numbers::pi / 180.0);
  add_quad(m, {-8.0, -8.0, z(-8.0)}, {3.0, -8.0, z(-8.0)}, {3.0, 8.0, z(8.0)}, {-8.0, 8.0, z(8.0)});
  add_quad(m, {2.0, -8.0, z(-8.0)}, {2.0, 8.0, z(8.0)}, {2.0 + over, 8.0, z(8.0) + 4.0},
           {2.0 + over, -8.0, z(-8.0) + 4.0});
  return m;
}

TEST(Wedged, ABodyGoesDownAlongABankThatLeansAway) {
  for (const double slope : {5.0, 20.0, 35.0}) {
    for (const double lean : {0.5, 6.0, 20.0, 35.0}) {
      for (const double turn : {0.0, 0.7, 2.1}) {
        SCOPED_TRACE(testing::Message() << slope << " degrees, a bank " << lean << " off upright, turned by " << turn);
        Mesh m = bank(slope, lean);
        const double c = std::cos(turn), s = std::sin(turn);
        for (Vec3& v : m.vertices) v = Vec3(c * v.x - s * v.y, s * v.x + c * v.y, v.z);
        const Vec3 start(0.5, -4.0, 4.0 * std::tan(slope * std::numbers::pi / 180.0) + 1.0);
        Walk w(m, {}, Mode::walk, {c * start.x - s * start.y, s * start.x + c * start.y, start.z});
        const Vec3 wish(c - s, s + c, 0.0);
        w.go(wish, 1.5);
        const auto along = [&] { return -s * w.walker.position().x + c * w.walker.position().y; };
        const double before = along();
        w.go(wish, 2.0);
        EXPECT_GT(along() - before, 1.5);
      }
    }
  }
}

/// Ground and walls of random facets, as a scan has them.
Mesh rubble(std::uint64_t seed) {
  Random random(seed);
  Mesh m;
  constexpr int cells = 50;
  const double side = 6.0 / cells;
  std::vector<Vec3> grid;
  for (int i = 0; i <= cells; ++i) {
    for (int k = 0; k <= cells; ++k) {
      const double x = -3.0 + side * i, y = -3.0 + side * k;
      const double bowl = 0.9 * std::pow((x * x + y * y) / 4.0, 2.0);
      grid.push_back({x, y, bowl + 0.3 * std::sin(5.0 * x) * std::cos(4.0 * y) + random.between(-0.04, 0.04)});
    }
  }
  const auto at = [&](int i, int k) { return grid[static_cast<std::size_t>(i * (cells + 1) + k)]; };
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) add_quad(m, at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1));
  }
  return m;
}

TEST(Wedged, ABodyThatIsStuckAsksLittle) {
  int stuck = 0, most = 0;
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    ChangingRoom room(rubble(seed), true);
    const Judge judge = room.judge();
    Random random(seed);
    for (int walk = 0; walk < 6; ++walk) {
      Walker w(room, {}, Mode::walk, {random.between(-1.0, 1.0), random.between(-1.0, 1.0), 3.0});
      const double heading = random.between(0.0, 2.0 * std::numbers::pi);
      const double speed = walk % 2 == 0 ? 1.4 : 20.0;
      for (int i = 0; i < 180; ++i) {
        const int before = room.asked();
        const StepReport& r = w.step({.velocity = Vec3(std::cos(heading), std::sin(heading), 0.0) * speed}, frame);
        ASSERT_GE(margin(judge, r, 0.3), 0.0) << seed << ' ' << walk << ' ' << i;
        if (r.from != r.to) continue;
        ++stuck;
        most = std::max(most, room.asked() - before);
        EXPECT_TRUE(r.blocked || r.grounded) << seed << ' ' << walk << ' ' << i;
      }
    }
  }
  EXPECT_GT(stuck, 300);
  EXPECT_LE(most, 30);
  RecordProperty("stuck", stuck);
  RecordProperty("most", most);
}

}  // namespace
