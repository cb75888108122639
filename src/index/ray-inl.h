// Rays: bodies so thin that they meet hardly anything but the triangles that they pierce. Included once per instruction
// set by traverse.cpp.

#if defined(ROAM_INDEX_RAY_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_RAY_INL_H_
#undef ROAM_INDEX_RAY_INL_H_
#else
#define ROAM_INDEX_RAY_INL_H_
#endif

#include "index/triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

/// Data of a ray's tests in addition to its Motion.
struct Ray {
  static constexpr bool is_ray = true;
  /// The vectors of the projection are at most sqrt(2) long, because no slope is over 1. The surplus is a thousand
  /// roundings; `room` and its products have fewer than twenty.
  static constexpr float longest_across = 1.4143F;
  // 1 / forward[k] in 16 bits, so that the product with a bound of a node is exact, and at least 2^-16 of it too small
  // and too large: far more than the roundings of a time.
  alignas(16) float early[4], late[4];
  // A projection along the ray onto the plane of two axes: coordinate i of a point x is x[axis[i]] - slope[i]
  // x[axis[2]], that is, x times a vector across the motion, except for rounding.
  int axis[3];  ///< the last one is that of the longest component of the motion
  float slope[2];
  float start[2];  ///< in a tile: the projection of the ray, in steps
  float room = 0;  ///< in a tile: steps from it within which triangles count

  // cppcheck-suppress uninitMemberVar ; enter() sets `start`
  explicit Ray(const Motion& motion) {
    for (int k = 0; k < 4; ++k) {
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(motion.inverse[k]) & ~0xffU;
      early[k] = std::bit_cast<float>(bits - 0x100U);
      late[k] = std::bit_cast<float>(bits + 0x200U);
    }
    axis[2] = motion.forward[0] == motion.longest ? 0 : motion.forward[1] == motion.longest ? 1 : 2;
    for (int i = 0; i < 2; ++i) {
      axis[i] = (axis[2] + 1 + i) % 3;
      slope[i] = motion.longest > 0.0F ? motion.way[axis[i]] / motion.way[axis[2]] : 0.0F;
    }
  }
  /// Must be called before the first leaf of each tile, which is at most `steps` wide.
  HWY_INLINE void enter(const Frame& frame, const Motion& motion, float radius, float steps) {
    float farthest = motion.longest;
    for (int k = 0; k < 3; ++k) {
      farthest = std::max(farthest, (std::abs(static_cast<float>(frame.whole[k])) + steps) * frame.step);
    }
    const float keep = radius * (1.0F + radius_roundings * float_unit) + ray_roundings * float_unit * farthest +
                       8.0F * fraction_rounding * frame.step;
    room = (keep * longest_across + speed_roundings * float_unit * motion.longest) * frame.inverse;
    const auto place = [&](int k) { return double(frame.whole[k]) + double(frame.rest[k]); };
    for (int i = 0; i < 2; ++i) {
      start[i] = static_cast<float>(place(axis[i]) - double(slope[i]) * place(axis[2]));
    }
  }
};

/// Takes the place of Ray for bodies that are not rays.
struct NoRay {
  static constexpr bool is_ray = false;
  explicit NoRay(const Motion&) {}
};

/// The same of a RayFrame.
struct NoRayFrame {
  const Frame& frame;
  float grown;

  HWY_INLINE NoRayFrame(const Frame& f, const Motion&, const NoRay&, float g) : frame(f), grown(g) {}
};

/// A ray in a frame: it enters the planes across axis k, grown outwards, of a node with origin o and bounds b at
/// enter[k] + enter_step[k] * (o - whole[k] + (b << shift)).
struct RayFrame {
  const Frame& frame;
  alignas(16) float enter[4], exit[4], enter_step[4], exit_step[4];

  HWY_INLINE RayFrame(const Frame& f, const Motion& motion, const Ray& ray, float grown) : frame(f) {
    for (int k = 0; k < 3; k += static_cast<int>(hn::MaxLanes(axes))) {
      const auto step = hn::Mul(hn::Load(axes, motion.mirror + k), hn::Set(axes, frame.step));
      const auto early = hn::Load(axes, ray.early + k), late = hn::Load(axes, ray.late + k), r = hn::Set(axes, grown);
      const auto rest = hn::Mul(hn::Load(axes, frame.rest + k), step);
      hn::Store(hn::Neg(hn::Mul(hn::Add(rest, r), early)), axes, enter + k);
      hn::Store(hn::Mul(hn::Sub(r, rest), late), axes, exit + k);
      hn::Store(hn::Mul(step, early), axes, enter_step + k);
      hn::Store(hn::Mul(step, late), axes, exit_step + k);
    }
  }

  static constexpr hn::CappedTag<float, 4> axes{};
};

/// The same for one node: at + scale * b.
struct Crossings {
  alignas(16) float enter_at[4], exit_at[4], enter_scale[4], exit_scale[4];

