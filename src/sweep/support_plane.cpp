#include "sweep/support_plane.h"

#include <algorithm>
#include <cmath>

#include "sweep/closest_point.h"
#include "sweep/error_bound.h"

namespace roam::certified {
namespace {

double span_along_axis(const Obstacle& o, const Vec3& n) { return o.half_height * std::abs(n.z); }

/// Unit vector along `x`, or zero where its length cannot be trusted.
Vec3 unit(const Vec3& x) {
  const double squared = glm::dot(x, x);
  return squared > shortest_squared ? x * (1.0 / std::sqrt(squared)) : Vec3(0.0);
}

/// A unit vector perpendicular to `x`, horizontal if `x` is not vertical; for zero, any unit vector.
Vec3 any_perpendicular(const Vec3& x) {
  const Vec3 level = unit({x.y, -x.x, 0.0});
  return level == Vec3(0.0) ? Vec3(1.0, 0.0, 0.0) : level;
}

/// Keeps the best of the considered planes. Every direction stands for itself and its opposite.
struct BestPlane {
  Obstacle& obstacle;
  Vec3 centre;
  double value = -std::numeric_limits<double>::infinity();
  Vec3 normal{0.0, 0.0, 1.0};
  double offset = 0.0;

  void consider(const Vec3& direction) {
    const Vec3 n = unit(direction);
    if (n == Vec3(0.0)) return;
    const double a = glm::dot(n, obstacle.corner[0]), b = glm::dot(n, obstacle.corner[1]),
                 c = glm::dot(n, obstacle.corner[2]);
    const double span = span_along_axis(obstacle, n), height = glm::dot(n, centre);
    keep(n, -std::max({a, b, c}) - span, height);
    keep(-n, std::min({a, b, c}) - span, -height);
  }

  void keep(const Vec3& n, double its_offset, double height) {
    if (!(height + its_offset > value)) return;
    value = height + its_offset;
    normal = n;
    offset = its_offset;
  }
};

/// The greatest of the planes of all pairs of features. For disjoint bodies these include the normal of the closest
/// pair; for overlapping ones, the facets of their Minkowski sum (Gottschalk et al., "OBBTree", 1996).
void consider_every_pair_of_features(BestPlane& best) {
  Obstacle& o = best.obstacle;
  const Vec3 up(0.0, 0.0, o.half_height);
  const int ends = o.half_height > 0.0 ? 2 : 1;
  best.consider(o.face_normal());
  best.consider(any_perpendicular(o.edge[o.longest_edge()]));
  for (int i = 0; i < 3; ++i) {
    for (int end = 0; end < ends; ++end) {
      const Vec3 x = (end == 0 ? best.centre + up : best.centre - up) - o.corner[i];
      best.consider(x);
      if (o.edge_squared[i] > shortest_squared) best.consider(perpendicular_to_edge(o, i, x));
    }
    if (ends == 2) {
      best.consider({o.edge[i].y, -o.edge[i].x, 0.0});
      best.consider({best.centre.x - o.corner[i].x, best.centre.y - o.corner[i].y, 0.0});
    }
  }
}

}  // namespace

Obstacle::Obstacle(const Vec3 (&corners)[3], double half_height_m) noexcept : half_height(half_height_m) {
  for (int i = 0; i < 3; ++i) corner[i] = corners[i];
  for (int i = 0; i < 3; ++i) {
    edge[i] = corners[(i + 1) % 3] - corners[i];
    edge_squared[i] = glm::dot(edge[i], edge[i]);
  }
}

int Obstacle::longest_edge() const noexcept {
  const int i = edge_squared[0] >= edge_squared[1] ? 0 : 1;
  return edge_squared[2] > edge_squared[i] ? 2 : i;
}

void Obstacle::find_face_normal() noexcept {
  face_normal_known_ = true;
  face_normal_ = unit(glm::cross(edge[0], edge[1]));
  // Along the longest edge even a small tilt costs much. The cross product of a sliver is mostly rounding; after this
  // step its normal is as good as the sliver is thin.
  if (face_normal_ != Vec3(0.0)) face_normal_ = unit(perpendicular_to_edge(*this, longest_edge(), face_normal_));
}

SupportPlane support_plane(Obstacle& o, const Vec3& centre, double slack) noexcept {
  const Closest closest = closest_to_axis(o, centre);
  SupportPlane plane{Vec3(0.0), 0.0, closest.point, closest.feature, closest.straight};
  if (closest.away_squared > shortest_squared) {
    // A face's normal has length 1 already. The quotient of the root would be on the longest chain of a contact.
    const bool is_unit = closest.away_squared == 1.0;
    const Vec3 n = is_unit ? closest.away : closest.away * (1.0 / std::sqrt(closest.away_squared));
    const double farthest = std::max({glm::dot(n, o.corner[0]), glm::dot(n, o.corner[1]), glm::dot(n, o.corner[2])});
    plane.normal = n;
    plane.offset = -farthest - span_along_axis(o, n);
    // Lower bound and distance agree, so no other plane can be better. They never agree where the axis pierces the
    // face.
    if (plane.value(centre) >= std::sqrt(closest.squared) - slack) return plane;
  }
  BestPlane best{o, centre};
  consider_every_pair_of_features(best);
  plane.normal = best.normal;
  plane.offset = best.offset;
  if (best.value <= 0.0) {
    // They overlap: the relevant point is the last one left on the way out, which stays closest beyond.
    const Closest last = closest_to_axis(o, centre + (slack - 2.0 * best.value) * best.normal);
    plane.point = last.point;
    plane.feature = last.feature;
  }
  return plane;
}

}  // namespace roam::certified
