#include <algorithm>
#include <cmath>
#include <limits>
#include <osg/Billboard>
#include <tuple>

#include "affine.h"
#include "box_search.h"
#include "math/floating_point.h"
#include "osgRoam/BoxIntersector.h"
#include "osg_triangles/graph_walk.h"
#include "roam/error.h"
#include "sphere_box.h"

namespace osgRoam {
namespace {

/// Rounding of a bounding box in floats, relative to each coordinate. A box only copies coordinates, so this covers the
/// conversion of vertices in doubles.
constexpr double boxRounding = 0x1p-23;
/// Rounding of the computations here in doubles, relative to each coordinate.
constexpr double ownRounding = 1e-12;

double size(const osg::Vec3d& v) { return std::abs(v.x()) + std::abs(v.y()) + std::abs(v.z()); }

void check(osgUtil::Intersector::CoordinateFrame frame) {
  if (frame == osgUtil::Intersector::MODEL || frame == osgUtil::Intersector::VIEW) return;
  throw roam::Error(
      "osgRoam::BoxIntersector cannot work in window or projection coordinates, where a body has no radius; give it "
      "the frame MODEL or VIEW.");
}

/// Whether the contents of the last node of the path lie outside of the scene's space.
bool isElsewhere(const osg::NodePath& path) {
  if (!path.empty() && dynamic_cast<const osg::Billboard*>(path.back()) != nullptr) return true;
  // A camera at the start of the path is what the caller wants to query.
  return std::any_of(path.begin() + (path.empty() ? 0 : 1), path.end(),
                     [](const osg::Node* node) { return roam::osg_triangles::draws_elsewhere(*node); });
}

}  // namespace

BoxIntersector::BoxIntersector(const roam::Body& body, const osg::Vec3d& start, const osg::Vec3d& end)
    : BoxIntersector(MODEL, body, start, end) {}

BoxIntersector::BoxIntersector(CoordinateFrame frame, const roam::Body& body, const osg::Vec3d& start,
                               const osg::Vec3d& end)
    : osgUtil::Intersector(frame, LIMIT_NEAREST), _body(body), _start(start), _end(end) {
  const roam::DefaultFloatingPoint guard;
  check(frame);
  // A sweep against a degenerate triangle checks the arguments.
  const roam::Vec3 from{start.x(), start.y(), start.z()};
  static_cast<void>(roam::sweep(body, from, roam::Vec3{end.x(), end.y(), end.z()} - from, {from, from, from}));
  shrinkTo(1.0);
}

void BoxIntersector::setBoundsMargin(double margin) {
  checkBoundsMargin(margin);
  _boundsMargin = margin;
}

void BoxIntersector::shrinkTo(double time) {
  const osg::Vec3d end = _start + (_end - _start) * time;
  const double rounding = ownRounding * (size(_start) + size(_end));
  for (int k = 0; k < 3; ++k) {
    const double grown = _body.radius + (k == 2 ? _body.half_height : 0.0) + rounding;
    _lower[k] = std::min(_start[k], end[k]) - grown;
    _upper[k] = std::max(_start[k], end[k]) + grown;
  }
}

osgUtil::Intersector* BoxIntersector::clone(osgUtil::IntersectionVisitor& visitor) {
  const roam::DefaultFloatingPoint guard;
  check(_coordinateFrame);
  osg::ref_ptr<BoxIntersector> below = new BoxIntersector(_coordinateFrame, _body, _start, _end);
  below->_parent = &root();
  below->_intersectionLimit = _intersectionLimit;
  below->_precisionHint = _precisionHint;
  below->_gather = _gather;
  below->_boundsMargin = _boundsMargin;
  osg::Matrixd matrix;
  if (_coordinateFrame == VIEW && visitor.getViewMatrix() != nullptr) matrix = *visitor.getViewMatrix();
  if (visitor.getModelMatrix() != nullptr) matrix.preMult(*visitor.getModelMatrix());
  below->_identity = matrix.isIdentity();
  if (!below->_identity) {
    below->_matrix = matrix;
    below->_stretch = greatestStretch(matrix);
    below->_invertible = below->_inverse.invert_4x3(matrix) && isInverse(matrix, below->_inverse);
  }
  return below.release();
}

bool BoxIntersector::beyond(const osg::Vec3d& centre, double radius) {
  const osg::Vec3d c = _identity ? centre : centre * _matrix;
  const BoxIntersector& whole = root();
  double squared = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double d = std::max({whole._lower[k] - c[k], c[k] - whole._upper[k], 0.0});
    squared += d * d;
  }
  const double reach = radius * _stretch + ownRounding * size(c);
  // False for a NaN.
  return squared > reach * reach;
}

bool BoxIntersector::beyond(const osg::BoundingBox& box) {
  const osg::Vec3d lower = box._min, upper = box._max;
  const double margin = boxRounding * (size(lower) + size(upper));
  const osg::Vec3d centre = (lower + upper) * 0.5;
  osg::Vec3d half = (upper - lower) * 0.5 + osg::Vec3d(margin, margin, margin);
  const osg::Vec3d c = _identity ? centre : centre * _matrix;
  if (!_identity) half = turnedHalf(half, _matrix);
  const BoxIntersector& whole = root();
  const double grown = _boundsMargin + ownRounding * (size(c) + size(half));
  for (int k = 0; k < 3; ++k) {
    if (c[k] + half[k] + grown < whole._lower[k] || c[k] - half[k] - grown > whole._upper[k]) return true;
  }
  return false;
}

bool BoxIntersector::enter(const osg::Node& node) {
  const roam::DefaultFloatingPoint guard;
  if (reachedLimit()) return false;
  if (!node.isCullingActive()) return true;
  const osg::BoundingSphere& sphere = node.getBound();
  if (!sphere.valid()) return true;
  const osg::Vec3d centre = sphere.center();
  const double radius = sphere.radius();
  const double margin = sphereRounding * (size(centre) + radius);
  return !beyond(centre, radius + margin + _boundsMargin / std::max(_stretch, std::numeric_limits<double>::min()));
}

void BoxIntersector::intersect(osgUtil::IntersectionVisitor& visitor, osg::Drawable* drawable) {
  const roam::DefaultFloatingPoint guard;
  if (reachedLimit()) return;
  const osg::Geometry* geometry = drawable->asGeometry();
  if (geometry == nullptr || roam::osg_triangles::has_no_surface(*geometry)) return;
  const osg::BoundingBox& box = drawable->getBoundingBox();
  if (box.valid() && drawable->isCullingActive() && beyond(box)) return;
  if (isElsewhere(visitor.getNodePath())) return;
  Search(*this, visitor, *drawable).run(*geometry);
}

void BoxIntersector::reset() {
  const roam::DefaultFloatingPoint guard;
  osgUtil::Intersector::reset();
  _intersections.clear();
  _candidates.clear();
  shrinkTo(1.0);
}

BoxIntersector::Intersection BoxIntersector::getFirstIntersection() {
  const Intersections& all = getIntersections();
  return all.empty() ? Intersection() : *all.begin();
}

bool BoxIntersector::Intersection::operator<(const Intersection& other) const {
  const auto order = [](const Intersection& i) {
    return std::tie(i.time, i.distance, i.primitiveIndex, i.nodePath, i.drawable);
  };
  return order(*this) < order(other);
}

}  // namespace osgRoam
