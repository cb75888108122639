// The start and the motion of a query in steps of a grid and in single precision. Set up once per query or per tile,
// all axes at once. Included once per instruction set by traverse.cpp.

#if defined(ROAM_INDEX_FRAME_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_FRAME_INL_H_
#undef ROAM_INDEX_FRAME_INL_H_
#else
#define ROAM_INDEX_FRAME_INL_H_
#endif

#include <hwy/highway.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "index/block.h"
#include "index/margin.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

// Vectors of axes: in doubles, in floats, and in whole steps.
using D = hn::CappedTag<double, 4>;
using S = hn::Rebind<float, D>;
using W = hn::Rebind<std::int32_t, D>;
inline constexpr int axis_lanes = static_cast<int>(hn::MaxLanes(D{}));

/// Axes k .. k + axis_lanes - 1 of four; the fourth repeats the third.
HWY_INLINE hn::Vec<D> axes_of(const Vec3& v, [[maybe_unused]] int k) {
#if HWY_MAX_BYTES >= 32
  const hn::Half<D> half;
  // Not one load of two numbers: it would wait for the stores of each.
  return hn::Combine(D{}, hn::Set(half, v.z), hn::InterleaveLower(half, hn::Set(half, v.x), hn::Set(half, v.y)));
#elif HWY_TARGET != HWY_SCALAR
  return k == 0 ? hn::LoadU(D{}, &v.x) : hn::Set(D{}, v.z);
#else
  return hn::Set(D{}, v[std::min(k, 2)]);
#endif
}

/// The start of a query on the grid of a tile or of the tree over tiles: whole steps and the rest.
struct Frame {
  alignas(16) std::int32_t whole[4];  // one element per axis, as in all arrays below
  alignas(16) float rest[4];
  float step, inverse;  ///< metres, and steps per metre

  HWY_INLINE Frame(const Vec3& origin, double grid_step, const Vec3& start) : step(static_cast<float>(grid_step)) {
    // 1 / grid_step, exact for a power of two
    const auto exact = std::bit_cast<double>(0x7fe0000000000000U - std::bit_cast<std::uint64_t>(grid_step));
    inverse = static_cast<float>(exact);
    for (int k = 0; k < 4; k += axis_lanes) {
      // A start too far away for whole steps cannot matter: at the limit it is at least 4095 m away, out of any reach.
      const auto steps = hn::Mul(hn::Sub(axes_of(start, k), axes_of(origin, k)), hn::Set(D{}, exact));
      const auto at = hn::Min(hn::Max(steps, hn::Set(D{}, -farthest_steps)), hn::Set(D{}, farthest_steps));
      const auto nearest = hn::Floor(hn::Add(at, hn::Set(D{}, 0.5)));
      hn::Store(hn::DemoteTo(W{}, nearest), W{}, whole + k);
      hn::Store(hn::DemoteTo(S{}, hn::Sub(at, nearest)), S{}, rest + k);
    }
  }
  /// Steps from the start.
  [[nodiscard]] float steps(std::int32_t coordinate, int k) const {
    return static_cast<float>(coordinate - whole[k]) - rest[k];
  }
};

/// A float that is not less than x, for x >= 0.
HWY_INLINE float round_up(double x) { return static_cast<float>(x) * (1.0F + 4.0F * float_unit); }

/// A piece of motion in single precision.
struct Motion {
  alignas(16) float way[4];
  // Node tests mirror the axes along which the body moves backwards. So it enters every box through its lower planes.
  alignas(16) float mirror[4];      ///< 1 or -1
  alignas(16) float forward[4];     ///< |way[k]|
  alignas(16) float inverse[4];     ///< 1 / forward[k], at most huge_inverse
  std::uint32_t entry[3], exit[3];  ///< offsets in a node of the planes through which axis k is entered and left
  float longest;                    ///< of |way[k]|, the greatest
  float half_height;                ///< rounded up

  HWY_INLINE Motion(const Vec3& motion, double h) : half_height(round_up(h)) {
    const auto zero = hn::Zero(S{}), one = hn::Set(S{}, 1.0F), huge = hn::Set(S{}, huge_inverse);
    for (int k = 0; k < 4; k += axis_lanes) {
      const auto along = hn::DemoteTo(S{}, axes_of(motion, k)), size = hn::Abs(along);
      const auto some = hn::Gt(size, hn::Set(S{}, 1.0F / huge_inverse));
      hn::Store(along, S{}, way + k);
      hn::Store(hn::IfThenElse(hn::Lt(along, zero), hn::Neg(one), one), S{}, mirror + k);
      hn::Store(size, S{}, forward + k);
      hn::Store(hn::IfThenElse(some, hn::Div(one, hn::IfThenElse(some, size, one)), huge), S{}, inverse + k);
    }
    longest = std::max(std::max(forward[0], forward[1]), forward[2]);
    for (int k = 0; k < 3; ++k) {
      const bool back = way[k] < 0.0F;
      const auto lower = static_cast<std::uint32_t>(offsetof(Node, lower) + node_width * k);
      const auto upper = static_cast<std::uint32_t>(offsetof(Node, upper) + node_width * k);
      entry[k] = back ? upper : lower;
      exit[k] = back ? lower : upper;
    }
  }
};

