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
  float early[3], late[3];  ///< 1 / forward[k], rounded down and up to 16 bits, so that the product with a bound of a
                            ///< node is exact
  float across[2][3];       ///< perpendicular to the motion and, except for rounding, to each other
  float length[2];          ///< their lengths, rounded up
  float drift[2];           ///< extent of the motion along them, rounded up
  float room[2]{};          ///< in a tile: distance along them within which triangles count, times their lengths
  bool seen = false;        ///< the vectors across the motion are known

  explicit Ray(const Motion& motion) {
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t bits = std::bit_cast<std::uint32_t>(motion.inverse[k]) & ~0xffU;
      early[k] = std::bit_cast<float>(bits);
      late[k] = std::bit_cast<float>(bits + 0x100U);
    }
  }
  /// Sets the vectors across the motion. Rays that reach no leaf do without.
  void look_along(const Motion& motion) {
    seen = true;
    int least = 0;
    for (int k = 1; k < 3; ++k) {
      if (motion.forward[k] < motion.forward[least]) least = k;
    }
    const float size = motion.longest > 0.0F ? 1.0F / motion.longest : 0.0F;
    const float along[3] = {motion.way[0] * size, motion.way[1] * size, motion.way[2] * size};
    const int next = (least + 1) % 3, last = (least + 2) % 3;
    across[0][least] = 0.0F;
    across[0][next] = -along[last];
    across[0][last] = along[next];
    for (int k = 0; k < 3; ++k) {
      const int a = (k + 1) % 3, b = (k + 2) % 3;
      across[1][k] = along[a] * across[0][b] - along[b] * across[0][a];
    }
    for (int i = 0; i < 2; ++i) {
      float square = 0.0F, way = 0.0F;
      for (int k = 0; k < 3; ++k) {
        square += across[i][k] * across[i][k];
        way += across[i][k] * motion.way[k];
      }
      length[i] = std::sqrt(square) * (1.0F + radius_roundings * float_unit);
      drift[i] = std::abs(way) + speed_roundings * float_unit * motion.longest * length[i];
    }
  }
  /// Must be called before the first leaf of each tile, which is at most `steps` wide.
  HWY_INLINE void enter(const Frame& frame, const Motion& motion, float radius, float steps) {
    if (!seen) look_along(motion);
    float farthest = motion.longest;
    for (int k = 0; k < 3; ++k) {
      farthest = std::max(farthest, (std::abs(static_cast<float>(frame.whole[k])) + steps) * frame.step);
    }
    const float keep = radius * (1.0F + radius_roundings * float_unit) + ray_roundings * float_unit * farthest +
                       8.0F * fraction_rounding * frame.step;
    for (int i = 0; i < 2; ++i) room[i] = keep * length[i] + drift[i];
  }
};

/// Takes the place of Ray for bodies that are not rays.
struct NoRay {
  static constexpr bool is_ray = false;
  explicit NoRay(const Motion&) {}
};

/// The children that the ray may meet before t_max, with times: sweep_node() by the slabs alone.
HWY_INLINE void ray_node(const Node& node, const Frame& frame, const Motion& motion, const Ray& ray, float grown,
                         float t_max, Children& out) {
  const Boxes boxes(node, frame, motion.mirror);
  const auto* planes = reinterpret_cast<const std::uint8_t*>(&node);
  out.mask = 0;
  for (int first = 0; first < node_width; first += lane_count) {
    VF enter = hn::Zero(kF), exit = set(t_max);
    for (int k = 0; k < 3; ++k) {
      // The products with a bound are exact: fused or not gives the same bits.
      const VF in = hn::MulAdd(bounds_of(planes + motion.entry[k] + first), set(boxes.scale[k] * ray.early[k]),
                               set((boxes.at[k] - grown) * ray.early[k]));
      const VF end = hn::MulAdd(bounds_of(planes + motion.exit[k] + first), set(boxes.scale[k] * ray.late[k]),
                                set((boxes.at[k] + grown) * ray.late[k]));
      enter = hn::Max(enter, in);
      exit = hn::Min(exit, end);
    }
    enter = hn::Mul(enter, set(1.0F - time_roundings * float_unit));
    hn::Store(enter, kF, out.key + first);
    out.mask |= bits_of(hn::Le(enter, hn::Mul(exit, set(1.0F + time_roundings * float_unit)))) << first;
  }
  out.mask &= (1U << node.child_count) - 1;
}

/// Drops from `active` the triangles that the line of a ray certainly misses. In the projection along the line, where
/// it is a point, it then lies outside the triangle's box or beyond one of its edges.
///
/// With any numbers p and q and the directions u and v, w = p u + q v is perpendicular to the motion and is a valid
/// direction.
HWY_INLINE MF pierced(const Leaf& leaf, const Vertices& vertices, const Ray& ray, int first, MF active) {
  const Corners corners(leaf, first);
  VF at[2][3];
  for (int i = 0; i < 2; ++i) {
    const V3 w{set(ray.across[i][0]), set(ray.across[i][1]), set(ray.across[i][2])};
    corners.pick(
        [&](int from) {
          return dot(w, {vertices.at(0, from), vertices.at(1, from), vertices.at(2, from)});
        },
        at[i]);
    const VF least = hn::Min(hn::Min(at[i][0], at[i][1]), at[i][2]);
    const VF most = hn::Max(hn::Max(at[i][0], at[i][1]), at[i][2]);
    active = hn::AndNot(hn::Gt(hn::Max(least, hn::Neg(most)), set(ray.room[i])), active);
  }
  if (hn::AllFalse(kF, active)) return active;
  for (int e = 0; e < 3; ++e) {
    const int f = (e + 1) % 3, g = (e + 2) % 3;
    const VF p = hn::Sub(at[1][e], at[1][f]), q = hn::Sub(at[0][f], at[0][e]);
    const VF edge = hn::Add(hn::Mul(p, at[0][e]), hn::Mul(q, at[1][e]));
    const VF corner = hn::Add(hn::Mul(p, at[0][g]), hn::Mul(q, at[1][g]));
    const VF beside = hn::Max(hn::Min(edge, corner), hn::Neg(hn::Max(edge, corner)));
    const VF width = hn::Add(hn::Mul(hn::Abs(p), set(ray.room[0])), hn::Mul(hn::Abs(q), set(ray.room[1])));
    active = hn::AndNot(hn::Gt(beside, width), active);
  }
  return active;
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_RAY_INL_H_
