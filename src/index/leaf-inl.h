// Tests of the triangles of one leaf against a moving or resting body. Included once per instruction set by
// traverse.cpp.

#if defined(ROAM_INDEX_LEAF_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_LEAF_INL_H_
#undef ROAM_INDEX_LEAF_INL_H_
#else
#define ROAM_INDEX_LEAF_INL_H_
#endif

#include <limits>

#include "index/triangles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

/// A supporting plane of a body at `centre`, unscaled: `bound` = distance bound times `length`.
struct Support {
  V3 away;
  VF length, bound;
  VF most;  ///< distance of some point of the axis from one of the triangle, except for rounding
};

HWY_INLINE Support support(const Triangles& t, const V3& centre, float half_height) {
  Support s;
  if (half_height == 0.0F) {
    s.away = t.away(centre);
    s.length = s.most = hn::Sqrt(dot(s.away, s.away));
  } else {
    const VF lowest = hn::Sub(centre.z, set(half_height)), highest = hn::Add(centre.z, set(half_height));
    const VF foot = hn::Min(hn::Min(t.a.z, t.b.z), t.c.z), head = hn::Max(hn::Max(t.a.z, t.b.z), t.c.z);
    V3 p = centre;
    p.z = clamp(clamp(p.z, foot, head), lowest, highest);
    s.away = t.away(p);
    // Stops once the nearest point of the axis no longer changes.
    for (int i = 0; i < projection_count; ++i) {
      const VF nearest = clamp(hn::Sub(p.z, s.away.z), lowest, highest);
      if (hn::AllTrue(kF, hn::Eq(nearest, p.z))) break;
      p.z = nearest;
      s.away = t.away(p);
    }
    s.most = hn::Sqrt(dot(s.away, s.away));
    // Between its ends the axis is nearest straight across. Any rest of w along the axis would be multiplied by its
    // height.
    const MF between = hn::And(hn::Gt(p.z, lowest), hn::Lt(p.z, highest));
    s.away.z = hn::IfThenZeroElse(between, s.away.z);
    s.length = hn::Sqrt(dot(s.away, s.away));
  }
  s.bound = hn::Min(hn::Min(dot(s.away, centre - t.a), dot(s.away, centre - t.b)), dot(s.away, centre - t.c));
  if (half_height != 0.0F) s.bound = hn::Sub(s.bound, hn::Mul(set(half_height), hn::Abs(s.away.z)));
  return s;
}

/// The triangles of a leaf that are not certainly missed.
struct Met {
  alignas(64) float time[node_width];  ///< the body is free until then
  std::uint32_t arrived;               ///< bits: the body is then within the arrival distance, a hit
  std::uint32_t open;                  ///< bits: to be decided in double precision from that time on
  float until;                         ///< the body is free of the other triangles until then
};

/// Metres. Error of a computed bound, for each triangle, after the body has moved by `way` metres.
HWY_INLINE VF leaf_error(const Triangles& t, VF way, const Frame& frame, float half_height) {
  return hn::Add(hn::Mul(set(leaf_roundings * float_unit), hn::Add(hn::Max(t.farthest, way), set(half_height))),
                 set(4.0F * fraction_rounding * frame.step));
}

/// The times at which the slack (m times length) is used up at `speed` (m times length per whole motion), where
/// `active`.
HWY_INLINE VF advanced(VF time, VF slack, VF speed, MF active) {
  const VF step =
      hn::Mul(hn::Div(slack, hn::IfThenElse(active, speed, set(1.0F))), set(1.0F - time_roundings * float_unit));
  return hn::IfThenElse(active, hn::Add(time, step), time);
}

