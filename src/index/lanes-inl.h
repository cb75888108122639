// Sixteen boxes or triangles at a time. Included once per instruction set by traverse.cpp.
//
// No fused multiply-add and no reciprocal estimates: every instruction set gives the same bits.

#if defined(ROAM_INDEX_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_LANES_INL_H_
#undef ROAM_INDEX_LANES_INL_H_
#else
#define ROAM_INDEX_LANES_INL_H_
#endif

#include <hwy/highway.h>

#include <bit>
#include <cmath>

#include "index/block.h"
#include "index/margin.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

using F = hn::CappedTag<float, kWidth>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;
inline constexpr F kF{};
inline constexpr I kI{};
/// Lanes of one vector; a block takes kWidth / kLanes of them.
inline constexpr int kLanes = static_cast<int>(hn::MaxLanes(F{}));

struct V3 {
  VF x, y, z;
};

HWY_INLINE V3 operator-(const V3& a, const V3& b) { return {hn::Sub(a.x, b.x), hn::Sub(a.y, b.y), hn::Sub(a.z, b.z)}; }
HWY_INLINE V3 scale(const V3& a, VF s) { return {hn::Mul(a.x, s), hn::Mul(a.y, s), hn::Mul(a.z, s)}; }
HWY_INLINE VF dot(const V3& a, const V3& b) {
  return hn::Add(hn::Add(hn::Mul(a.x, b.x), hn::Mul(a.y, b.y)), hn::Mul(a.z, b.z));
}
HWY_INLINE V3 cross(const V3& a, const V3& b) {
  return {hn::Sub(hn::Mul(a.y, b.z), hn::Mul(a.z, b.y)), hn::Sub(hn::Mul(a.z, b.x), hn::Mul(a.x, b.z)),
          hn::Sub(hn::Mul(a.x, b.y), hn::Mul(a.y, b.x))};
}
HWY_INLINE V3 select(MF m, const V3& a, const V3& b) {
  return {hn::IfThenElse(m, a.x, b.x), hn::IfThenElse(m, a.y, b.y), hn::IfThenElse(m, a.z, b.z)};
}
HWY_INLINE VF set(float x) { return hn::Set(kF, x); }
HWY_INLINE VF clamp(VF x, VF lo, VF hi) { return hn::Min(hn::Max(x, lo), hi); }
HWY_INLINE VF largest(const V3& a) { return hn::Max(hn::Max(hn::Abs(a.x), hn::Abs(a.y)), hn::Abs(a.z)); }

/// The start of a query on the grid of a tile or of the top: whole steps and the rest.
struct Frame {
  std::int32_t whole[3];
  float rest[3];
  float step;

  Frame(const Vec3& origin, double grid_step, const Vec3& start) : step(static_cast<float>(grid_step)) {
    const double inverse = 1.0 / grid_step;  // a power of two: exact
    for (int k = 0; k < 3; ++k) {
      const double at = (start[k] - origin[k]) * inverse;
      const double nearest = std::floor(at + 0.5);
      whole[k] = static_cast<std::int32_t>(nearest);
      rest[k] = static_cast<float>(at - nearest);
    }
  }
  /// Metres from the start, of a coordinate in steps.
  [[nodiscard]] float metres(std::int32_t steps, int k) const {
    return (static_cast<float>(steps - whole[k]) - rest[k]) * step;
  }
};

/// A piece of motion in single precision.
struct Motion {
  float way[3];
  float inverse[3];
  float longest;      ///< of |way[k]|
  float half_height;  ///< rounded up

  Motion(const Vec3& motion, double h) : longest(0.0F), half_height(round_up(h)) {
    for (int k = 0; k < 3; ++k) {
      way[k] = static_cast<float>(motion[k]);
      const float inv = 1.0F / way[k];
      inverse[k] = std::abs(inv) < kHugeInverse ? inv : std::copysign(kHugeInverse, way[k]);
      longest = std::max(longest, std::abs(way[k]));
    }
  }
  static float round_up(double x) {
    const auto f = static_cast<float>(x);
    return double(f) < x ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
  }
};

/// The children of a node that cannot be left out, and a lower bound of the time (sweep) or distance (near) of each.
struct Children {
  alignas(64) float key[kWidth];
  std::uint32_t mask;
};

/// Child boxes as distances from the start, part by part.
struct Boxes {
  float at[3], scale[3];
  float extent;  ///< the widest side that the node can have (m)

  Boxes(const Node& node, const Frame& frame) : extent(0.0F) {
    for (int k = 0; k < 3; ++k) {
      at[k] = frame.metres(node.origin[k], k);
      scale[k] = frame.step * static_cast<float>(std::int64_t{1} << node.shift[k]);
      extent = std::max(extent, 256.0F * scale[k]);
    }
  }
  /// Plane `k` of the boxes first .. first + kLanes - 1.
  [[nodiscard]] HWY_INLINE VF plane(const std::uint8_t* bounds, int first, int k) const {
    const hn::Rebind<std::uint8_t, F> bytes;
    const VF b = hn::ConvertTo(kF, hn::PromoteTo(kI, hn::LoadU(bytes, bounds + first)));
    return hn::Add(hn::Mul(b, set(scale[k])), set(at[k]));  // the product is exact
  }
};