/// The extent of a body's whole motion relative to its start, in metres, rounded outwards.
struct Reach {
  alignas(16) float lower[4], upper[4];

  HWY_INLINE Reach(const Vec3& motion, double radius, double half_height) {
    const auto zero = hn::Zero(D{}), flat = hn::Set(D{}, radius), high = hn::Set(D{}, radius + half_height);
    const auto up = hn::Set(S{}, 1.0F + 4.0F * float_unit);
    for (int k = 0; k < 4; k += axis_lanes) {
      const auto around = hn::IfThenElse(hn::FirstN(D{}, static_cast<std::size_t>(std::max(0, 2 - k))), flat, high);
      const auto way = axes_of(motion, k);
      const auto down = hn::Sub(around, hn::Min(way, zero));
      hn::Store(hn::Neg(hn::Mul(hn::DemoteTo(S{}, down), up)), S{}, lower + k);
      hn::Store(hn::Mul(hn::DemoteTo(S{}, hn::Add(around, hn::Max(way, zero))), up), S{}, upper + k);
    }
  }
};

/// The box of a reach, `more` metres wider, in whole steps of a frame: two steps wider than any rounding.
struct Swept {
  alignas(16) std::int32_t lower[4], upper[4];

  // cppcheck-suppress uninitMemberVar ; for members that are set later
  Swept() = default;
  HWY_INLINE Swept(const Frame& frame, const Reach& reach, float more) {
    // Planes lie between 0 and 2^16 steps of a tile, and between 0 and 2^29 + 2^19 steps of the tree over tiles. For a
    // point farther off only its side matters. A clamped reach still leads from any clamped start past all planes of a
    // tile; in the tree over tiles no reach is that long. No sum of these and an origin overflows.
    const auto farthest = hn::Set(W{}, (1 << 30) - (1 << 18)), end = hn::Set(W{}, 1 << 30), two = hn::Set(W{}, 2);
    const auto longest = hn::Set(S{}, 0x1p30F - 0x1p17F), wider = hn::Set(S{}, more);
    const auto steps = hn::Set(S{}, frame.inverse * (1.0F + time_roundings * float_unit));
    for (int k = 0; k < 4; k += axis_lanes) {
      const auto whole = hn::Min(hn::Max(hn::Load(W{}, frame.whole + k), hn::Neg(farthest)), farthest);
      const auto low = hn::Mul(hn::Sub(hn::Load(S{}, reach.lower + k), wider), steps);
      const auto high = hn::Mul(hn::Add(hn::Load(S{}, reach.upper + k), wider), steps);
      const auto down = hn::ConvertTo(W{}, hn::Max(low, hn::Neg(longest)));
      const auto up = hn::ConvertTo(W{}, hn::Min(high, longest));
      hn::Store(hn::Max(hn::Sub(hn::Add(whole, down), two), hn::Neg(end)), W{}, lower + k);
      hn::Store(hn::Min(hn::Add(hn::Add(whole, up), two), end), W{}, upper + k);
    }
  }
};

/// The motion of a body whose nearest approach is searched for; zero for a body at rest.
struct Way {
  float way[3];
  float longest;  ///< of |way[k]|, the greatest
  float half_height;
  float inverse_square, inverse_flat;  ///< 1 / squared length of the motion, and of its horizontal part; 0 if that is
                                       ///< too short
  bool moves;

  Way(const Vec3& motion, double h) : longest(0.0F), half_height(round_up(h)) {
    for (int k = 0; k < 3; ++k) {
      way[k] = static_cast<float>(motion[k]);
      longest = std::max(longest, std::abs(way[k]));
    }
    const float flat = way[0] * way[0] + way[1] * way[1], whole = flat + way[2] * way[2];
    inverse_flat = flat > shortest_way * shortest_way ? 1.0F / flat : 0.0F;
    inverse_square = whole > shortest_way * shortest_way ? 1.0F / whole : 0.0F;
    moves = longest > 0.0F;
  }
};

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_FRAME_INL_H_
