#include "world/floor_only.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "math/finite.h"
#include "math/largest.h"
#include "math/slope.h"
#include "roam/error.h"
#include "sweep/error_bound.h"
#include "text/number.h"
#include "world/frame.h"

namespace roam::query {
namespace {

constexpr double slope_limit = 89.0;

/// Roundings of a corner made by a cut: of its two ends, of the share between them, and of the sum.
constexpr double cut_roundings = 8.0;

[[noreturn]] void refuse(const std::string& what) { throw Error("cannot look for floor: " + what); }

/// Corners of a flat convex polygon in order.
struct Outline {
  std::array<Vec3, 6> corner;
  int corners = 0;
};

/// The part of the outline where `height` is at most `limit`.
template <class Height>
Outline cut(const Outline& whole, double limit, const Height& height) {
  Outline rest;
  for (int i = 0; i < whole.corners; ++i) {
    const Vec3 &a = whole.corner[i], &b = whole.corner[(i + 1) % whole.corners];
    const double from = height(a), to = height(b);
    if (from <= limit) rest.corner[rest.corners++] = a;
    if ((from <= limit) != (to <= limit)) {
      const double share = std::clamp((limit - from) / (to - from), 0.0, 1.0);
      rest.corner[rest.corners++] = a + share * (b - a);
    }
  }
  return rest;
}

}  // namespace

FloorOnly::FloorOnly(const Floor& floor, const Vec3& start) : start_(start), band_(floor.band) {
  if (!(floor.slope_degrees >= 0.0 && floor.slope_degrees <= slope_limit)) {
    refuse("the slope limit is " + number_text(floor.slope_degrees) + " degrees; it must be between 0 and 89");
  }
  const double cosine = least_upright(floor.slope_degrees);
  squared_cosine_ = cosine * cosine;
  if (!(floor.band >= 0.0)) refuse("the band is " + number_text(floor.band) + " m; it must be 0 or more");
  if (std::isinf(floor.band)) return;
  if (!is_finite(floor.point)) refuse("the point of the band's plane is not finite");
  rise_x_ = -floor.normal.x / floor.normal.z;
  rise_y_ = -floor.normal.y / floor.normal.z;
  if (!(floor.normal.z > 0.0) || !std::isfinite(rise_x_) || !std::isfinite(rise_y_)) {
    refuse("the normal of the band's plane does not point up");
  }
  const Vec3 point = floor.point - start;
  level_ = point.z - point.x * rise_x_ - point.y * rise_y_;
}

FloorOnly FloorOnly::seen_in(const Frame& frame, const Vec3& start) const {
  FloorOnly seen = *this;
  const Vec3 rise = frame.to_instance_way({rise_x_, rise_y_, 0.0});
  seen.start_ = start;
  seen.rise_x_ = rise.x;
  seen.rise_y_ = rise.y;
  return seen;
}

FloorPieces FloorOnly::pieces(const certified::LocalTriangle& triangle) const {
  const Vec3* const corner = triangle.corner;
  FloorPieces pieces;
  const Vec3 normal = glm::cross(corner[1] - corner[0], corner[2] - corner[0]);
  const double squared = glm::dot(normal, normal);
  if (!(squared > 0.0) || normal.z * normal.z < squared_cosine_ * squared) return pieces;
  const double heights[] = {above(corner[0]), above(corner[1]), above(corner[2])};
  const auto [lowest, highest] = std::minmax({heights[0], heights[1], heights[2]});
  if (lowest >= -band_ && highest <= band_) {
    pieces.push(triangle);
    return pieces;
  }
  if (lowest > band_ || highest < -band_) return pieces;
  Outline rest{{{corner[0], corner[1], corner[2]}}, 3};
  rest = cut(rest, band_, [this](const Vec3& p) { return above(p); });
  rest = cut(rest, band_, [this](const Vec3& p) { return -above(p); });
  const double reach = std::max({largest(corner[0]), largest(corner[1]), largest(corner[2])});
  const double error = triangle.corner_error + cut_roundings * certified::unit_roundoff * reach;
  for (int i = 2; i < rest.corners; ++i) pieces.push({{rest.corner[0], rest.corner[i - 1], rest.corner[i]}, error});
  return pieces;
}

std::pair<double, double> FloorOnly::heights(double reach) const {
  const double most = band_ + reach * std::hypot(rise_x_, rise_y_);
  return {level_ - most, level_ + most};
}

bool FloorOnly::may_lie_in(const Box& box, double reach, double margin) const {
  if (std::isinf(band_)) return true;
  // The rise of the plane over the part of the box within reach. It is linear, so its extremes are at the ends.
  double least = 0.0, most = 0.0;
  for (const auto& [k, rise] : {std::pair(0, rise_x_), std::pair(1, rise_y_)}) {
    const double lower = std::max(box.lower[k] - start_[k], -reach), upper = std::min(box.upper[k] - start_[k], reach);
    least += std::min(rise * lower, rise * upper);
    most += std::max(rise * lower, rise * upper);
  }
  return box.lower.z - start_.z - margin <= level_ + most + band_ &&
         box.upper.z - start_.z + margin >= level_ + least - band_;
}

}  // namespace roam::query
