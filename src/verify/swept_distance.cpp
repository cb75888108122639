#include "verify/swept_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

namespace roam::verification {
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
  // The common perpendicular by cross products. Unlike |u|^2 |v|^2 - (u.v)^2, they keep their digits if the segments
  // are almost parallel.
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

/// A triangle, or the parallelogram of which it is half: all corner + s * e1 + r * e2 with s, r >= 0. For a triangle s
/// + r <= 1, for a parallelogram s, r <= 1.
struct Face {
  Point corner, e1, e2;
  bool parallelogram;
};

/// The foot of `p` on the plane of a face if it lies inside the face. None for a face without area, which its edges
/// cover.
std::optional<Point> foot_on(const Face& face, const Point& p) {
  const Point n = glm::cross(face.e1, face.e2);
  const long double area = squared(n);
  if (!(area > 0)) return std::nullopt;
  const Point w = p - face.corner;
  const long double s = glm::dot(glm::cross(w, face.e2), n) / area;
  const long double r = glm::dot(glm::cross(face.e1, w), n) / area;
  const bool inside = s >= 0 && r >= 0 && (face.parallelogram ? s <= 1 && r <= 1 : s + r <= 1);
  if (!inside) return std::nullopt;
  return face.corner + s * face.e1 + r * face.e2;
}

/// Squared distance of a segment's ends and a face; 0 when the segment passes through the face.
long double ends_face(const Point& a, const Point& b, const Face& face) {
  const Point n = glm::cross(face.e1, face.e2);
  const long double da = glm::dot(n, a - face.corner);
  const long double db = glm::dot(n, b - face.corner);
  const bool one_side = (da > 0 && db > 0) || (da < 0 && db < 0);
  if (da != db && !one_side && foot_on(face, a + (da / (da - db)) * (b - a))) return 0;
  long double least = std::numeric_limits<long double>::infinity();
  for (const Point& end : {a, b}) {
    if (const auto foot = foot_on(face, end)) least = std::min(least, squared(end - *foot));
  }
  return least;
}

/// Squared distance of a segment and a triangle.
long double segment_triangle(const Point& a, const Point& b, const Corners& t) {
  return std::min({ends_face(a, b, {t[0], t[1] - t[0], t[2] - t[0], false}), segment_segment(a, b, t[0], t[1]),
                   segment_segment(a, b, t[1], t[2]), segment_segment(a, b, t[2], t[0])});
}

}  // namespace

long double swept_distance(const Vec3& from, const Vec3& to, double half_height, const Triangle& triangle) {
  // Relative to the start, so that the coordinates' common size costs no digits in the products.
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
  const std::array<Point, 4> around{start - axis, end - axis, end + axis, start + axis};
  const Face swept{around[0], around[1] - around[0], around[3] - around[0], true};
  long double least = std::numeric_limits<long double>::infinity();
  for (int i = 0; i < 4; ++i) least = std::min(least, segment_triangle(around[i], around[(i + 1) % 4], corners));
  for (int i = 0; i < 3; ++i) least = std::min(least, ends_face(corners[i], corners[(i + 1) % 3], swept));
  return std::sqrt(least);
}

}  // namespace roam::verification