/// Drops from `active` the triangles whose own plane, as rounded, keeps the body off from `time` to `end`. This is the
/// cheapest supporting plane and settles most triangles. For the others `time` advances as far as the plane allows: for
/// a hit face, about to the time of the hit.
HWY_INLINE void keep_off_planes(const Triangles& t, const V3& way, VF end, VF keep, VF error, float longest,
                                float half_height, VF& time, MF& active) {
  const V3& n = t.normal;
  const VF a = dot(n, t.a), b = dot(n, t.b), c = dot(n, t.c), along = dot(n, way), place = hn::Mul(along, time);
  const VF above = hn::Sub(place, hn::Max(hn::Max(a, b), c)), below = hn::Sub(hn::Min(hn::Min(a, b), c), place);
  const VF length = hn::Sqrt(dot(n, n));
  VF slack = hn::Sub(hn::Max(above, below), hn::Mul(hn::Add(keep, error), length));
  if (half_height != 0.0F) slack = hn::Sub(slack, hn::Mul(set(half_height), hn::Abs(n.z)));
  const VF speed = hn::Add(hn::IfThenElse(hn::Gt(above, below), hn::Neg(along), along),
                           hn::Mul(set(speed_roundings * float_unit * longest), length));
  const MF apart = hn::And(hn::Gt(slack, hn::Zero(kF)), hn::Gt(length, set(shortest_way)));
  const MF missed = hn::And(apart, hn::Ge(slack, hn::Mul(hn::Sub(end, time), speed)));
  active = hn::AndNot(missed, active);
  time = advanced(time, slack, speed, hn::And(active, apart));
}

/// Advances the body against all triangles of a leaf from t_entry, until which they are known to be free, to t_max. A
/// triangle counts as arrived within hit_limit of the axis; a negative hit_limit leaves all decisions to double
/// precision. With `first_only`, an arrival drops the triangles whose turn certainly comes later: the earliest impact
/// stays the same to the bit.
template <bool first_only>
HWY_INLINE void sweep_leaf(const Leaf& leaf, const FineLeaf* low, const Frame& frame, const Motion& motion,
                           float radius, float hit_limit, float t_entry, float t_max, Met& out) {
  out.arrived = out.open = 0;
  const V3 way{set(motion.way[0]), set(motion.way[1]), set(motion.way[2])};
  const VF keep = set(radius * (1.0F + radius_roundings * float_unit));
  const VF zero = hn::Zero(kF);
  VF end = set(t_max);
  const Vertices vertices(leaf, low, frame);
  for (int first = 0; first < leaf.triangle_count; first += lane_count) {
    MF active = hn::FirstN(kF, static_cast<std::size_t>(leaf.triangle_count - first));
    Triangles t = load_triangles(leaf, vertices, first);
    VF time = set(t_entry);
    keep_off_planes(t, way, end, keep, leaf_error(t, set(t_max * motion.longest), frame, motion.half_height),
                    motion.longest, motion.half_height, time, active);
    if (hn::AllFalse(kF, active)) continue;
    t.prepare();
    MF arrived = hn::FirstN(kF, 0), open = hn::FirstN(kF, 0);
    for (int round = 0; round < round_count; ++round) {
      const V3 centre = scale(way, time);
      const Support s = support(t, centre, motion.half_height);
      const VF error = leaf_error(t, hn::Mul(time, set(motion.longest)), frame, motion.half_height);
      const VF slack = hn::Sub(s.bound, hn::Mul(hn::Add(keep, error), s.length));
      const VF speed = hn::Sub(hn::Mul(set(speed_roundings * float_unit * motion.longest), s.length), dot(s.away, way));
      const MF apart = hn::And(hn::Ge(slack, zero), hn::Gt(s.length, set(shortest_way)));
      const MF missed = hn::And(apart, hn::Ge(slack, hn::Mul(hn::Sub(end, time), speed)));
      const VF reached = hn::Min(hn::Add(keep, hn::Add(set(arrival_tolerance), hn::Add(error, error))), set(hit_limit));
      // At time 0 a body that is not certainly apart may be touching; double precision decides that.
      const MF near = hn::And(hn::Le(hn::Add(s.most, error), reached), hn::Or(apart, hn::Gt(time, zero)));
      const MF there = hn::And(active, near);
      MF hit = hn::AndNot(missed, there);
      if constexpr (first_only) {
        // Near, but free until the earliest arrival: it counts if it is not free until t_max.
        const MF grazed = hn::And(missed, there);
        if (!hn::AllFalse(kF, grazed)) {
          hit = hn::Or(hit, hn::AndNot(hn::Ge(slack, hn::Mul(hn::Sub(set(t_max), time), speed)), grazed));
        }
      }
      active = hn::AndNot(hn::Or(missed, hit), active);
      arrived = hn::Or(arrived, hit);
      if (first_only && !hn::AllFalse(kF, hit)) {
        const VF earliest = hn::MinOfLanes(kF, hn::IfThenElse(hit, time, end));
        end = hn::Min(end, hn::Mul(earliest, set(1.0F + later_roundings * float_unit)));
        active = hn::And(active, hn::Le(time, end));
      }
      const MF stuck = hn::AndNot(hn::And(apart, hn::Gt(slack, zero)), active);
      open = hn::Or(open, stuck);
      active = hn::AndNot(stuck, active);
      if (hn::AllFalse(kF, active)) break;
      time = advanced(time, slack, speed, active);
    }
    open = hn::Or(open, active);
    hn::Store(time, kF, out.time + first);
    out.arrived |= bits_of(arrived) << first;
    out.open |= bits_of(open) << first;
  }
  out.until = hn::GetLane(end);
}

