// Sixteen boxes or triangles at a time. Included once per instruction set by traverse.cpp.
//
// No fused multiply-add and no reciprocal estimates: every instruction set gives the same bits.

#if defined(ROAM_INDEX_LANES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_LANES_INL_H_
#undef ROAM_INDEX_LANES_INL_H_
#else
#define ROAM_INDEX_LANES_INL_H_
#endif

#include <cstring>

#include "index/frame-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

using F = hn::CappedTag<float, node_width>;
using I = hn::RebindToSigned<F>;
using VF = hn::Vec<F>;
using VI = hn::Vec<I>;
using MF = hn::Mask<F>;
inline constexpr F kF{};
inline constexpr I kI{};
/// Lanes of one vector; a block takes node_width / lane_count of them.
inline constexpr int lane_count = static_cast<int>(hn::MaxLanes(F{}));

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

/// The children of a node that may matter, and a lower bound of the time (sweep) or distance (near) of each.
struct Children {
  alignas(64) float key[node_width];
  std::uint32_t mask;

  /// Takes all children in `met`, with 0 as the only known bound.
  HWY_INLINE void take(std::uint32_t met) {
    mask = met;
    for (std::uint32_t left = met; left != 0; left &= left - 1) key[std::countr_zero(left)] = 0.0F;
  }
};

/// Bounds of lane_count boxes, in steps of their node's grid.
HWY_INLINE VF bounds_of(const std::uint8_t* bounds) {
  const hn::Rebind<std::uint8_t, F> bytes;
  return hn::ConvertTo(kF, hn::PromoteTo(kI, hn::LoadU(bytes, bounds)));
}

/// Child boxes as distances from the start, with each axis multiplied by `mirror` (1 or -1).
struct Boxes {
  float at[3], scale[3];

  HWY_INLINE Boxes(const Node& node, const Frame& frame, const float* mirror) {
    for (int k = 0; k < 3; ++k) {
      const float step = mirror[k] * frame.step;
      at[k] = frame.steps(node.origin[k], k) * step;
      // step * 2^shift, by adding to the exponent
      scale[k] = std::bit_cast<float>(std::bit_cast<std::uint32_t>(step) + (std::uint32_t{node.shift[k]} << 23));
    }
  }
  /// Plane `k` of lane_count boxes.
  [[nodiscard]] HWY_INLINE VF plane(const std::uint8_t* bounds, int k) const {
    // The product is exact: fused or not gives the same bits.
    return hn::MulAdd(bounds_of(bounds), set(scale[k]), set(at[k]));
  }
};

/// Metres by which child boxes are grown, so that no rounding in a node test can lose a child. `extent` is the greatest
/// width of a node in this frame.
HWY_INLINE float grown_radius(float radius, float half_height, float longest, float extent, float step) {
  return radius * (1.0F + radius_roundings * float_unit) +
         node_roundings * float_unit * (extent + longest + radius + half_height) + 2.0F * fraction_rounding * step;
}

HWY_INLINE std::uint32_t bits_of(MF mask) {
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(kF, mask, bits);
  if constexpr (lane_count <= 8) return bits[0];
  // In one read, which is not waited for. Only processors with the least byte first have sixteen lanes.
  std::uint16_t both = 0;
  std::memcpy(&both, bits, sizeof both);
  return both;
}

/// The planes across axis `k` through which the centre of a body enters and leaves lane_count child boxes. On the
/// vertical axis the boxes are extended by the body's half height at both ends.
struct Slabs {
  VF lower, upper;

  HWY_INLINE Slabs(const Boxes& boxes, const Node& node, const Motion& motion, int first, int k) {
    const auto* planes = reinterpret_cast<const std::uint8_t*>(&node) + first;
    lower = boxes.plane(planes + motion.entry[k], k);
    upper = boxes.plane(planes + motion.exit[k], k);
    if (k == 2) {
      lower = hn::Sub(lower, set(motion.half_height));
      upper = hn::Add(upper, set(motion.half_height));
    }
  }
};

