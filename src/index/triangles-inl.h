// The triangles of one leaf, as seen from the start of a query. Included once per instruction set by traverse.cpp.

#if defined(ROAM_INDEX_TRIANGLES_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef ROAM_INDEX_TRIANGLES_INL_H_
#undef ROAM_INDEX_TRIANGLES_INL_H_
#else
#define ROAM_INDEX_TRIANGLES_INL_H_
#endif

#include "index/grid.h"
#include "index/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace roam::index::HWY_NAMESPACE {

/// A vector of triangles, relative to the start of the query.
struct Triangles {
  V3 a, b, c;
  V3 ab, ac, normal;
  VF farthest;  ///< largest absolute coordinate
  // Set by prepare(): data of the closest point that do not depend on the body's position.
  V3 bc;
  V3 within_ab, within_ac, within_bc;  ///< perpendicular to each edge in the triangle's plane, inwards
  VF inv_ab2, inv_ac2, inv_bc2, inv_normal2;
  MF narrow;  ///< the normal is noise, so the edges stand for the face

  HWY_INLINE void prepare();
  [[nodiscard]] HWY_INLINE V3 away(const V3& p) const;
};

/// p minus the closest point of each triangle: the normal of the supporting plane. Inaccuracy costs only extra rounds.
HWY_INLINE V3 Triangles::away(const V3& p) const {
  const VF zero = hn::Zero(kF), one = set(1.0F);
  const V3 pa = p - a, pb = p - b;
  const V3 wab = pa - scale(ab, clamp(hn::Mul(dot(ab, pa), inv_ab2), zero, one));
  const V3 wac = pa - scale(ac, clamp(hn::Mul(dot(ac, pa), inv_ac2), zero, one));
  const V3 wbc = pb - scale(bc, clamp(hn::Mul(dot(bc, pb), inv_bc2), zero, one));
  const VF lab = dot(wab, wab), lac = dot(wac, wac), lbc = dot(wbc, wbc);
  const MF second = hn::Lt(lac, lab);
  V3 w = select(second, wac, wab);
  w = select(hn::Lt(lbc, hn::Min(lab, lac)), wbc, w);
  // Inside all three edges the foot on the face is closest. Each edge is tested perpendicular to itself: for slivers,
  // products of lengths along the edges would accept points far outside.
  const VF within = hn::Min(hn::Min(dot(within_ab, pa), dot(within_ac, pa)), dot(within_bc, pb));
  const MF inside = hn::AndNot(narrow, hn::Gt(within, zero));
  return select(inside, scale(normal, hn::Mul(dot(normal, pa), inv_normal2)), w);
}

/// The vertices of a leaf, metres from the start.
class Vertices {
 public:
  /// `low`: their low bits; null if the tile has none.
  HWY_INLINE Vertices(const Leaf& leaf, const FineLeaf* low, const Frame& frame) {
    const hn::Rebind<std::int16_t, F> words;
    if (low == nullptr) {
      place(leaf, frame, [&](int k, int) { return set(frame.rest[k]); });
    } else {
      place(leaf, frame, [&](int k, int from) {
        const VI steps = hn::PromoteTo(kI, hn::LoadU(words, low->vertex[k] + from));
        const VF part = hn::Mul(hn::ConvertTo(kF, steps), set(1.0F / static_cast<float>(fine_steps)));
        return hn::Sub(set(frame.rest[k]), part);
      });
    }
  }
  /// Coordinate `k` of vertices from .. from + lane_count - 1.
  [[nodiscard]] HWY_INLINE VF at(int k, int from) const { return at_[k][from / lane_count]; }

 private:
  /// `rest(k, from)`: what a coordinate in whole steps exceeds the true one by.
  template <class Rest>
  HWY_INLINE void place(const Leaf& leaf, const Frame& frame, const Rest& rest) {
    const hn::Rebind<std::uint16_t, F> words;
    for (int k = 0; k < 3; ++k) {
      for (int from = 0; from < node_width; from += lane_count) {
        const VI whole =
            hn::Sub(hn::PromoteTo(kI, hn::LoadU(words, leaf.vertex[k] + from)), hn::Set(kI, frame.whole[k]));
        at_[k][from / lane_count] = hn::Mul(hn::Sub(hn::ConvertTo(kF, whole), rest(k, from)), set(frame.step));
      }
    }
  }

  VF at_[3][node_width / lane_count];
};