/// Accepts bounds at most settled_gap below the distance.
struct Tight {
  static constexpr bool is_loose = false, is_boxed = false;
  Tight(double, double, double, double) {}
  /// The greatest distance for which the bound is good enough.
  [[nodiscard]] HWY_INLINE VF enough(VF bound) const { return hn::Add(bound, set(settled_gap)); }
};

/// The same for triangles between two heights: boxes are tested first.
struct Layer : Tight {
  static constexpr bool is_boxed = true;
  using Tight::Tight;
};

/// Accepts bounds that lose part of the gap. Of the distance to the stored triangle less the radius and the tile's
/// error, a bound must keep at least 1 - part. This holds only within `reach`: beyond it, a loose bound could report a
/// triangle as nearer than `reach`.
struct Slack {
  static constexpr bool is_loose = true, is_boxed = true;
  float factor, less, farthest;

  Slack(double part, double radius, double error, double reach)
      : factor(static_cast<float>(1.0 / (1.0 - part))),
        less(static_cast<float>((radius + error) / (1.0 - part) - radius + error)),
        farthest(static_cast<float>(radius + reach - error)) {}
  [[nodiscard]] HWY_INLINE VF enough(VF bound) const {
    const VF loose = hn::Min(hn::Sub(hn::Mul(bound, set(factor)), set(less)), set(farthest));
    return hn::Max(hn::Add(bound, set(settled_gap)), loose);
  }
};

/// Lower bound of the distance between triangles and the body's axis during the whole motion, by the triangles' own
/// planes; the caller subtracts the roundings.
HWY_INLINE VF off_planes(const Triangles& t, const V3& way, float half_height) {
  const V3& n = t.normal;
  const VF zero = hn::Zero(kF), a = dot(n, t.a), b = dot(n, t.b), c = dot(n, t.c), along = dot(n, way);
  const VF above = hn::Sub(hn::Min(zero, along), hn::Max(hn::Max(a, b), c));
  const VF below = hn::Sub(hn::Min(hn::Min(a, b), c), hn::Max(zero, along));
  const VF length = hn::Sqrt(dot(n, n));
  VF off = hn::Max(above, below);
  if (half_height != 0.0F) off = hn::Sub(off, hn::Mul(set(half_height), hn::Abs(n.z)));
  const MF known = hn::Gt(length, set(shortest_way));
  return hn::Mul(hn::Div(hn::IfThenElseZero(known, off), hn::IfThenElse(known, length, set(1.0F))),
                 set(1.0F - time_roundings * float_unit));
}