/// Which children the body may meet before t_max, and when. `radius` is what is kept free.
HWY_INLINE void sweep_node(const Node& node, const Frame& frame, const Motion& motion, float radius, float t_max,
                           Children& out) {
  const Boxes boxes(node, frame);
  const float h = motion.half_height;
  const float grown = radius * (1.0F + kRadiusRoundings * kUnit) +
                      kNodeRoundings * kUnit * (boxes.extent + motion.longest + radius + h) +
                      2.0F * kFractionRounding * frame.step;
  const VF zero = hn::Zero(kF);
  const VF later = set(1.0F + kTimeRoundings * kUnit), earlier = set(1.0F - kTimeRoundings * kUnit);
  out.mask = 0;
  for (int first = 0; first < kWidth; first += kLanes) {
    VF enter = zero, exit = set(t_max);
    VF squared = zero, towards = zero;
    for (int k = 0; k < 3; ++k) {
      VF lower = boxes.plane(node.lower[k], first, k);
      VF upper = boxes.plane(node.upper[k], first, k);
      if (k == 2) {
        lower = hn::Sub(lower, set(h));
        upper = hn::Add(upper, set(h));
      }
      const VF inverse = set(motion.inverse[k]);
      const VF a = hn::Mul(hn::Sub(lower, set(grown)), inverse), b = hn::Mul(hn::Add(upper, set(grown)), inverse);
      enter = hn::Max(enter, hn::Min(a, b));
      exit = hn::Min(exit, hn::Max(a, b));
      // The closest point of the box to the start: one supporting plane.
      const VF closest = hn::Add(hn::Max(lower, zero), hn::Min(upper, zero));
      squared = hn::Add(squared, hn::Mul(closest, closest));
      towards = hn::Add(towards, hn::Mul(closest, set(motion.way[k])));
    }
    const VF gap = hn::Sub(squared, hn::Mul(set(grown), hn::Sqrt(squared)));
    const MF apart = hn::Gt(gap, zero);
    const MF never = hn::And(apart, hn::Gt(gap, hn::Mul(set(t_max), towards)));
    const VF touch = hn::Div(gap, hn::IfThenElse(apart, hn::Max(towards, set(1.0F / kHugeInverse)), set(1.0F)));
    const MF slab = hn::Le(hn::Mul(enter, earlier), hn::Mul(exit, later));
    enter = hn::Mul(hn::Max(enter, hn::IfThenElseZero(apart, touch)), earlier);
    const MF kept = hn::AndNot(never, slab);
    hn::Store(enter, kF, out.key + first);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kF, kept, bits);
    out.mask |= (std::uint32_t{bits[0]} | std::uint32_t{kLanes > 8 ? bits[1] : std::uint8_t{0}} << 8) << first;
  }
  out.mask &= (1U << node.child_count) - 1;
}

/// Which children may lie within `reach` of the body's axis, and how far they are at least.
HWY_INLINE void near_node(const Node& node, const Frame& frame, float half_height, float reach, Children& out) {
  const Boxes boxes(node, frame);
  const VF zero = hn::Zero(kF);
  const VF margin = set(kNodeRoundings * kUnit * (boxes.extent + reach + half_height) +
                        2.0F * kFractionRounding * frame.step);
  out.mask = 0;
  for (int first = 0; first < kWidth; first += kLanes) {
    VF squared = zero;
    for (int k = 0; k < 3; ++k) {
      VF lower = boxes.plane(node.lower[k], first, k);
      VF upper = boxes.plane(node.upper[k], first, k);
      if (k == 2) {
        lower = hn::Sub(lower, set(half_height));
        upper = hn::Add(upper, set(half_height));
      }
      const VF closest = hn::Add(hn::Max(lower, zero), hn::Min(upper, zero));
      squared = hn::Add(squared, hn::Mul(closest, closest));
    }
    const VF least = hn::Sub(hn::Mul(hn::Sqrt(squared), set(1.0F - kTimeRoundings * kUnit)), margin);
    hn::Store(hn::Max(least, zero), kF, out.key + first);
    std::uint8_t bits[8] = {};
    hn::StoreMaskBits(kF, hn::Le(least, set(reach)), bits);
    out.mask |= (std::uint32_t{bits[0]} | std::uint32_t{kLanes > 8 ? bits[1] : std::uint8_t{0}} << 8) << first;
  }
  out.mask &= (1U << node.child_count) - 1;
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_LANES_INL_H_
