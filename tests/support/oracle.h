#pragma once
/// \file
/// Brute-force distances in higher precision, to judge faster results.
///
/// Shares nothing with the library: no supporting planes, no advance, no early return. A body at rest is its axis, a
/// point or a segment. A moving body is the segment or parallelogram that its axis sweeps. The distance of two flat
/// convex polygons is the least of all vertex-polygon, edge-edge and edge-polygon distances (the last is 0). All
/// candidates are tried. Each is the distance of two points of the polygons, so a wrong branch can only make the result
/// too large, never too small.
///
/// `Real` is long double (64-bit mantissa on x86, error about 1e-17 m at a reach of 100 m; 0.4 us for a sphere) or
/// oracle::Quad (113 bits, error about 1e-31 m; ten times slower). Coordinates are relative to the triangle before
/// anything is multiplied. Slivers thinner than 1e-9 of their length need Quad.
///
///     oracle::distance(body, place, triangle)                     clearance of the axis, long double
///     oracle::distance<oracle::Quad>(body, place, triangle)       the same in quad
///     oracle::least_distance<Real>(body, from, motion, t, tri)    least clearance over [0, t] of the motion
///
/// All are distances of the axis: subtract body.radius for the gap. 0, but for rounding, when axis and
/// triangle meet.

#include <cfloat>
#include <cmath>

#include "roam/mesh.h"
#include "roam/sweep.h"

