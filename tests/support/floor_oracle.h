#pragma once
/// \file
/// Finds floor by brute force, to judge Space::floor_clearance of any space.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "clutter.h"
#include "oracle.h"
#include "roam/space.h"

namespace floor_oracle {

using roam::Body;
using roam::Floor;
using roam::Triangle;
using roam::Vec3;

constexpr double slope_limit = 40.0;  // degrees
/// No triangle of the scenes is this near to the limit, degrees, because storing may turn it.
constexpr double undecided = 2.0;

inline double slope_degrees(const Triangle& t) {
  const auto point = [](const Vec3& v) { return oracle::Point<long double>{v.x, v.y, v.z}; };
  const auto n = oracle::cross(point(t[1]) - point(t[0]), point(t[2]) - point(t[0]));
  const long double level = std::sqrt(n.x * n.x + n.y * n.y);
  return static_cast<double>(std::atan2(level, std::abs(n.z)) * 180.0L / std::numbers::pi_v<long double>);
}

/// Triangles of 0.3 to 2 m, half of them fairly level, in a box of half side 4 m about `centre`.
inline roam::Mesh scene(clutter::Random& random, const Vec3& centre, int count) {
  roam::Mesh mesh;
  while (static_cast<int>(mesh.triangles.size()) < count) {
    const double size = random.between(0.5, 3.0);
    const Vec3 at = centre + random.in_box(4.0);
    const Vec3 flat(1.0, 1.0, random.engine() % 2 == 0 ? 1.0 : 0.3);
    const Triangle t{at, at + size * flat * random.in_box(0.5), at + size * flat * random.in_box(0.5)};
    double shortest = 1e9;  // of the heights over the three sides
    const auto area = [&] {
      const Vec3 a = t[1] - t[0], b = t[2] - t[0];
      return std::sqrt(std::pow(a.y * b.z - a.z * b.y, 2) + std::pow(a.z * b.x - a.x * b.z, 2) +
                       std::pow(a.x * b.y - a.y * b.x, 2));
    }();
    for (int k = 0; k < 3; ++k) {
      const Vec3 side = t[(k + 1) % 3] - t[k];
      shortest = std::min(shortest, area / std::sqrt(side.x * side.x + side.y * side.y + side.z * side.z));
    }
    if (shortest < 0.1 || std::abs(slope_degrees(t) - slope_limit) < undecided) continue;
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), t.begin(), t.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  return mesh;
}

/// The distance of the resting body's axis to the floor, in long double; `far` if there is none.
inline double distance(std::span<const Triangle> triangles, const Body& body, const Vec3& place, const Floor& floor,
                       double far) {
  using Point = oracle::Point<long double>;
  long double least = far;
  for (const Triangle& t : triangles) {
    if (slope_degrees(t) > floor.slope_degrees) continue;
    std::vector<Point> part;
    for (const Vec3& v : t) part.push_back(Point{v.x, v.y, v.z} - Point{place.x, place.y, place.z});
    for (const int side : {1, -1}) {
      if (!std::isfinite(floor.band)) break;
      const auto beyond = [&](const Point& p) {
        const Point from = p - (Point{floor.point.x, floor.point.y, floor.point.z} - Point{place.x, place.y, place.z});
        const long double rise = -(floor.normal.x * from.x + floor.normal.y * from.y) / floor.normal.z;
        return side * (from.z - rise) - floor.band;
      };
      std::vector<Point> rest;
      for (std::size_t i = 0; i < part.size(); ++i) {
        const Point &a = part[i], &b = part[(i + 1) % part.size()];
        const long double from = beyond(a), to = beyond(b);
        if (from <= 0.0L) rest.push_back(a);
        if ((from <= 0.0L) != (to <= 0.0L)) rest.push_back(a + (from / (from - to)) * (b - a));
      }
      part = rest;
    }
    for (std::size_t i = 2; i < part.size(); ++i) {
      const auto corner = [&](const Point& p) {
        return Vec3(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
      };
      const Triangle piece{corner(part[0]), corner(part[i - 1]), corner(part[i])};
      least = std::min(least, oracle::distance(body, Vec3(0.0), piece));
    }
  }
  return static_cast<double>(least);
}

/// Queries `space`, which stores to `error` (m), at many places. Every result must agree with brute force to 2 mm.
inline void judge(const roam::Space& space, std::span<const Triangle> triangles, const Vec3& centre, double error,
                  int queries, std::uint64_t seed) {
  clutter::Random random(seed);
  int found = 0, banded = 0, none = 0;
  for (int i = 0; i < queries; ++i) {
    SCOPED_TRACE(i);
    const Body body{random.engine() % 3 == 0 ? 0.0 : random.between(0.05, 0.5),
                    random.engine() % 3 == 0 ? 0.0 : random.between(0.1, 1.2)};
    const Vec3 place = centre + random.in_box(5.0);
    const double reach = random.between(0.1, 2.0);
    Floor floor;
    floor.slope_degrees = slope_limit;
    // The stored triangles decide which part lies in a band.
    double wider = 0.0;
    if (i % 3 != 0) {
      floor.band = random.between(0.0, 0.6);
      floor.point = place + random.in_box(1.0);
      floor.normal = Vec3(random.between(-0.5, 0.5), random.between(-0.5, 0.5), 1.0);
      wider = 3.0 * error + 1e-7;
    }
    const roam::Clearance c = space.floor_clearance(body, place, reach, floor);
    EXPECT_FALSE(c.unknown);
    Floor narrow = floor, wide = floor;
    narrow.band = floor.band - wider;
    wide.band = floor.band + wider;
    const double most = distance(triangles, body, place, narrow, 99.0) - body.radius;
    const double least = distance(triangles, body, place, wide, 99.0) - body.radius;
    ASSERT_LE(c.distance, std::max(most, -body.radius) + 1e-6);
    // If the axis meets a triangle, brute force does not know the depth.
    if (least > -body.radius + 1e-3) {
      ASSERT_GE(c.distance, std::min(least, reach) - 2.1e-3);
    }
    ASSERT_EQ(c.found, c.distance < reach || c.found);
    if (c.found) ++(std::isfinite(floor.band) ? banded : found);
    none += c.found ? 0 : 1;
  }
  EXPECT_GT(found, queries / 10);
  EXPECT_GT(banded, queries / 20);
  EXPECT_GT(none, queries / 20);
}

inline std::vector<Triangle> triangles_of(const roam::Mesh& mesh) {
  std::vector<Triangle> all;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) all.push_back(mesh.triangle(i));
  return all;
}

}  // namespace floor_oracle