/// The children that the body may meet before t_max, with times. `grown` is the radius to keep free plus the margin.
HWY_INLINE void sweep_node(const Node& node, const Frame& frame, const Motion& motion, float grown, float t_max,
                           Children& out) {
  const Boxes boxes(node, frame, motion.mirror);
  const VF zero = hn::Zero(kF), r = set(grown), end = set(t_max);
  const VF r2 = hn::Mul(r, r);
  const VF later = set(1.0F + time_roundings * float_unit), earlier = set(1.0F - time_roundings * float_unit);
  out.mask = 0;
  for (int first = 0; first < node_width; first += lane_count) {
    VF enter = zero, exit = end;
    VF squared = zero, towards = zero;
    for (int k = 0; k < 3; ++k) {
      const auto [lower, upper] = Slabs(boxes, node, motion, first, k);
      const VF inverse = set(motion.inverse[k]);
      enter = hn::Max(enter, hn::Mul(hn::Sub(lower, r), inverse));
      exit = hn::Min(exit, hn::Mul(hn::Add(upper, r), inverse));
      // The point of the box closest to the start gives one supporting plane.
      const VF closest = hn::Add(hn::Max(lower, zero), hn::Min(upper, zero));
      squared = hn::Add(squared, hn::Mul(closest, closest));
      towards = hn::Add(towards, hn::Mul(closest, set(motion.forward[k])));
    }
    // Apart at the start and still apart at t_max: squared - t_max towards > r |closest|, without the root.
    const VF left = hn::Sub(squared, hn::Mul(end, towards));
    const MF apart = hn::And(hn::Gt(squared, r2), hn::Gt(left, zero));
    const MF never = hn::And(apart, hn::Gt(hn::Mul(left, left), hn::Mul(r2, squared)));
    enter = hn::Mul(enter, earlier);
    const MF slab = hn::Le(enter, hn::Mul(exit, later));
    hn::Store(enter, kF, out.key + first);
    out.mask |= bits_of(hn::AndNot(never, slab)) << first;
  }
  out.mask &= (1U << node.child_count) - 1;
}

/// Delays the times of the remaining children, and drops more of them, by a second supporting plane. It belongs to the
/// point of the box closest to the body when the body enters the slabs; let w be the vector to it. From then on the
/// body is free as long as |w|^2 - time w.m > r |w|. This costs a root and a division, so it pays only where there are
/// several children.
HWY_INLINE void delay_children(const Node& node, const Frame& frame, const Motion& motion, float grown, float t_max,
                               Children& out) {
  const Boxes boxes(node, frame, motion.mirror);
  const VF zero = hn::Zero(kF), r = set(grown);
  std::uint32_t met = 0;
  for (int first = 0; first < node_width; first += lane_count) {
    const VF time = hn::Load(kF, out.key + first);
    VF squared = zero, towards = zero;
    for (int k = 0; k < 3; ++k) {
      const auto [lower, upper] = Slabs(boxes, node, motion, first, k);
      const VF forward = set(motion.forward[k]), place = hn::Mul(time, forward);
      const VF w = hn::Sub(clamp(place, lower, upper), place);
      squared = hn::Add(squared, hn::Mul(w, w));
      towards = hn::Add(towards, hn::Mul(w, forward));
    }
    const VF length = hn::Sqrt(squared), slack = hn::Sub(squared, hn::Mul(r, length));
    const VF speed = hn::Add(towards, hn::Mul(set(speed_roundings * float_unit * motion.longest), length));
    const MF apart = hn::Gt(slack, zero), closing = hn::Gt(speed, zero);
    const MF later = hn::And(apart, closing);
    const VF step =
        hn::Mul(hn::Div(slack, hn::IfThenElse(later, speed, set(1.0F))), set(1.0F - time_roundings * float_unit));
    const VF key = hn::IfThenElse(later, hn::Add(time, step), time);
    hn::Store(key, kF, out.key + first);
    const MF never = hn::Or(hn::AndNot(closing, apart), hn::Ge(key, set(t_max)));
    met |= bits_of(hn::Not(never)) << first;
  }
  out.mask &= met;
}