namespace oracle {

#if LDBL_MANT_DIG >= 113
using Quad = long double;
#else
__extension__ typedef __float128 Quad;
#endif

inline long double root(long double x) { return std::sqrt(x); }

#if LDBL_MANT_DIG < 113
/// Two Newton steps from the 64-bit root; exact to the last digits of 113 bits.
inline Quad root(Quad x) {
  if (!(x > 0)) return 0;
  // Far below the range of a long double only the distance 0 matters.
  Quad y = std::sqrt(static_cast<long double>(x));
  if (!(y > 0)) return 0;
  for (int step = 0; step < 2; ++step) y = (y + x / y) / 2;
  return y;
}
#endif

template <class Real>
struct Point {
  Real x, y, z;
  friend Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend Point operator-(const Point& a, const Point& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend Point operator*(const Real& s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class Real>
Real dot(const Point<Real>& a, const Point<Real>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class Real>
Point<Real> cross(const Point<Real>& a, const Point<Real>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// A flat convex polygon of up to four corners in order; two corners are a segment, one is a point.
template <class Real>
struct Polygon {
  int corners;
  Point<Real> corner[4];

  [[nodiscard]] int edges() const { return corners == 2 ? 1 : (corners == 1 ? 0 : corners); }
  [[nodiscard]] const Point<Real>& next(int i) const { return corner[(i + 1) % corners]; }
};

template <class Real>
void take_less(Real& least, const Real& candidate) {
  if (candidate < least) least = candidate;
}

template <class Real>
Real squared_distance(const Point<Real>& p, const Point<Real>& a, const Point<Real>& b) {
  const Point<Real> e = b - a;
  const Real ee = dot(e, e);
  Real s = ee > 0 ? dot(p - a, e) / ee : Real(0);
  s = s < 0 ? Real(0) : (s > 1 ? Real(1) : s);
  const Point<Real> x = p - (a + s * e);
  return dot(x, x);
}

/// The foot of `p` on the triangle's plane if it falls inside; the edges have their own functions.
template <class Real>
void lessen_by_foot(const Point<Real>& p, const Point<Real>& a, const Point<Real>& b, const Point<Real>& c,
                    Real& least) {
  const Point<Real> ab = b - a, ac = c - a, ap = p - a, n = cross(ab, ac);
  const Real nn = dot(n, n);
  if (!(nn > 0)) return;
  const Real v = dot(cross(ap, ac), n) / nn, w = dot(cross(ab, ap), n) / nn;
  if (v < 0 || w < 0 || v + w > 1) return;
  const Point<Real> x = ap - (v * ab + w * ac);
  take_less(least, dot(x, x));
}

template <class Real>
void lessen_by_corners(const Polygon<Real>& a, const Polygon<Real>& b, Real& least) {
  for (int i = 0; i < a.corners; ++i) {
    const Point<Real>& p = a.corner[i];
    take_less(least, squared_distance(p, b.corner[0], b.corner[0]));
    for (int j = 0; j < b.edges(); ++j) take_less(least, squared_distance(p, b.corner[j], b.next(j)));
    for (int j = 2; j < b.corners; ++j) lessen_by_foot(p, b.corner[0], b.corner[j - 1], b.corner[j], least);
  }
}

template <class Real>
void lessen_by_edges(const Polygon<Real>& a, const Polygon<Real>& b, Real& least) {
  for (int i = 0; i < a.edges(); ++i) {
    for (int j = 0; j < b.edges(); ++j) {
      const Point<Real> d = a.next(i) - a.corner[i], e = b.next(j) - b.corner[j], r = b.corner[j] - a.corner[i];
      const Point<Real> n = cross(d, e);
      const Real nn = dot(n, n);
      if (!(nn > 0)) continue;
      const Real s = dot(cross(r, e), n) / nn;
      if (s < 0 || s > 1) continue;
      // Nearly parallel edges make s inexact, but change the distance only by its square.
      take_less(least, squared_distance(a.corner[i] + s * d, b.corner[j], b.next(j)));
    }
  }
}

/// The point where the segment crosses the triangle's plane, if it is inside: distance 0, except for rounding.
template <class Real>
void lessen_by_piercing(const Point<Real>& p, const Point<Real>& q, const Point<Real>& a, const Point<Real>& b,
                        const Point<Real>& c, Real& least) {
  const Point<Real> ab = b - a, ac = c - a, n = cross(ab, ac);
  const Real nn = dot(n, n), before = dot(p - a, n), after = dot(q - a, n);
  if (!(nn > 0) || before == after || (before > 0 && after > 0) || (before < 0 && after < 0)) return;
  const Point<Real> x = p + (before / (before - after)) * (q - p), ax = x - a;
  const Real v = dot(cross(ax, ac), n) / nn, w = dot(cross(ab, ax), n) / nn;
  if (v < 0 || w < 0 || v + w > 1) return;
  const Point<Real> apart = ax - (v * ab + w * ac);
  take_less(least, dot(apart, apart));
}

template <class Real>
void lessen_by_piercing(const Polygon<Real>& a, const Polygon<Real>& b, Real& least) {
  for (int i = 0; i < a.edges(); ++i) {
    for (int j = 2; j < b.corners; ++j) {
      lessen_by_piercing(a.corner[i], a.next(i), b.corner[0], b.corner[j - 1], b.corner[j], least);
    }
  }
}

template <class Real>
Real distance(const Polygon<Real>& a, const Polygon<Real>& b) {
  const Point<Real> x = a.corner[0] - b.corner[0];
  Real least = dot(x, x);
  lessen_by_corners(a, b, least);
  lessen_by_corners(b, a, least);
  lessen_by_edges(a, b, least);
  lessen_by_piercing(a, b, least);
  lessen_by_piercing(b, a, least);
  return root(least);
}

template <class Real>
Point<Real> widen(const roam::Vec3& v) {
  return {Real(v.x), Real(v.y), Real(v.z)};
}

/// The triangle with its first corner at the origin.
template <class Real>
Polygon<Real> at_origin(const roam::Triangle& t) {
  const Point<Real> a = widen<Real>(t[0]);
  return {3, {a - a, widen<Real>(t[1]) - a, widen<Real>(t[2]) - a, {}}};
}

/// Distance of the axis of `body` at `place` to the triangle, in metres; 0, except for rounding, if they meet.
template <class Real = long double>
Real distance(const roam::Body& body, const roam::Vec3& place, const roam::Triangle& triangle) {
  const Point<Real> c = widen<Real>(place) - widen<Real>(triangle[0]), h{0, 0, Real(body.half_height)};
  const Polygon<Real> axis =
      body.half_height > 0.0 ? Polygon<Real>{2, {c - h, c + h, {}, {}}} : Polygon<Real>{1, {c, {}, {}, {}}};
  return distance(axis, at_origin<Real>(triangle));
}

/// The same for the axis at from + t * motion, which need not be a double.
template <class Real = long double>
Real distance_on_the_way(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion, double t,
                         const roam::Triangle& triangle) {
  const Point<Real> c = widen<Real>(from) - widen<Real>(triangle[0]) + Real(t) * widen<Real>(motion),
                    h{0, 0, Real(body.half_height)};
  const Polygon<Real> axis =
      body.half_height > 0.0 ? Polygon<Real>{2, {c - h, c + h, {}, {}}} : Polygon<Real>{1, {c, {}, {}, {}}};
  return distance(axis, at_origin<Real>(triangle));
}

/// Least distance of the axis to the triangle over [0, t] of the motion, in metres; 0, except for rounding, if they
/// meet on the way.
template <class Real = long double>
Real least_distance(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion, double t,
                    const roam::Triangle& triangle) {
  const Point<Real> a = widen<Real>(from) - widen<Real>(triangle[0]), b = a + Real(t) * widen<Real>(motion),
                    h{0, 0, Real(body.half_height)};
  const Polygon<Real> swept =
      body.half_height > 0.0 ? Polygon<Real>{4, {a - h, a + h, b + h, b - h}} : Polygon<Real>{2, {a, b, {}, {}}};
  return distance(swept, at_origin<Real>(triangle));
}

}  // namespace oracle
