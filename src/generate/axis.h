#pragma once
/// \file
/// The line in plan that a gallery or a dam follows: straight legs joined by a mitre.

#include <vector>

#include "roam/math.h"

namespace roam::generate {

/// One or two straight legs in plan. Stations are metres along the line; y is metres to the left of it.
class Axis {
 public:
  /// A straight line from a to b.
  Axis(const Vec3& a, const Vec3& b);
  /// From a by the corner b to c. Cross-sections turn into the mitre over `blend` metres before and after it.
  Axis(const Vec3& a, const Vec3& b, const Vec3& c, double blend);

  [[nodiscard]] double length() const { return corner_ + length2_; }
  /// The station of the corner, or of the end if there is no corner.
  [[nodiscard]] double corner() const { return corner_; }

  /// A cross-section: the point at y to the left lies at origin + left * y, in plan.
  struct Frame {
    Vec3 origin, left;
  };
  [[nodiscard]] Frame frame(double station) const;
  /// Level unit vectors ahead and to the left, square to each other. They ignore the mitre.
  [[nodiscard]] Vec3 ahead(double station) const { return station <= corner_ ? ahead1_ : ahead2_; }
  [[nodiscard]] Vec3 left(double station) const;

  /// Station and offset to the left of a point in plan, continuous across the mitre. Therefore stations beside the axis
  /// shear by the tangent of half the bend.
  struct Place {
    double station, offset;
  };
  [[nodiscard]] Place place(double x, double y) const;

 private:
  Vec3 start_, ahead1_, ahead2_;
  Vec3 corner_point_;
  double corner_ = 0.0, length2_ = 0.0;
  double half_tangent_ = 0.0;  // of the bend; positive for a bend to the left
  double blend_ = 1.0;
};

}  // namespace roam::generate