/// The children of a node whose boxes meet the swept box, in integers. Most visits need no more.
HWY_INLINE std::uint32_t met_children(const Node& node, const Swept& swept) {
#if HWY_TARGET == HWY_SCALAR
  std::uint32_t mask = 0;
  // Saturates like the conversion to bytes below: the result is the same to the bit.
  const auto on_grid = [&](const std::int32_t* plane, int k) {
    return std::clamp((plane[k] - node.origin[k]) >> node.shift[k], 0, 255);
  };
  for (int i = 0; i < node.child_count; ++i) {
    bool met = true;
    for (int k = 0; k < 3; ++k) {
      met = met && node.lower[k][i] <= on_grid(swept.upper, k) && node.upper[k][i] >= on_grid(swept.lower, k);
    }
    mask |= std::uint32_t{met} << i;
  }
  return mask;
#else
  const hn::FixedTag<std::int32_t, 4> axes;
  const hn::FixedTag<std::uint8_t, 4> few;
  const hn::FixedTag<std::uint8_t, node_width> bytes;
  // On the node's own grid the boxes lie within 0 to 255; the conversion to bytes saturates.
  const auto origin = hn::LoadU(axes, node.origin), shift = hn::PromoteTo(axes, hn::LoadU(few, node.shift));
  const auto on_grid = [&](const std::int32_t* plane) {
    return hn::DemoteTo(few, hn::Shr(hn::Sub(hn::Load(axes, plane), origin), shift));
  };
#if HWY_ARCH_ARM
  // Highway 1.0.3 looks bytes up only in whole vectors of NEON.
  const auto table = [&](const auto& four) {
    const hn::FixedTag<std::uint8_t, 8> eight;
    return hn::Combine(bytes, hn::Zero(eight), hn::Combine(eight, four, four));
  };
#else
  const auto table = [](const auto& four) { return four; };
#endif
  const auto lower = table(on_grid(swept.lower)), upper = table(on_grid(swept.upper));
  auto apart = hn::Zero(bytes);
  for (int k = 0; k < 3; ++k) {
    const auto axis = hn::Set(bytes, static_cast<std::uint8_t>(k));
    apart = hn::Or(apart, hn::SaturatedSub(hn::LoadU(bytes, node.lower[k]), hn::TableLookupBytes(upper, axis)));
    apart = hn::Or(apart, hn::SaturatedSub(hn::TableLookupBytes(lower, axis), hn::LoadU(bytes, node.upper[k])));
  }
  std::uint8_t bits[8] = {};
  hn::StoreMaskBits(bytes, hn::Eq(apart, hn::Zero(bytes)), bits);
  return (std::uint32_t{bits[0]} | std::uint32_t{bits[1]} << 8) & ((1U << node.child_count) - 1);
#endif
}

/// The children that may come within `reach` of the body's axis during its motion, with lower bounds of their
/// distances. `left` is lowered to the least bound of the others. `margin` is grown_radius() of radius 0.
///
/// Let w be the vector from the closest point of the box to a point of the axis at the fraction t of the motion m. The
/// plane across w shows that the box is at least |w| - max(t w.m, (t - 1) w.m) / |w| away during the whole motion.
HWY_INLINE void near_node(const Node& node, const Frame& frame, const Way& way, float margin, float reach, VF& left,
                          Children& out) {
  static constexpr float as_is[3] = {1.0F, 1.0F, 1.0F};
  const Boxes boxes(node, frame, as_is);
  const VF zero = hn::Zero(kF), one = set(1.0F);
  out.mask = 0;
  for (int first = 0; first < node_width; first += lane_count) {
    VF lower[3], upper[3];
    for (int k = 0; k < 3; ++k) {
      lower[k] = boxes.plane(node.lower[k] + first, k);
      upper[k] = boxes.plane(node.upper[k] + first, k);
    }
    lower[2] = hn::Sub(lower[2], set(way.half_height));
    upper[2] = hn::Add(upper[2], set(way.half_height));
    VF time = zero;
    if (way.moves) {
      VF towards = zero;
      for (int k = 0; k < 3; ++k) {
        towards = hn::Add(towards, hn::Mul(hn::Add(lower[k], upper[k]), set(0.5F * way.way[k])));
      }
      time = clamp(hn::Mul(towards, set(way.inverse_square)), zero, one);
      towards = zero;
      for (int k = 0; k < 3; ++k) {
        const VF m = set(way.way[k]);
        towards = hn::Add(towards, hn::Mul(clamp(hn::Mul(time, m), lower[k], upper[k]), m));
      }
      time = clamp(hn::Mul(towards, set(way.inverse_square)), zero, one);
    }
    VF squared = zero, along = zero;
    for (int k = 0; k < 3; ++k) {
      const VF m = set(way.way[k]), place = hn::Mul(time, m);
      const VF w = hn::Sub(place, clamp(place, lower[k], upper[k]));
      squared = hn::Add(squared, hn::Mul(w, w));
      along = hn::Add(along, hn::Mul(w, m));
    }
    const VF length = hn::Sqrt(squared);
    VF least = hn::Sub(hn::Mul(length, set(1.0F - time_roundings * float_unit)), set(margin));
    if (way.moves) {
      const VF lost = hn::Max(hn::Mul(time, along), hn::Mul(hn::Sub(time, one), along));
      least = hn::Sub(least, hn::Div(lost, hn::Max(length, set(shortest_way))));
    }
    const MF child = hn::FirstN(kF, static_cast<std::size_t>(std::max(0, node.child_count - first)));
    const MF out_of_reach = hn::And(child, hn::Gt(least, set(reach)));
    left = hn::Min(left, hn::IfThenElse(out_of_reach, least, left));
    hn::Store(hn::Max(least, zero), kF, out.key + first);
    out.mask |= bits_of(hn::AndNot(out_of_reach, child)) << first;
  }
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_LANES_INL_H_
