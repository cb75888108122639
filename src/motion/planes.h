#pragma once
/// \file
/// The motion that is left of a wish when planes block it.

#include <array>
#include <cstddef>

#include "roam/math.h"

namespace roam::walking {

/// Part of a wish's length by which it may lead into a plane and still count as along it. It is far above rounding
/// (1e-16) and so small that the skin, at least 0.1 mm, outlasts 100 m of such motion.
constexpr double parallel_tolerance = 1e-6;

/// The planes that a body touches at one position, as unit normals that point to the body.
class PlaneSet {
 public:
  /// A body in a corner of real geometry touches three planes; bumps of a stored wall add a few nearly parallel ones.
  /// Further planes are dropped. This blocks the body sooner, never later.
  static constexpr std::size_t capacity = 8;

  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool full() const { return size_ == capacity; }
  [[nodiscard]] const Vec3& operator[](std::size_t i) const { return normals_[i]; }
  void clear() { size_ = 0; }
  void add(const Vec3& normal) {
    if (!full()) normals_[size_++] = normal;
  }

 private:
  std::array<Vec3, capacity> normals_;
  std::size_t size_ = 0;
};

/// The vector nearest to `wish` that leads into none of the planes: the wish itself, its projection on one plane
/// (slide) or on the line of two (crease), or zero (three planes). It depends only on the wish and not on earlier
/// attempts. So many contacts in a row do not wear it down.
[[nodiscard]] Vec3 along_planes(const Vec3& wish, const PlaneSet& planes);

}  // namespace roam::walking
