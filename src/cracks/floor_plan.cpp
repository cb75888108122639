#include "cracks/floor_plan.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace roam::cracks {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

double squared(double x, double y) { return x * x + y * y; }

/// A triangle clipped by two planes.
struct Polygon {
  std::array<Vec3, 5> corners;
  int size = 0;
  void add(const Vec3& corner) { corners[static_cast<std::size_t>(size++)] = corner; }
};

/// The part of a polygon with sign * z <= limit (Sutherland & Hodgman, 1974).
Polygon clipped(const Polygon& whole, double sign, double limit) {
  Polygon part;
  for (int i = 0; i < whole.size; ++i) {
    const Vec3& a = whole.corners[static_cast<std::size_t>(i)];
    const Vec3& b = whole.corners[static_cast<std::size_t>((i + 1) % whole.size)];
    const double above_a = sign * a.z - limit, above_b = sign * b.z - limit;
    if (above_a <= 0.0) part.add(a);
    if ((above_a < 0.0 && above_b > 0.0) || (above_a > 0.0 && above_b < 0.0))
      part.add(a + (above_a / (above_a - above_b)) * (b - a));
  }
  return part;
}

/// The place of the segment that is nearest to the origin in the plan.
Vec3 nearest_of_segment(const Vec3& a, const Vec3& b) {
  const Vec3 ab = b - a;
  const double length = squared(ab.x, ab.y);
  if (length == 0.0) return a;
  return a + std::clamp(-(a.x * ab.x + a.y * ab.y) / length, 0.0, 1.0) * ab;
}

/// The place of a convex polygon nearest to the origin in the plan. If the polygon lies over the origin: the origin.
std::optional<Vec3> nearest_of(const Polygon& polygon) {
  if (polygon.size == 0) return std::nullopt;
  bool left = false, right = false;
  Vec3 best = polygon.corners[0];
  double least = infinite;
  for (int i = 0; i < polygon.size; ++i) {
    const Vec3& a = polygon.corners[static_cast<std::size_t>(i)];
    const Vec3& b = polygon.corners[static_cast<std::size_t>((i + 1) % polygon.size)];
    const double side = a.x * b.y - a.y * b.x;
    left = left || side > 0.0;
    right = right || side < 0.0;
    const Vec3 at = nearest_of_segment(a, b);
    if (const double d = squared(at.x, at.y); d < least) {
      least = d;
      best = at;
    }
  }
  if (left != right) return Vec3(0.0, 0.0, best.z);
  return best;
}

}  // namespace

void sort_near(std::vector<NearPlace>& near) {
  std::sort(near.begin(), near.end(), [](const NearPlace& a, const NearPlace& b) {
    if (a.distance != b.distance) return a.distance < b.distance;
    return a.point.x != b.point.x ? a.point.x < b.point.x : a.point.y < b.point.y;
  });
}

FloorPlan::FloorPlan(const Survey& survey, double band)
    // Twice, because the query's own bound has the same error. The rest is rounding.
    : survey_(&survey), band_(band), error_(2.0 * survey.floor().largest_error() + 1e-7) {}

NearPlace FloorPlan::of(TriangleId floor, const Vec3& place) const {
  const Triangle t = survey_->triangle(survey_->floor_triangles()[floor]);
  Polygon polygon;
  for (const Vec3& corner : t) polygon.add(corner - place);
  const auto [lowest, highest] = std::minmax({polygon.corners[0].z, polygon.corners[1].z, polygon.corners[2].z});
  if (highest > band_) polygon = clipped(polygon, 1.0, band_);
  if (lowest < -band_) polygon = clipped(polygon, -1.0, band_);
  const std::optional<Vec3> at = nearest_of(polygon);
  if (!at) return {infinite, place};
  return {std::sqrt(squared(at->x, at->y)), place + *at};
}

void FloorPlan::within(const Vec3& place, double reach, std::vector<NearPlace>& near) const {
  std::vector<Contact> contacts(32);
  std::size_t count = 0;
  while ((count = survey_->floor().contacts({0.0, band_}, place, Vec3(0.0), reach, contacts)) == contacts.size())
    contacts.resize(4 * contacts.size());
  near.clear();
  for (std::size_t i = 0; i < count; ++i) near.push_back(of(contacts[i].triangle, place));
  sort_near(near);
}

NearPlace FloorPlan::nearest(const Vec3& place, double reach) const {
  const Clearance beside = survey_->floor().clearance({0.0, band_}, place, reach);
  if (!beside.found) return {reach, place};
  const NearPlace first = of(beside.triangle, place);
  if (first.distance <= std::max(beside.distance, 0.0) + error_) return first;
  // The nearest triangle was above or below the axis's ends. Search farther for floor within the band.
  std::vector<NearPlace> near;
  for (double radius = std::max(2.0 * beside.distance, 0.1);; radius *= 2.0) {
    within(place, std::min(radius, reach), near);
    if (!near.empty() && near.front().distance <= std::min(radius, reach)) return near.front();
    if (radius >= reach) return {reach, place};
  }
}

void FloorPlan::touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const {
  const NearPlace first = nearest(place, reach);
  within(place, std::min(first.distance + slack, reach) + error_, near);
  if (near.empty() || near.front().distance > first.distance) near.assign(1, first);
  const double least = near.front().distance;
  std::erase_if(near, [&](const NearPlace& n) { return n.distance > least + slack; });
}

}  // namespace roam::cracks
