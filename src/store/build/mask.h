#pragma once
/// \file
/// The occupied cells of a tile's box.

#include <array>
#include <cstdint>

#include "roam/mesh.h"
#include "store/page.h"

namespace roam::store {

/// Builds TileEntry::mask: marks every cell that a triangle, grown by `margin`, may touch.
class Mask {
 public:
  /// `margin`: metres.
  Mask(const Box& box, double margin);
  void add(const Triangle& triangle);

  std::array<std::uint64_t, mask_cells * mask_cells * mask_cells / 64> words{};

 private:
  void set(int x, int y, int z) {
    const int bit = x + mask_cells * (y + mask_cells * z);
    words[static_cast<std::size_t>(bit / 64)] |= std::uint64_t{1} << (bit % 64);
  }

  Vec3 lower_, per_metre_, cell_, half_;
  double margin_;
};

}  // namespace roam::store
