#include "box_search.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "affine.h"
#include "math/finite.h"
#include "osg_triangles/mesh_of.h"
#include "vectors.h"

namespace osgRoam {
namespace {

using roam::osg_triangles::Corners;

float rounded_down(double x) {
  const float rounded = static_cast<float>(x);
  return rounded <= x ? rounded : std::nextafter(rounded, -std::numeric_limits<float>::infinity());
}
float rounded_up(double x) { return -rounded_down(-x); }

}  // namespace

/// The functor for osg::KdTree::intersect().
struct BoxIntersector::KdTreeSearch {
  Search& search;

  bool enter(const osg::BoundingBox& box) const { return !search.outside(box); }
  void leave() const {}
  void intersect(const osg::Vec3Array*, unsigned, unsigned) const {}
  void intersect(const osg::Vec3Array*, unsigned, unsigned, unsigned) const {}
  void intersect(const osg::Vec3Array*, unsigned primitive, unsigned a, unsigned b, unsigned c) const {
    search.triangle({a, b, c, primitive, 0, true});
  }
  void intersect(const osg::Vec3Array*, unsigned primitive, unsigned a, unsigned b, unsigned c, unsigned d) const {
    search.triangle({a, b, c, primitive, 0, true});
    search.triangle({a, c, d, primitive, 1, true});
  }
};

BoxIntersector::Search::Search(BoxIntersector& below, osgUtil::IntersectionVisitor& visitor, osg::Drawable& drawable)
    : below_(below),
      root_(below.root()),
      visitor_(visitor),
      drawable_(drawable),
      from_(to_roam(below._start)),
      motion_(to_roam(below._end) - from_) {
  bring_box();
}

void BoxIntersector::Search::bring_box() {
  osg::Vec3d lower = root_._lower, upper = root_._upper;
  if (!below_._identity) {
    if (!below_._invertible) {
      constexpr float all = std::numeric_limits<float>::infinity();
      lower_.set(-all, -all, -all);
      upper_.set(all, all, all);
      return;
    }
    const osg::Vec3d centre = (lower + upper) * 0.5 * below_._inverse;
    osg::Vec3d half = turnedHalf((upper - lower) * 0.5, below_._inverse);
    // The inverse is exact to 1e-11 of local coordinates, and the differences of coordinates before it to 2^-51.
    const osg::Vec3d shift = below_._matrix.getTrans();
    osg::Vec3d coordinates;
    for (int k = 0; k < 3; ++k) coordinates[k] = std::max({std::abs(lower[k]), std::abs(upper[k]), std::abs(shift[k])});
    half += turnedHalf(coordinates, below_._inverse) * 0x1p-48;
    const double largest = (centre + half).length() + (centre - half).length();
    half += osg::Vec3d(largest, largest, largest) * 1e-9;
    lower = centre - half;
    upper = centre + half;
  }
  for (int k = 0; k < 3; ++k) {
    lower_[k] = rounded_down(lower[k]);
    upper_[k] = rounded_up(upper[k]);
  }
}

const osg::KdTree* BoxIntersector::Search::kd_tree(const osg::Geometry& geometry) const {
  if (!visitor_.getUseKdTreeWhenAvailable()) return nullptr;
  const auto* tree = dynamic_cast<const osg::KdTree*>(geometry.getShape());
  if (tree == nullptr || tree->getNodes().empty() || tree->getVertices() != geometry.getVertexArray()) return nullptr;
  // The index omits primitives with two equal corners. But segments are walls, and such quads may be triangles.
  if (tree->_degenerateCount != 0) return nullptr;
  // The index takes the corners of quad strips in the order of single quads.
  for (const auto& primitives : geometry.getPrimitiveSetList()) {
    if (primitives->getMode() == GL_QUAD_STRIP) return nullptr;
  }
  return tree;
}

void BoxIntersector::Search::run(const osg::Geometry& geometry) {
  if (const osg::KdTree* tree = kd_tree(geometry)) {
    begin(tree->getVertices()->asVector().data(), tree->getVertices()->size());
    KdTreeSearch search{*this};
    tree->intersect(search, tree->getNode(0));
  } else {
    roam::osg_triangles::Primitives<Search> primitives(*this);
    primitives.run(geometry);
  }
}

void BoxIntersector::Search::offer(const Corners& corners) {
  if (below_.reachedLimit()) return;
  const std::uint64_t index[3] = {corners.a, corners.b, corners.c};
  roam::Triangle triangle;
  for (int i = 0; i < 3; ++i) {
    const osg::Vec3d v = vertices_[index[i]];
    triangle[i] = to_roam(below_._identity ? v : v * below_._matrix);
    if (!roam::is_within_limit(triangle[i])) return;
  }
  for (int k = 0; k < 3; ++k) {
    const auto [least, most] = std::minmax({triangle[0][k], triangle[1][k], triangle[2][k]});
    if (most < root_._lower[k] || least > root_._upper[k]) return;
  }
  if (below_._gather) {
    root_._candidates.push_back(triangle);
  } else {
    sweep(triangle, corners);
  }
}

void BoxIntersector::Search::sweep(const roam::Triangle& triangle, const Corners& corners) {
  const double end = below_._intersectionLimit == LIMIT_NEAREST && !root_._intersections.empty()
                         ? root_._intersections.begin()->time
                         : 1.0;
  const roam::SweepResult result = roam::sweep(below_._body, from_, motion_, triangle, end);
  if (!result.hit) return;
  const auto earlier_than = [&](const Intersection& other) {
    return result.time != other.time ? result.time < other.time : result.distance < other.distance;
  };
  Intersections& all = root_._intersections;
  switch (below_._intersectionLimit) {
    case LIMIT_NEAREST:
      if (!all.empty() && !earlier_than(*all.begin())) return;
      all.clear();
      root_.shrinkTo(result.time);
      bring_box();
      break;
    case LIMIT_ONE_PER_DRAWABLE:
      if (has_kept_) {
        if (!earlier_than(*kept_)) return;
        all.erase(kept_);
      }
      break;
    default:
      break;
  }
  keep(result, triangle, corners);
}

void BoxIntersector::Search::keep(const roam::SweepResult& result, const roam::Triangle& triangle,
                                  const Corners& corners) {
  Intersection i;
  i.time = result.time;
  i.distance = result.distance;
  i.nodePath = visitor_.getNodePath();
  i.drawable = &drawable_;
  i.primitiveIndex = corners.primitive;
  i.half = corners.half;
  i.feature = result.feature;
  i.worldIntersectionPoint = to_osg(result.point);
  i.worldIntersectionNormal = to_osg(result.normal);
  if (below_._identity) {
    i.localIntersectionPoint = i.worldIntersectionPoint;
    i.localIntersectionNormal = i.worldIntersectionNormal;
  } else {
    i.matrix = new osg::RefMatrix(below_._matrix);
    i.localIntersectionPoint = local_point(result.point, triangle, corners);
    // Normals transform back by the transposed matrix.
    i.localIntersectionNormal = osg::Matrixd::transform3x3(below_._matrix, i.worldIntersectionNormal);
    i.localIntersectionNormal.normalize();
  }
  kept_ = root_._intersections.insert(i);
  has_kept_ = true;
}

osg::Vec3d BoxIntersector::Search::local_point(const roam::Vec3& point, const roam::Triangle& triangle,
                                               const Corners& corners) const {
  if (below_._invertible) return to_osg(point) * below_._inverse;
  // A matrix that flattens has no inverse. But the corners of the triangle are known in both frames.
  const osg::Vec3d a = vertices_[corners.a], e = vertices_[corners.b] - a, f = vertices_[corners.c] - a;
  const osg::Vec3d u = to_osg(triangle[1] - triangle[0]), v = to_osg(triangle[2] - triangle[0]);
  const osg::Vec3d p = to_osg(point - triangle[0]);
  const double uu = u * u, uv = u * v, vv = v * v, pu = p * u, pv = p * v;
  const double area = uu * vv - uv * uv;
  if (area > 0.0) return a + e * ((pu * vv - pv * uv) / area) + f * ((pv * uu - pu * uv) / area);
  if (uu > 0.0) return a + e * (pu / uu);
  return vv > 0.0 ? a + f * (pv / vv) : a;
}

}  // namespace osgRoam