/// The triangles that may come within `reach` of the body's axis during its motion, with lower bounds of their
/// distances. `left` is lowered to the least bound of the others. `most` is set to an upper bound of the distance,
/// except for rounding.
///
/// Any w gives a bound. For the whole motion m, seen from any point of the axis at the fraction t of the motion,
/// |w| distance >= min_i w.(t m - v_i) - h |w_z| - max(t w.m, (t - 1) w.m). A good w leads from the closest point to
/// the nearest point of the swept axis. It is perpendicular to the motion and to the axis unless that point is at one
/// of their ends.
template <class Bounds>
HWY_INLINE void near_leaf(const Leaf& leaf, const FineLeaf* low, const Frame& frame, const Way& way, float reach,
                          const Bounds& bounds, VF& left, Children& out, float* most) {
  out.mask = 0;
  const VF zero = hn::Zero(kF), one = set(1.0F), h = set(way.half_height);
  const V3 m{set(way.way[0]), set(way.way[1]), set(way.way[2])};
  const Vertices vertices(leaf, low, frame);
  const int rounds = way.moves || way.half_height > 0.0F ? near_rounds : 1;
  for (int first = 0; first < leaf.triangle_count; first += lane_count) {
    Triangles t = load_triangles(leaf, vertices, first);
    const VF error = hn::Add(leaf_error(t, set(way.longest), frame, way.half_height),
                             set(speed_roundings * float_unit * way.longest));
    const MF triangle = hn::FirstN(kF, static_cast<std::size_t>(leaf.triangle_count - first));
    MF active = triangle;
    VF least = zero;
    // Where part of the gap may be lost, the triangles' planes settle most leaves at no cost in tightness.
    if constexpr (Bounds::is_loose) {
      least = hn::Sub(off_planes(t, m, way.half_height), error);
      const MF beyond = hn::And(triangle, hn::Gt(least, set(reach)));
      left = hn::Min(left, hn::IfThenElse(beyond, least, left));
      active = hn::AndNot(beyond, triangle);
      if (hn::AllFalse(kF, active)) continue;
      least = hn::Max(least, zero);
    }
    t.prepare();
    MF unsettled = active;
    VF time = zero, height = zero, nearest = set(std::numeric_limits<float>::max());
    // Finds the point of the swept axis nearest to p: first along the motion, then along the axis.
    const auto approach = [&](const V3& p) {
      if (way.moves) {
        const V3 from{p.x, p.y, hn::Sub(p.z, height)};
        time = clamp(hn::Mul(dot(from, m), set(way.inverse_square)), zero, one);
      }
      if (way.half_height > 0.0F) height = clamp(hn::Sub(p.z, hn::Mul(time, m.z)), hn::Neg(h), h);
    };
    const VF third = set(1.0F / 3.0F);
    approach({hn::Add(t.a.x, hn::Mul(third, hn::Add(t.ab.x, t.ac.x))),
              hn::Add(t.a.y, hn::Mul(third, hn::Add(t.ab.y, t.ac.y))),
              hn::Add(t.a.z, hn::Mul(third, hn::Add(t.ab.z, t.ac.z)))});
    for (int round = 0;; ++round) {
      const V3 centre = scale(m, time), place{centre.x, centre.y, hn::Add(centre.z, height)};
      V3 w = t.away(place);
      nearest = hn::IfThenElse(unsettled, hn::Min(nearest, dot(w, w)), nearest);
      const V3 closest = place - w;
      VF inverse = set(way.inverse_square);
      V3 across = m;
      if (way.half_height > 0.0F) {
        const MF inside = hn::Lt(hn::Abs(height), h);
        w.z = hn::IfThenZeroElse(inside, w.z);
        across.z = hn::IfThenZeroElse(inside, m.z);
        inverse = hn::IfThenElse(inside, set(way.inverse_flat), inverse);
      }
      VF lost = zero;
      if (way.moves) {
        const auto loss = [&](VF along) { return hn::Max(hn::Mul(time, along), hn::Mul(hn::Sub(time, one), along)); };
        const VF along = dot(w, m);
        const VF excess = hn::IfThenElseZero(hn::Gt(loss(along), zero), hn::Mul(along, inverse));
        w = w - scale(across, excess);
        lost = loss(dot(w, m));
      }
      const VF length = hn::Sqrt(dot(w, w));
      VF bound = hn::Min(hn::Min(dot(w, centre - t.a), dot(w, centre - t.b)), dot(w, centre - t.c));
      if (way.half_height > 0.0F) bound = hn::Sub(bound, hn::Mul(h, hn::Abs(w.z)));
      bound = hn::Sub(bound, lost);
      const MF sure = hn::And(unsettled, hn::Gt(length, set(shortest_way)));
      const VF apart = hn::Sub(
          hn::Mul(hn::Div(bound, hn::IfThenElse(sure, length, one)), set(1.0F - time_roundings * float_unit)), error);
      least = hn::IfThenElse(hn::And(sure, hn::Gt(apart, least)), apart, least);
      active = hn::AndNot(hn::Gt(least, set(reach)), active);
      if (round + 1 == rounds) break;
      const VF enough = bounds.enough(least);
      unsettled = hn::And(active, hn::AndNot(hn::Le(nearest, hn::Mul(enough, enough)), unsettled));
      if (hn::AllFalse(kF, unsettled)) break;
      approach(closest);
    }
    const MF out_of_reach = hn::AndNot(active, triangle);
    left = hn::Min(left, hn::IfThenElse(out_of_reach, least, left));
    hn::Store(least, kF, out.key + first);
    hn::Store(hn::Sqrt(nearest), kF, most + first);
    out.mask |= bits_of(active) << first;
  }
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_LEAF_INL_H_
