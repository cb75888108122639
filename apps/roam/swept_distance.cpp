#include "swept_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>

namespace roam::app {
namespace {

using Point = glm::vec<3, long double>;
using Corners = std::array<Point, 3>;

long double squared(const Point& v) { return glm::dot(v, v); }

/// Squared distance of a point and a segment.
long double point_segment(const Point& p, const Point& a, const Point& b) {
  const Point u = b - a;
  const long double length = squared(u);
  const long double s = length > 0 ? std::clamp(glm::dot(p - a, u) / length, 0.0L, 1.0L) : 0.0L;
  return squared(p - (a + s * u));
}

/// Squared distance of two segments.
long double segment_segment(const Point& a0, const Point& a1, const Point& b0, const Point& b1) {
  long double least = std::min(
      {point_segment(a0, b0, b1), point_segment(a1, b0, b1), point_segment(b0, a0, a1), point_segment(b1, a0, a1)});
  const Point u = a1 - a0;
  const Point v = b1 - b0;
  // The common perpendicular, by cross products: unlike |u|^2 |v|^2 - (u.v)^2 they keep their digits when the
  // segments are almost parallel.
  const Point n = glm::cross(u, v);
  const long double area = squared(n);
  if (area > 0) {
    const Point w = b0 - a0;
    const long double s = glm::dot(glm::cross(w, v), n) / area;
    const long double t = glm::dot(glm::cross(w, u), n) / area;
    if (s > 0 && s < 1 && t > 0 && t < 1) least = std::min(least, squared((a0 + s * u) - (b0 + t * v)));
  }
  return least;
}

/// The foot of `p` on the plane of a triangle when it lies inside the triangle. Nothing for a triangle without area:
/// its edges are all of it.
std::optional<Point> foot_on_face(const Point& p, const Corners& t) {
  const Point e1 = t[1] - t[0];
  const Point e2 = t[2] - t[0];
  const Point n = glm::cross(e1, e2);
  const long double area = squared(n);
  if (!(area > 0)) return std::nullopt;
  const Point w = p - t[0];
  const long double s = glm::dot(glm::cross(w, e2), n) / area;
  const long double r = glm::dot(glm::cross(e1, w), n) / area;
  if (s < 0 || r < 0 || s + r > 1) return std::nullopt;
  return t[0] + s * e1 + r * e2;
}

/// A segment passes through the inside of a triangle.
bool pierces(const Point& a, const Point& b, const Corners& t) {
  const Point n = glm::cross(t[1] - t[0], t[2] - t[0]);
  const long double da = glm::dot(n, a - t[0]);
  const long double db = glm::dot(n, b - t[0]);
  if (da == db || (da > 0 && db > 0) || (da < 0 && db < 0)) return false;
  return foot_on_face(a + (da / (da - db)) * (b - a), t).has_value();
}

/// Squared distance of a segment and a triangle.
long double segment_triangle(const Point& a, const Point& b, const Corners& t) {
  if (pierces(a, b, t)) return 0;
  long double least = std::min(
      {segment_segment(a, b, t[0], t[1]), segment_segment(a, b, t[1], t[2]), segment_segment(a, b, t[2], t[0])});
  for (const Point& end : {a, b}) {
    if (const auto foot = foot_on_face(end, t)) least = std::min(least, squared(end - *foot));
  }
  return least;
}

/// Squared distance of two triangles.
long double triangle_triangle(const Corners& a, const Corners& b) {
  long double least = segment_triangle(a[0], a[1], b);
  for (int i = 0; i < 3; ++i) {
    least = std::min({least, segment_triangle(a[i], a[(i + 1) % 3], b), segment_triangle(b[i], b[(i + 1) % 3], a)});
  }
  return least;
}

}  // namespace

long double swept_distance(const Vec3& from, const Vec3& to, double half_height, const Triangle& triangle) {
  // Relative to the start: the coordinates' common size then costs no digits in the products.
  const Point origin(from);
  const Corners corners{Point(triangle[0]) - origin, Point(triangle[1]) - origin, Point(triangle[2]) - origin};
  const Point start(0.0L);
  const Point end = Point(to) - origin;
  if (half_height == 0.0) return std::sqrt(segment_triangle(start, end, corners));
  const Point axis(0.0L, 0.0L, static_cast<long double>(half_height));
  if (end.x == 0 && end.y == 0) {
    const long double low = std::min(0.0L, end.z);
    const long double high = std::max(0.0L, end.z);
    return std::sqrt(segment_triangle(Point(0, 0, low) - axis, Point(0, 0, high) + axis, corners));
  }
  const Corners lower{start - axis, end - axis, end + axis};
  const Corners upper{start - axis, end + axis, start + axis};
  return std::sqrt(std::min(triangle_triangle(lower, corners), triangle_triangle(upper, corners)));
}

}  // namespace roam::app
