#pragma once
/// \file
/// The position of a triangle on the Morton curve of all stores.

#include <algorithm>
#include <cstdint>

#include "index/curve.h"
#include "roam/mesh.h"
#include "store/part.h"

namespace roam::store {

/// The curve over all coordinates within coordinate_limit: see CurveKey.
struct AbsoluteCurve {
  using Key = CurveKey;
  static constexpr int axis_bits = 41;
  static constexpr int class_shift = 3 * axis_bits;
  static constexpr double cell_size = 0x1p-10;     ///< m, side of the smallest cell
  static constexpr double curve_origin = -0x1p30;  ///< m, of the first cell on each axis
  /// The largest tile: decoding it takes 200 us.
  static constexpr std::uint32_t most_tile_triangles = 8192;
  /// The bits of the first axis.
  static constexpr Key axis_mask = Key{index::SceneCurve::axis_mask} | Key{index::SceneCurve::axis_mask} << 63;

  static Key spread(std::uint64_t x) { return Key{index::spread(x & 0x1fffffU)} | Key{index::spread(x >> 21)} << 63; }
  static std::uint64_t gather(Key place) {
    const auto low = static_cast<std::uint64_t>(place), high = static_cast<std::uint64_t>(place >> 63);
    return index::gather(low & index::SceneCurve::axis_mask) | index::gather(high & index::SceneCurve::axis_mask) << 21;
  }
};

/// All bits of any key lie below this one.
inline constexpr int key_bits = AbsoluteCurve::class_shift + 4;

struct Place {
  CurveKey key;
  float reach;  ///< m, half the widest side of the triangle's box, rounded up
};

[[nodiscard]] inline Place place_of(const Triangle& t) {
  double extent = 0.0;
  CurveKey key = 0;
  for (int k = 0; k < 3; ++k) {
    const double lower = std::min({t[0][k], t[1][k], t[2][k]}), upper = std::max({t[0][k], t[1][k], t[2][k]});
    extent = std::max(extent, upper - lower);
    const double steps = (0.5 * lower + 0.5 * upper - AbsoluteCurve::curve_origin) / AbsoluteCurve::cell_size;
    key |= AbsoluteCurve::spread(static_cast<std::uint64_t>(steps)) << k;
  }
  // Rounding to float and the product each lose less than 2^-23 of the value. The constant exceeds any underflow.
  const float reach = static_cast<float>(0.5 * extent) * (1.0F + 0x1p-21F) + 0x1p-120F;
  return {key | CurveKey{index::size_class(extent)} << AbsoluteCurve::class_shift, reach};
}

/// A cell of the curve: the keys that agree with `key` in all but the lowest `bits` bits.
struct CurveCell {
  CurveKey key = 0;
  int bits = 0;
  [[nodiscard]] CurveKey last() const { return key | ((CurveKey{1} << bits) - 1); }
  bool operator==(const CurveCell&) const = default;
};

}  // namespace roam::store
