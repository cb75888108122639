#include "sweep/closest_point.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep/error_bound.h"

namespace roam::certified {
namespace {

/// Relative, for squared distances. Up to this factor a point computed from barycentric shares counts as the foot of
/// the perpendicular. Only speed depends on it: beyond it the edges are tried as well.
constexpr double face_trust = 1.0 + 1e-9;

/// A triangle is a sliver if the square of twice its area is less than this part of its longest edge to the fourth: it
/// is ten thousand times as long as wide. Its normal is so inexact that a foot on its plane may lie beside it.
constexpr double sliver_part = 1e-8;

void improve(Closest& best, const Closest& other) {
  if (other.squared < best.squared) best = other;
}

Closest at_vertex(const Obstacle& o, int i, const Vec3& p) {
  const Vec3 away = p - o.corner[i];
  const double squared = glm::dot(away, away);
  return {away, squared, squared, o.corner[i], Feature::vertex};
}

Closest at_edge(const Obstacle& o, int i, const Vec3& p) {
  const double along = glm::dot(p - o.corner[i], o.edge[i]);
  if (!(along > 0.0 && o.edge_squared[i] > shortest_squared)) return at_vertex(o, i, p);
  if (!(along < o.edge_squared[i])) return at_vertex(o, (i + 1) % 3, p);
  const Vec3 away = perpendicular_to_edge(o, i, p - o.corner[i]);
  const double squared = glm::dot(away, away);
  return {away, squared, squared, p - away, Feature::edge, o.edge[i]};
}

Closest at_any_edge(const Obstacle& o, const Vec3& p) {
  Closest best = at_edge(o, 0, p);
  for (int i = 1; i < 3; ++i) improve(best, at_edge(o, i, p));
  return best;
}

/// The face, for a point that seems to be over it. The corners' shares give a point that is certainly on the triangle.
/// For a sliver they are mostly rounding, and an edge may be closer. A triangle without a normal has no face.
Closest at_face(Obstacle& o, const Vec3& p, double a_share, double b_share, double c_share) {
  const Vec3& normal = o.face_normal();
  const double height = glm::dot(normal, p - o.corner[0]);
  const double sum = a_share + b_share + c_share, whole = 1.0 / sum;
  const Vec3 x = p - (o.corner[0] + (b_share * whole) * o.edge[0] - (c_share * whole) * o.edge[2]);
  double squared = glm::dot(x, x);
  if (squared == 0.0 && normal == Vec3(0.0)) return at_any_edge(o, p);
  const double longest = std::max({o.edge_squared[0], o.edge_squared[1], o.edge_squared[2]});
  const bool is_sliver = sum < sliver_part * longest * longest;
  if (!(squared <= height * height * face_trust)) {
    const Closest edge = at_any_edge(o, p);
    // The shares of a large triangle are less exact than the foot on an edge, and the side on which that is.
    const bool is_inside =
        !is_sliver && edge.feature == Feature::edge && glm::dot(edge.away, glm::cross(normal, edge.straight)) > 0.0;
    if ((!(squared < edge.squared) && !is_inside) || normal == Vec3(0.0)) return edge;
    squared = std::min(squared, edge.squared);
  }
  const Vec3 point = p - (is_sliver ? x : height * normal);
  return {height < 0.0 ? -normal : normal, 1.0, squared, point, Feature::face};
}

/// The axis, without its ends, against one edge. If their closest points are not inside the axis, an end of the axis is
/// closer to the triangle and `best` already has it.
void improve_with_axis_and_edge(const Obstacle& o, int i, const Vec3& centre, Closest& best) {
  const Vec3 x = centre - o.corner[i];
  const Vec3& e = o.edge[i];
  const double flat = e.x * e.x + e.y * e.y;
  const double s = flat > 0.0 ? std::clamp((x.x * e.x + x.y * e.y) / flat, 0.0, 1.0)
                              : (e.z != 0.0 ? std::clamp(x.z / e.z, 0.0, 1.0) : 0.0);
  if (!(std::abs(s * e.z - x.z) <= o.half_height)) return;
  const bool inside = s > 0.0 && s < 1.0;
  Closest c;
  c.point = o.corner[i] + s * e;
  c.feature = inside ? Feature::edge : Feature::vertex;
  if (inside && flat > 0.0) {
    // Exactly perpendicular to the axis, and to the edge as well as its digits allow.
    const double across = (x.x * e.y - x.y * e.x) / flat;
    c.away = {across * e.y, -across * e.x, 0.0};
  } else {
    const Vec3& nearest = s < 1.0 ? o.corner[i] : o.corner[(i + 1) % 3];
    c.away = {centre.x - nearest.x, centre.y - nearest.y, 0.0};
    c.straight = {0.0, 0.0, 1.0};
  }
  c.squared = c.away_squared = glm::dot(c.away, c.away);
  improve(best, c);
}

}  // namespace

Vec3 perpendicular_to_edge(const Obstacle& o, int i, const Vec3& x) noexcept {
  const Vec3& e = o.edge[i];
  const double inverse = 1.0 / o.edge_squared[i];
  const Vec3 once = x - e * (glm::dot(x, e) * inverse);
  // The first pass leaves an error relative to |x|, the second one relative to the rest of the first (Kahan and
  // Parlett's "twice is enough": Parlett, "The Symmetric Eigenvalue Problem", 6.9).
  return once - e * (glm::dot(once, e) * inverse);
}

// The regions follow Ericson, "Real-Time Collision Detection", 5.1.5.
Closest closest_to_point(Obstacle& o, const Vec3& p) noexcept {
  const Vec3& ab = o.edge[0];
  const Vec3 ac = -o.edge[2];
  const Vec3 ap = p - o.corner[0];
  const double ap_ab = glm::dot(ab, ap), ap_ac = glm::dot(ac, ap);
  if (ap_ab <= 0.0 && ap_ac <= 0.0) return at_vertex(o, 0, p);
  const Vec3 bp = p - o.corner[1];
  const double bp_ab = glm::dot(ab, bp), bp_ac = glm::dot(ac, bp);
  if (bp_ab >= 0.0 && bp_ac <= bp_ab) return at_vertex(o, 1, p);
  const Vec3 cp = p - o.corner[2];
  const double cp_ab = glm::dot(ab, cp), cp_ac = glm::dot(ac, cp);
  if (cp_ac >= 0.0 && cp_ab <= cp_ac) return at_vertex(o, 2, p);
  const double c_share = ap_ab * bp_ac - bp_ab * ap_ac;
  const double b_share = cp_ab * ap_ac - ap_ab * cp_ac;
  const double a_share = bp_ab * cp_ac - cp_ab * bp_ac;
  // Strictly outside the face: for a segment all three shares are 0, and at_face then tries every edge.
  if (c_share < 0.0 && ap_ab >= 0.0 && bp_ab <= 0.0) return at_edge(o, 0, p);
  if (b_share < 0.0 && ap_ac >= 0.0 && cp_ac <= 0.0) return at_edge(o, 2, p);
  if (a_share < 0.0 && bp_ac >= bp_ab && cp_ab >= cp_ac) return at_edge(o, 1, p);
  return at_face(o, p, a_share, b_share, c_share);
}

Closest closest_to_axis(Obstacle& o, const Vec3& centre) noexcept {
  if (o.half_height == 0.0) return closest_to_point(o, centre);
  const Vec3 up(0.0, 0.0, o.half_height);
  const double top = centre.z + o.half_height, bottom = centre.z - o.half_height;
  const double highest = std::max({o.corner[0].z, o.corner[1].z, o.corner[2].z});
  const double lowest = std::min({o.corner[0].z, o.corner[1].z, o.corner[2].z});
  Closest best;
  best.squared = std::numeric_limits<double>::infinity();
  // An end of the axis can only be closest to triangles that reach beyond it.
  if (highest > top) best = closest_to_point(o, centre + up);
  if (lowest < bottom) improve(best, closest_to_point(o, centre - up));
  if (highest < bottom || lowest > top) return best;
  for (int i = 0; i < 3; ++i) improve_with_axis_and_edge(o, i, centre, best);
  // Rounding can hide an edge at the same height as an end.
  if (best.squared == std::numeric_limits<double>::infinity()) {
    best = closest_to_point(o, centre + up);
    improve(best, closest_to_point(o, centre - up));
  }
  return best;
}

}  // namespace roam::certified