  HWY_INLINE Crossings(const Node& node, const RayFrame& ray) {
    constexpr auto axes = RayFrame::axes;
    const hn::RebindToSigned<hn::CappedTag<float, 4>> whole;
    const hn::Rebind<std::uint8_t, hn::CappedTag<float, 4>> bytes;
    for (int k = 0; k < 3; k += static_cast<int>(hn::MaxLanes(axes))) {
      // The fourth axis reads the members behind; nobody uses its results.
      const auto steps =
          hn::ConvertTo(axes, hn::Sub(hn::LoadU(whole, node.origin + k), hn::Load(whole, ray.frame.whole + k)));
      // step * 2^shift, by adding to the exponent
      const auto shift = hn::ShiftLeft<23>(hn::PromoteTo(whole, hn::LoadU(bytes, node.shift + k)));
      const auto place = [&](const float* step, const float* from, float* at, float* scale) {
        const auto s = hn::Load(axes, step + k);
        hn::Store(hn::Add(hn::Mul(steps, s), hn::Load(axes, from + k)), axes, at + k);
        hn::Store(hn::BitCast(axes, hn::Add(hn::BitCast(whole, s), shift)), axes, scale + k);
      };
      place(ray.enter_step, ray.enter, enter_at, enter_scale);
      place(ray.exit_step, ray.exit, exit_at, exit_scale);
    }
  }
};

/// The children that the ray may meet before t_max, with times: sweep_node() by the slabs alone.
HWY_INLINE void ray_node(const Node& node, const RayFrame& ray, const Motion& motion, float t_max, Children& out) {
  const Crossings at(node, ray);
  const auto* planes = reinterpret_cast<const std::uint8_t*>(&node);
  out.mask = 0;
  for (int first = 0; first < node_width; first += lane_count) {
    VF enter = hn::Zero(kF), exit = set(t_max);
    for (int k = 0; k < 3; ++k) {
      // The products with a bound are exact: fused or not gives the same bits.
      const VF in =
          hn::MulAdd(bounds_of(planes + motion.entry[k] + first), set(at.enter_scale[k]), set(at.enter_at[k]));
      const VF end = hn::MulAdd(bounds_of(planes + motion.exit[k] + first), set(at.exit_scale[k]), set(at.exit_at[k]));
      enter = hn::Max(enter, in);
      exit = hn::Min(exit, end);
    }
    hn::Store(enter, kF, out.key + first);
    out.mask |= bits_of(hn::Le(enter, exit)) << first;
  }
  out.mask &= (1U << node.child_count) - 1;
}

/// The vertices of a leaf in the projection along a ray, in steps from it.
class Projected {
 public:
  HWY_INLINE Projected(const Leaf& leaf, const FineLeaf* low, const Ray& ray) {
    const hn::Rebind<std::uint16_t, F> words;
    const hn::Rebind<std::int16_t, F> low_words;
    for (int from = 0; from < node_width; from += lane_count) {
      const auto steps = [&](int k) {
        const VF whole = hn::ConvertTo(kF, hn::PromoteTo(kI, hn::LoadU(words, leaf.vertex[k] + from)));
        if (low == nullptr) return whole;
        // The product is exact: fused or not gives the same bits.
        return hn::MulAdd(hn::ConvertTo(kF, hn::PromoteTo(kI, hn::LoadU(low_words, low->vertex[k] + from))),
                          set(1.0F / static_cast<float>(fine_steps)), whole);
      };
      const VF depth = steps(ray.axis[2]);
      for (int i = 0; i < 2; ++i) {
        at_[i][from / lane_count] =
            hn::Sub(hn::Sub(steps(ray.axis[i]), hn::Mul(depth, set(ray.slope[i]))), set(ray.start[i]));
      }
    }
  }
  /// Coordinate `i` of vertices from .. from + lane_count - 1.
  [[nodiscard]] HWY_INLINE VF at(int i, int from) const { return at_[i][from / lane_count]; }

 private:
  VF at_[2][node_width / lane_count];
};

/// Bits: the triangles of a leaf that a ray does not certainly miss. In the projection, where it is a point, it lies
/// outside the box of any other triangle or beyond one of its edges.
///
/// With any numbers p and q and the directions u and v of the projection, w = p u + q v is perpendicular to the motion
/// and is a valid direction.
HWY_INLINE std::uint32_t pierced(const Leaf& leaf, const FineLeaf* low, const Ray& ray) {
  const Projected vertices(leaf, low, ray);
  std::uint32_t bits = 0;
  for (int first = 0; first < leaf.triangle_count; first += lane_count) {
    MF active = hn::FirstN(kF, static_cast<std::size_t>(leaf.triangle_count - first));
    const Corners corners(leaf, first);
    VF at[2][3];
    for (int i = 0; i < 2; ++i) {
      corners.pick([&](int from) { return vertices.at(i, from); }, at[i]);
      const VF least = hn::Min(hn::Min(at[i][0], at[i][1]), at[i][2]);
      const VF most = hn::Max(hn::Max(at[i][0], at[i][1]), at[i][2]);
      active = hn::AndNot(hn::Gt(hn::Max(least, hn::Neg(most)), set(ray.room)), active);
    }
    if (hn::AllFalse(kF, active)) continue;
    for (int e = 0; e < 3; ++e) {
      const int f = (e + 1) % 3, g = (e + 2) % 3;
      const VF p = hn::Sub(at[1][e], at[1][f]), q = hn::Sub(at[0][f], at[0][e]);
      const VF edge = hn::Add(hn::Mul(p, at[0][e]), hn::Mul(q, at[1][e]));
      const VF corner = hn::Add(hn::Mul(p, at[0][g]), hn::Mul(q, at[1][g]));
      const VF beside = hn::Max(hn::Min(edge, corner), hn::Neg(hn::Max(edge, corner)));
      const VF width = hn::Mul(hn::Add(hn::Abs(p), hn::Abs(q)), set(ray.room));
      active = hn::AndNot(hn::Gt(beside, width), active);
    }
    bits |= bits_of(active) << first;
  }
  return bits;
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_RAY_INL_H_