/// The vertex numbers of the corners of triangles first .. first + lane_count - 1 of a leaf.
class Corners {
 public:
  HWY_INLINE Corners(const Leaf& leaf, int first) {
    alignas(64) static constexpr std::uint32_t vertex_shifts[node_width] = {0, 4, 8, 12, 16, 20, 24, 28,
                                                                            0, 4, 8, 12, 16, 20, 24, 28};
    const hn::RebindToUnsigned<F> u;
    for (int c = 0; c < 3; ++c) {
      auto packed = hn::Set(u, leaf.corner[c][first / 8]);
      if constexpr (lane_count == 16) packed = hn::IfThenElse(hn::FirstN(u, 8), packed, hn::Set(u, leaf.corner[c][1]));
      at_[c] = hn::BitCast(kI, hn::And(hn::Shr(packed, hn::Load(u, vertex_shifts + first)), hn::Set(u, 15U)));
    }
  }
  /// Picks from values `of(from)` of vertices from .. from + lane_count - 1 those of the three corners of each
  /// triangle.
  template <class Of>
  HWY_INLINE void pick(const Of& of, VF (&out)[3]) const {
    if constexpr (lane_count == 16) {
      const VF values = of(0);
      for (int c = 0; c < 3; ++c) out[c] = hn::TableLookupLanes(values, hn::IndicesFromVec(kF, at_[c]));
    } else if constexpr (lane_count == 8) {
      // Two permutes take a third of the time of a gather.
      const VF low = of(0), high = of(lane_count);
      const VI last = hn::Set(kI, lane_count - 1);
      for (int c = 0; c < 3; ++c) {
        const auto at = hn::IndicesFromVec(kF, hn::And(at_[c], last));
        out[c] = hn::IfThenElse(hn::RebindMask(kF, hn::Gt(at_[c], last)), hn::TableLookupLanes(high, at),
                                hn::TableLookupLanes(low, at));
      }
    } else {
      alignas(64) float table[node_width];
      for (int from = 0; from < node_width; from += lane_count) hn::Store(of(from), kF, table + from);
      for (int c = 0; c < 3; ++c) out[c] = hn::GatherIndex(kF, table, at_[c]);
    }
  }

 private:
  VI at_[3];
};

/// Triangles first .. first + lane_count - 1 of a leaf.
HWY_INLINE Triangles load_triangles(const Leaf& leaf, const Vertices& vertices, int first) {
  const Corners corners(leaf, first);
  VF x[3], y[3], z[3];
  corners.pick([&](int from) { return vertices.at(0, from); }, x);
  corners.pick([&](int from) { return vertices.at(1, from); }, y);
  corners.pick([&](int from) { return vertices.at(2, from); }, z);
  Triangles t;
  t.a = {x[0], y[0], z[0]};
  t.b = {x[1], y[1], z[1]};
  t.c = {x[2], y[2], z[2]};
  t.ab = t.b - t.a;
  t.ac = t.c - t.a;
  t.normal = cross(t.ab, t.ac);
  t.farthest = hn::Max(hn::Max(largest(t.a), largest(t.b)), largest(t.c));
  return t;
}

HWY_INLINE void Triangles::prepare() {
  bc = c - b;
  const VF ab2 = dot(ab, ab), ac2 = dot(ac, ac);
  const VF floor = set(shortest_way * shortest_way), face_floor = set(smallest_face), one = set(1.0F);
  const VF long_ab = hn::Max(ab2, floor), long_ac = hn::Max(ac2, floor), long_bc = hn::Max(dot(bc, bc), floor);
  // The roundings of a sliver's normal would tilt its face lengthwise. Made perpendicular to the longer of two edges,
  // they do not.
  const V3 edge = select(hn::Gt(ac2, ab2), ac, ab);
  normal = normal - scale(edge, hn::Div(dot(normal, edge), hn::Max(long_ab, long_ac)));
  within_ab = cross(normal, ab);
  within_ac = cross(ac, normal);
  within_bc = cross(normal, bc);
  // Two reciprocals from one division. In triangles some thousand kilometres wide a product overflows; then the closest
  // point is NaN or the query point itself, and bounds of gaps are weak.
  const VF long_normal = hn::Max(dot(normal, normal), face_floor);
  const VF edges = hn::Div(one, hn::Mul(long_ab, long_ac)), rest = hn::Div(one, hn::Mul(long_bc, long_normal));
  inv_ab2 = hn::Mul(long_ac, edges);
  inv_ac2 = hn::Mul(long_ab, edges);
  inv_bc2 = hn::Mul(long_normal, rest);
  inv_normal2 = hn::Mul(long_bc, rest);
  const VF width = hn::Mul(set(narrow_limit), farthest);  // to compare with the height over the longest edge
  const VF longest = hn::Max(hn::Max(long_ab, long_ac), long_bc);
  narrow = hn::Le(long_normal, hn::Max(face_floor, hn::Mul(hn::Mul(width, width), longest)));
}

}  // namespace roam::index::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // ROAM_INDEX_TRIANGLES_INL_H_
