#pragma once
/// \file
/// The part of a triangle that counts as floor.

#include <array>
#include <utility>

#include "roam/space.h"
#include "sweep/certified.h"

namespace roam::query {

struct Frame;

/// The pieces of a triangle that was cut on two sides. It has at most five corners, or six by rounding: four triangles.
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
  /// For triangles in coordinates relative to `start`. Throws roam::Error if the floor is out of range.
  FloorOnly(const Floor& floor, const Vec3& start);

  /// The same floor in the frame of an instance, with the start in that frame.
  [[nodiscard]] FloorOnly seen_in(const Frame& frame, const Vec3& start) const;

  /// The part of the triangle that counts: nothing, all of it, or its part in the band.
  [[nodiscard]] FloorPieces pieces(const certified::LocalTriangle& triangle) const;

  /// Heights over the start between which all floor of the band lies, within `reach` (m) of the start's x and y.
  [[nodiscard]] std::pair<double, double> heights(double reach) const;

  /// Whether an unknown box may hold floor of the band within `reach` (m) of the start's x and y. Its contents may
  /// extend beyond the box by `margin` (m).
  [[nodiscard]] bool may_lie_in(const Box& box, double reach, double margin) const;

 private:
  /// Metres above the band's plane.
  [[nodiscard]] double above(const Vec3& p) const { return p.z - (level_ + p.x * rise_x_ + p.y * rise_y_); }

  Vec3 start_;
  double squared_cosine_;
  double band_;
  double level_ = 0.0;                  ///< metres: height of the band's plane over the start
  double rise_x_ = 0.0, rise_y_ = 0.0;  ///< slope of that plane, metres per metre
};

}  // namespace roam::query
