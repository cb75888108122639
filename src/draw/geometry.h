#pragma once
/// \file
/// Plane values of a picture. A point of a plan is (right, up) in metres. A point of a section is (distance along the
/// way, height) in metres. A point of a sheet is (right, down) in pixels.

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <utility>
#include <vector>

#include "roam/math.h"

namespace roam::draw {

using Point = glm::dvec2;
using Polyline = std::vector<Point>;

struct Segment {
  Point a{0.0}, b{0.0};
};

/// A rectangle with sides along the axes; empty until a point is included.
struct Rect {
  Point lower{std::numeric_limits<double>::infinity()};
  Point upper{-std::numeric_limits<double>::infinity()};

  [[nodiscard]] bool empty() const { return !(lower.x <= upper.x && lower.y <= upper.y); }
  [[nodiscard]] double width() const { return upper.x - lower.x; }
  [[nodiscard]] double height() const { return upper.y - lower.y; }
  [[nodiscard]] Point center() const { return 0.5 * lower + 0.5 * upper; }
  [[nodiscard]] Rect grown(double by) const { return {lower - by, upper + by}; }
  [[nodiscard]] bool contains(const Point& p) const {
    return p.x >= lower.x && p.x <= upper.x && p.y >= lower.y && p.y <= upper.y;
  }
  [[nodiscard]] bool contains(const Rect& r) const { return contains(r.lower) && contains(r.upper); }
  [[nodiscard]] bool overlaps(const Rect& r) const {
    return lower.x < r.upper.x && r.lower.x < upper.x && lower.y < r.upper.y && r.lower.y < upper.y;
  }
  void include(const Point& p) {
    lower = {std::min(lower.x, p.x), std::min(lower.y, p.y)};
    upper = {std::max(upper.x, p.x), std::max(upper.y, p.y)};
  }
  static Rect around(const Point& centre, double width, double height) {
    const Point half(0.5 * width, 0.5 * height);
    return {centre - half, centre + half};
  }
  /// Grown by a millionth of its size: rounding may put points outside that lie on the border.
  [[nodiscard]] Rect with_border() const { return grown(1e-6 * std::max(width(), height())); }
  /// The corners as a closed line.
  [[nodiscard]] Polyline outline() const { return {lower, {upper.x, lower.y}, upper, {lower.x, upper.y}}; }
};

/// A part of a plan or section, with its scale.
struct Frame {
  Rect view;             ///< in metres of the plan or section
  double scale_x = 1.0;  ///< pixels per metre
  double scale_y = 1.0;

  [[nodiscard]] double width() const { return view.width() * scale_x; }    ///< pixels
  [[nodiscard]] double height() const { return view.height() * scale_y; }  ///< pixels
  /// The largest one with `shown` in its middle, `width` pixels wide and from `least` to `most` pixels high.
  static Frame fitted(const Rect& shown, double width, double least, double most) {
    const double scale = std::min(width / shown.width(), most / shown.height());
    const double height = std::max(shown.height(), least / scale);
    return {Rect::around(shown.center(), width / scale, height), scale, scale};
  }
};

/// The orientation of a plan on the sheet: the scene turned about the vertical through `origin`. Heights stay.
struct Turn {
  Vec3 origin{0.0};
  double cosine = 1.0;  ///< of the angle by which the scene is turned clockwise, seen from above
  double sine = 0.0;

  /// (right, up, height) of a place, metres.
  [[nodiscard]] Vec3 operator()(const Vec3& place) const {
    const double x = place.x - origin.x, y = place.y - origin.y;
    return {cosine * x + sine * y, cosine * y - sine * x, place.z};
  }
  /// (right, up) of a place, metres.
  [[nodiscard]] Point plan(const Vec3& place) const {
    const Vec3 p = (*this)(place);
    return {p.x, p.y};
  }
};

/// Cuts the segment to its part inside the rectangle. False if there is none. A part with_border() lies on the border.
[[nodiscard]] inline bool clip(Segment& s, const Rect& r) {
  const Rect bordered = r.with_border();
  const Point d = s.b - s.a;
  double from = 0.0, to = 1.0;
  for (int k = 0; k < 2; ++k) {
    if (d[k] == 0.0) {
      if (s.a[k] < bordered.lower[k] || s.a[k] > bordered.upper[k]) return false;
      continue;
    }
    const double near = (bordered.lower[k] - s.a[k]) / d[k], far = (bordered.upper[k] - s.a[k]) / d[k];
    from = std::max(from, std::min(near, far));
    to = std::min(to, std::max(near, far));
  }
  if (!(from <= to)) return false;
  const Point a = s.a;
  s.a = glm::clamp(from > 0.0 ? a + from * d : a, r.lower, r.upper);
  s.b = glm::clamp(to < 1.0 ? a + to * d : s.b, r.lower, r.upper);
  return true;
}

/// Cuts a polygon to its part on one side of a plane: where the coordinate `axis` is at most `limit` if `side` is 1,
/// and at least that if it is -1.
template <typename V>
void keep_side(std::vector<V>& polygon, int axis, double limit, double side) {
  std::vector<V> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const V a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    const double from = side * (limit - a[axis]), to = side * (limit - b[axis]);
    if (from >= 0.0) kept.push_back(a);
    if ((from < 0.0) != (to < 0.0)) kept.push_back(a + from / (from - to) * (b - a));
  }
  polygon = std::move(kept);
}

}  // namespace roam::draw
