#pragma once
/// \file
/// Sphere and vertical capsule against a triangle, in closed form, at any precision. See reference.h.

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <limits>

#include "roam/mesh.h"

namespace roam::bench {

template <class Real>
using Point = glm::vec<3, Real, glm::highp>;

template <class Real>
using Corners = std::array<Point<Real>, 3>;

/// The point of the triangle nearest to the origin (Ericson, 5.1.5; edges first, so that slivers need no special case).
template <class Real>
[[nodiscard]] Point<Real> nearest_to_origin(const Corners<Real>& corner) {
  Point<Real> best = corner[0];
  Real best_square = std::numeric_limits<Real>::infinity();
  const auto keep = [&](const Point<Real>& p) {
    const Real square = glm::dot(p, p);
    if (square < best_square) {
      best_square = square;
      best = p;
    }
  };
  for (int i = 0; i < 3; ++i) {
    const Point<Real>& a = corner[i];
    const Point<Real> e = corner[(i + 1) % 3] - a;
    const Real ee = glm::dot(e, e);
    const Real s = ee > 0 ? std::clamp(-glm::dot(a, e) / ee, Real(0), Real(1)) : Real(0);
    keep(a + s * e);
  }
  const Point<Real> n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const Real nn = glm::dot(n, n);
  if (nn > 0) {
    const Point<Real> foot = (glm::dot(n, corner[0]) / nn) * n;
    bool inside = true;
    for (int i = 0; i < 3; ++i) {
      const Point<Real> e = corner[(i + 1) % 3] - corner[i];
      inside = inside && glm::dot(glm::cross(e, foot - corner[i]), n) >= 0;
    }
    if (inside) keep(foot);
  }
  return best;
}

/// First t in [0, limit) at which t * motion is within `radius` of the triangle; `limit` when there is none.
template <class Real>
[[nodiscard]] Real time_of_impact(const Corners<Real>& corner, const Point<Real>& motion, Real radius, Real limit) {
  const Point<Real> start = nearest_to_origin(corner);
  if (glm::dot(start, start) <= radius * radius) return 0;
  Real first = limit;
  const auto keep = [&](Real t) {
    if (t >= 0 && t < first) first = t;
  };
  // The root at which t * t * a + 2 * t * b + c falls to zero.
  const auto entry = [](Real a, Real b, Real c) {
    const Real square = b * b - a * c;
    if (!(a > 0) || !(b < 0) || !(square >= 0)) return Real(-1);
    return c / (std::sqrt(square) - b);
  };
  const Point<Real> n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const Real length = glm::length(n);
  if (length > 0) {
    const Real height = -glm::dot(n, corner[0]) / length;  // signed, of the start above the plane
    const Real side = height >= 0 ? Real(1) : Real(-1);
    const Real approach = -side * glm::dot(n, motion) / length;
    if (approach > 0 && std::abs(height) > radius) {
      const Real t = (std::abs(height) - radius) / approach;
      const Point<Real> p = t * motion - (side * radius / length) * n;
      bool inside = true;
      for (int i = 0; i < 3; ++i) {
        const Point<Real> e = corner[(i + 1) % 3] - corner[i];
        inside = inside && glm::dot(glm::cross(e, p - corner[i]), n) >= 0;
      }
      if (inside) keep(t);
    }
  }
  const Real speed_square = glm::dot(motion, motion);
  for (int i = 0; i < 3; ++i) {
    const Point<Real>& a = corner[i];
    keep(entry(speed_square, -glm::dot(motion, a), glm::dot(a, a) - radius * radius));
    const Point<Real> e = corner[(i + 1) % 3] - a;
    const Real ee = glm::dot(e, e);
    const Point<Real> across = glm::cross(motion, e);
    const Point<Real> arm = glm::cross(a, e);
    const Real t = entry(glm::dot(across, across), -glm::dot(across, arm), glm::dot(arm, arm) - radius * radius * ee);
    if (t < 0 || t >= first) continue;
    const Real along = glm::dot(t * motion - a, e);
    if (along >= 0 && along <= ee) keep(t);
  }
  return first;
}

/// Calls `visit` with triangles whose union is the surface of the triangle extruded by `half_height` up and down.
template <class Real, class Visit>
void extrude(const Corners<Real>& corner, Real half_height, const Visit& visit) {
  if (half_height == 0) {
    visit(corner);
    return;
  }
  const Point<Real> h{0, 0, half_height};
  visit(Corners<Real>{corner[0] + h, corner[1] + h, corner[2] + h});
  visit(Corners<Real>{corner[0] - h, corner[1] - h, corner[2] - h});
  for (int i = 0; i < 3; ++i) {
    const Point<Real>& a = corner[i];
    const Point<Real>& b = corner[(i + 1) % 3];
    visit(Corners<Real>{a - h, b - h, b + h});
    visit(Corners<Real>{a - h, b + h, a + h});
  }
}

/// Whether the vertical segment of `half_height` about the origin meets the triangle.
template <class Real>
[[nodiscard]] bool axis_meets(const Corners<Real>& corner, Real half_height) {
  if (half_height == 0) return false;
  const Point<Real> up{0, 0, 1};
  const Point<Real> n = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  if (n.z == 0) return false;  // a vertical triangle is covered by its edges
  const Real z = glm::dot(n, corner[0]) / n.z;
  if (std::abs(z) > half_height) return false;
  int turn = 0;
  for (int i = 0; i < 3; ++i) {
    const Point<Real> e = corner[(i + 1) % 3] - corner[i];
    const Real side = glm::dot(glm::cross(e, z * up - corner[i]), n);
    turn += side >= 0 ? 1 : 0;
  }
  return turn == 3;
}

}  // namespace roam::bench
