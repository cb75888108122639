#pragma once
/// \file
/// Where a wish leads when planes stand in its way.

#include <array>
#include <cstddef>

#include "roam/math.h"

namespace roam::walking {

/// Part of a wish's length by which it may lead into a plane and still count as along it. Far above rounding (1e-16)
/// and so small that the skin, at least 0.1 mm, outlasts 100 m of such motion.
constexpr double parallel_tolerance = 1e-6;

/// The planes that a body touches at one place, as unit normals that point to the body.
class PlaneSet {
 public:
  /// A body in a corner of real geometry touches three planes; bumps of a stored wall add a few that are nearly
  /// parallel to those. What comes beyond is left out, which blocks the body sooner, never later.
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
/// (slide), on the line that two share (crease), or nothing (three planes). It depends on the wish alone, not on what
/// was tried before, so that many contacts in a row wear nothing off.
[[nodiscard]] Vec3 along_planes(const Vec3& wish, const PlaneSet& planes);

}  // namespace roam::walking
