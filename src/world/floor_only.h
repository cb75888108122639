#pragma once
/// \file
/// The part of a triangle that counts as floor.

#include <array>
#include <span>

#include "roam/space.h"
#include "sweep/certified.h"

namespace roam::query {

struct Frame;

/// A triangle cut off on two sides has at most five corners, or six by rounding, and is four triangles.
class FloorPieces {
 public:
  [[nodiscard]] const certified::LocalTriangle* begin() const { return pieces_.data(); }
  [[nodiscard]] const certified::LocalTriangle* end() const { return pieces_.data() + count_; }
  void push(const certified::LocalTriangle& piece) { pieces_[count_++] = piece; }

 private:
  std::array<certified::LocalTriangle, 4> pieces_;
  std::size_t count_ = 0;
};

class FloorOnly {
 public:
  /// For triangles seen from `start`. Throws roam::Error for a floor that is out of range.
  FloorOnly(const Floor& floor, const Vec3& start);

  /// The same floor in the frame of an instance, where the start is another.
  [[nodiscard]] FloorOnly seen_in(const Frame& frame, const Vec3& start) const;

  /// What counts of the triangle: nothing, all, or the part in the band.
  [[nodiscard]] FloorPieces pieces(const certified::LocalTriangle& triangle) const;

  /// Whether a box of which nothing is known may hold floor of the band within `reach` (m) of the start's x and y. What
  /// comes to light in it may stick out by `margin` (m).
  [[nodiscard]] bool may_lie_in(const Box& box, double reach, double margin) const;

 private:
  /// Metres above the plane of the band.
  [[nodiscard]] double above(const Vec3& p) const { return p.z - (level_ + p.x * rise_x_ + p.y * rise_y_); }

  Vec3 start_;
  double squared_cosine_;
  double band_;
  double level_ = 0.0;                  ///< of the band's plane over the start, metres
  double rise_x_ = 0.0, rise_y_ = 0.0;  ///< of that plane, metres a metre
};

}  // namespace roam::query
