// Where the foot must not carry: over cliffs, pits and whatever a disc as large finds room in.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "floor_oracle.h"
#include "support_scenes.h"

namespace {

using namespace scenes;

/// Walks over the edge with and without a foot: nothing must be different.
void must_not_carry(const Mesh& m, double support_radius, const Vec3& start, const Vec3& velocity, const char* what) {
  for (const double dt : steps) {
    Walk with(m, person(support_radius), Mode::walk, start), without(m, person(0.0), Mode::walk, start);
    for (int i = 0; i < static_cast<int>(4.0 / dt); ++i) {
      with.step(velocity, dt);
      without.step(velocity, dt);
      ASSERT_EQ(with.walker.position(), without.walker.position()) << what << ", step " << i << " of " << dt << " s";
    }
    EXPECT_EQ(with.count(EventKind::bridged), 0) << what;
  }
}

TEST(Overhang, NeverOverhangsACliffAPitOrTheEndOfTheFloor) {
  Mesh cliff;
  add_floor(cliff, -20.0, -10.0, 0.0, 10.0, 0.0);
  add_wall(cliff, 0.0, -10.0, 0.0, 10.0, -30.0, 0.0);
  add_floor(cliff, 0.0, -10.0, 30.0, 10.0, -30.0);
  Mesh end;
  add_floor(end, -20.0, -10.0, 0.0, 10.0, 0.0);
  for (const double speed : speeds) {
    must_not_carry(cliff, 1.0, {-0.7, 0.1, 0.95}, {speed, 0.0, 0.0}, "cliff");
    must_not_carry(split(3.0, 5.0), 1.0, {-0.7, 0.1, 0.95}, {speed, 0.3 * speed, 0.0}, "pit");
    must_not_carry(split(3.0, 0.6), 1.45, {-0.7, 0.1, 0.95}, {speed, 0.0, 0.0}, "shallow pit");
    must_not_carry(end, 1.0, {-0.7, 0.1, 0.95}, {speed, 0.0, 0.0}, "end of the floor");
  }
}

TEST(Overhang, NeverOverhangsALedgeThatIsADiscHigh) {
  Mesh m;
  add_floor(m, -20.0, -10.0, 0.0, 10.0, 0.0);
  add_wall(m, 0.0, -10.0, 0.0, 10.0, -0.4, 0.0);
  add_floor(m, 0.0, -10.0, 20.0, 10.0, -0.4);
  must_not_carry(m, 0.7, {-0.7, 0.1, 0.95}, {1.4, 0.0, 0.0}, "ledge");
}

/// A corridor of `width` along x whose floor ends at its walls, with a split from x = 0 on.
Mesh corridor(double width, double gap) {
  Mesh m;
  const double half = 0.5 * width;
  add_floor(m, -10.0, -half, 0.0, half, 0.0);
  add_floor(m, gap, -half, 10.0, half, 0.0);
  for (const double y : {-half, half}) add_wall(m, -10.0, y, 10.0, y, -5.0, 3.0);
  return m;
}

TEST(Overhang, CarriesBesideTheWallsOfACorridorWhoseFloorEndsThere) {
  const Mesh m = corridor(2.0, 1.25);
  for (const double y : {0.0, 0.3, 0.69, -0.69}) {
    for (const double more : {0.002, 0.02, 0.2}) {
      Walk w(m, person(0.625 + more), Mode::walk, {-0.7, y, 0.95});
      const Crossing c = cross(w, {1.4, 0.3 * y, 0.0}, frame, 2.0);
      EXPECT_TRUE(c.across) << y << " " << more;
      EXPECT_GT(c.lowest, -near_ground) << y << " " << more;
    }
  }
}

TEST(Overhang, NeverOverhangsAPitBetweenNearWalls) {
  must_not_carry(corridor(1.0, 4.0), 0.7, {-0.7, 0.0, 0.95}, {1.4, 0.0, 0.0}, "pit in a corridor");
  must_not_carry(corridor(1.0, 1.5), 0.7, {-0.7, 0.1, 0.95}, {7.0, 0.0, 0.0}, "wide split in a corridor");
}

TEST(Overhang, DoesNotCarryOverAHoleJoinedToAnOpenDrop) {
  Mesh m;  // a slot of 0.7 m that opens into a pit of 4 m
  add_floor(m, -10.0, -10.0, 10.0, -0.35, 0.0);
  add_floor(m, -10.0, 0.35, 10.0, 10.0, 0.0);
  add_floor(m, -10.0, -0.35, -4.0, 0.35, 0.0);
  Mesh pit = m;
  pit.vertices.clear();
  pit.triangles.clear();
  add_floor(pit, -10.0, -10.0, 0.0, -0.35, 0.0);
  add_floor(pit, -10.0, 0.35, 0.0, 10.0, 0.0);
  add_floor(pit, -10.0, -0.35, -4.0, 0.35, 0.0);
  // Along the slot it is carried, up to where a disc of its foot finds room.
  Walk w(pit, person(0.45), Mode::walk, {-5.0, 0.0, 0.95});
  for (int i = 0; i < 600 && !w.walker.report().has(EventKind::fell); ++i) w.step({1.4, 0.0, 0.0});
  EXPECT_TRUE(w.walker.report().has(EventKind::fell));
  EXPECT_GT(w.count(EventKind::bridged), 0);
  // A disc of 0.45 m reaches back over the slot by what its rim bulges in: less than 0.3 m.
  EXPECT_GT(w.walker.position().x, -0.3);
  EXPECT_LT(w.walker.position().x, 0.5);
}

/// Whether a disc of `radius` that holds the axis is free of floor, tried place by place.
bool brute_free_disc(std::span<const roam::Triangle> floor, double level, const Vec3& axis, double radius) {
  constexpr double spacing = 0.03;
  for (double x = -radius; x <= radius; x += spacing) {
    for (double y = -radius; y <= radius; y += spacing) {
      if (x * x + y * y > radius * radius) continue;
      const Vec3 centre(axis.x + x, axis.y + y, level);
      const roam::Floor band{floor_oracle::slope_limit, 0.25, centre, Vec3(0.0, 0.0, 1.0)};
      if (floor_oracle::distance(floor, {0.0, 0.25}, centre, band, 9.0) >= radius) return true;
    }
  }
  return false;
}

TEST(Overhang, CarriesNowhereAFreeDiscHasRoomInRandomHoles) {
  int carried = 0, fallen = 0;
  for (std::uint64_t seed = 0; seed < 24; ++seed) {
    Random random(1000003 * seed);
    // Level slabs with gaps of all widths between them, at slightly different heights.
    Mesh m;
    double x = -4.0;
    while (x < 6.0) {
      const double end = x + random.between(0.3, 1.2);
      double y = -3.0;
      while (y < 3.0) {
        const double top = y + random.between(0.5, 3.0);
        add_floor(m, x, y, end, top, random.between(-0.05, 0.05));
        y = top + (random.chance(0.5) ? random.between(0.1, 1.2) : 0.0);
      }
      x = end + (random.chance(0.5) ? random.between(0.1, 1.2) : 0.0);
    }
    add_floor(m, -6.0, -1.0, -3.6, 1.0, 0.0);
    const std::vector<roam::Triangle> floor = floor_oracle::triangles_of(m);
    const double foot = random.between(0.3, 0.7), speed = std::pow(10.0, random.between(-0.4, 1.7));
    const double dt = random.between(1.0 / 240.0, 1.0 / 25.0);
    Walk w(m, person(foot, 0.2), Mode::walk, {-5.0, 0.0, 0.95});
    for (int i = 0; i < 3000 && w.walker.position().x < 5.0; ++i) {
      const StepReport& r = w.step({speed, 0.3 * speed * std::sin(0.02 * i), 0.0}, dt);
      if (r.bridging) {
        ++carried;
        // A millimetre for what storing may cost.
        if (carried % 97 == 0) {
          ASSERT_FALSE(brute_free_disc(floor, w.feet(), r.to, foot + 1e-3)) << seed << " " << i;
        }
      }
      if (r.has(EventKind::fell)) {
        ++fallen;
        break;
      }
    }
  }
  EXPECT_GT(carried, 200);
  EXPECT_GT(fallen, 5);
}

}  // namespace
