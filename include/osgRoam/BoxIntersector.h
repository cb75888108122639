#pragma once
/// \file
/// The customised intersector of Xie and Niu (2020, figure 5): a body moved through a scene graph as it is, without an
/// index and without any preparation.
///
///     osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector({.radius = 0.3}, from, to);
///     osgUtil::IntersectionVisitor visitor(box);
///     scene->accept(visitor);
///     if (box->containsIntersections()) stop_at(box->getFirstIntersection().time);
///
/// Nodes, drawables and triangles outside the box of the swept body are rejected; what is left goes through the
/// certified sweep of roam/sweep.h. It finds every triangle that the visitor leads it to and that the body touches: at
/// any distance from the origin and under any affine transform, mirrored, sheared and flattened ones included, for the
/// body keeps its shape in the frame that it was given in and triangles are brought there, in doubles. Taken are the
/// triangles of collectMeshes (Triangles.h). Which children of LOD and PagedLOD are visited is the visitor's business:
/// it takes the loaded ones, or reads pages where it has a read callback (IntersectionVisitor::setReadCallback).
///
/// Two things are taken on trust, because looking after them would cost what they save:
///   - Bounding spheres. They are floats, and osg::Transform computes them too small under a rotation that is scaled
///     unevenly. What is allowed for at any rate are the roundings of the node's own coordinates, as often as eight
///     nested transforms make them; setBoundsMargin is for the rest.
///   - A KdTree, where a geometry has one (osgDB::Options::BUILD_KDTREES before loading, or osg::KdTreeBuilder) and the
///     visitor uses it. It must have been built from the vertices as they are now. osg::KdTree drops primitives with
///     two equal corners, among them triangles that are written as quads; geometries where it did are scanned.
///
/// An intersector belongs to one thread at a time; several may traverse one graph at once as long as nobody changes it.

#include <osg/BoundingBox>
#include <osg/Drawable>
#include <osg/Matrixd>
#include <osg/Vec3d>
#include <osgUtil/IntersectionVisitor>
#include <set>
#include <vector>

#include "roam/mesh.h"
#include "roam/sweep.h"

namespace osgRoam {

/// How far the triangles under `node` reach beyond the bounding spheres of the nodes that they are under, metres,
/// rounded up: what BoxIntersector::setBoundsMargin needs to miss nothing. Walks the whole graph, as it is loaded.
double boundsMargin(osg::Node& node);

class BoxIntersector : public osgUtil::Intersector {
 public:
  /// Moves `body` from `start` to `end` (its centre, metres), in the frame of the visited graph. Throws roam::Error for
  /// a body or places that are not finite.
  BoxIntersector(const roam::Body& body, const osg::Vec3d& start, const osg::Vec3d& end);
  /// The same in frame MODEL or VIEW, where a capsule's axis is that frame's z. A body has no radius in WINDOW and
  /// PROJECTION: throws roam::Error.
  BoxIntersector(CoordinateFrame frame, const roam::Body& body, const osg::Vec3d& start, const osg::Vec3d& end);

  const roam::Body& getBody() const { return _body; }
  const osg::Vec3d& getStart() const { return _start; }
  const osg::Vec3d& getEnd() const { return _end; }

  /// One triangle that is met.
  struct Intersection {
    double time = 1.0;      ///< fraction of the way that is certified free of this triangle
    double distance = 0.0;  ///< see roam::SweepResult: negative for a body that starts in touch
    osg::NodePath nodePath;
    osg::ref_ptr<osg::Drawable> drawable;
    osg::ref_ptr<osg::RefMatrix> matrix;  ///< from the drawable's frame to the intersector's; null for identity
    /// Which primitive of the drawable, counted as osgUtil's intersectors do: points, lines, triangles and quads each
    /// count as one, polygons and fans as their triangles.
    unsigned int primitiveIndex = 0;
    unsigned int half = 0;  ///< of a quad: 0 or 1
    roam::Feature feature = roam::Feature::face;
    osg::Vec3d localIntersectionPoint;   ///< on the triangle, in the drawable's frame
    osg::Vec3d localIntersectionNormal;  ///< unit; the world normal brought into the drawable's frame as normals are
    osg::Vec3d worldIntersectionPoint;   ///< on the triangle, in the intersector's frame
    osg::Vec3d worldIntersectionNormal;  ///< unit, from the point towards the body's axis: the way out

    /// Earliest first; of those that are touched at the start, deepest first.
    bool operator<(const Intersection& other) const;
  };
  typedef std::multiset<Intersection> Intersections;

  /// What was met. How much of it the intersection limit says: LIMIT_NEAREST, which is set at first and the fastest,
  /// gives the earliest impact, LIMIT_ONE_PER_DRAWABLE the earliest with each drawable, LIMIT_ONE any, NO_LIMIT every
  /// triangle on the whole way as if it were alone.
  Intersections& getIntersections() { return _parent ? _parent->getIntersections() : _intersections; }
  /// The earliest; default-constructed when there is none.
  Intersection getFirstIntersection();

  /// A triangle whose box meets the box of the swept body.
  struct Candidate {
    roam::Triangle triangle;          ///< in the intersector's frame
    unsigned int drawable = 0;        ///< index into getCandidateDrawables()
    unsigned int primitiveIndex = 0;  ///< see Intersection
    unsigned int half = 0;            ///< of a quad: 0 or 1
  };
  struct CandidateDrawable {
    osg::NodePath nodePath;
    osg::ref_ptr<osg::Drawable> drawable;
  };
  /// Gather candidates instead of sweeping: there will be no intersections. For callers with a narrow phase of their
  /// own.
  void setGatherCandidates(bool gather) { _gather = gather; }
  bool getGatherCandidates() const { return _gather; }
  const std::vector<Candidate>& getCandidates() const { return _parent ? _parent->getCandidates() : _candidates; }
  const std::vector<CandidateDrawable>& getCandidateDrawables() const {
    return _parent ? _parent->getCandidateDrawables() : _candidateDrawables;
  }

  /// Metres by which bounding spheres and boxes are taken larger than they say. See boundsMargin. Throws
  /// roam::Error for a margin that is negative or not finite.
  void setBoundsMargin(double margin);
  double getBoundsMargin() const { return _boundsMargin; }

  osgUtil::Intersector* clone(osgUtil::IntersectionVisitor& visitor) override;
  bool enter(const osg::Node& node) override;
  void leave() override {}
  void intersect(osgUtil::IntersectionVisitor& visitor, osg::Drawable* drawable) override;
  void reset() override;
  bool containsIntersections() override { return !getIntersections().empty(); }

 protected:
  ~BoxIntersector() override = default;

 private:
  class Search;
  struct KdTreeSearch;

  BoxIntersector& root() { return _parent ? *_parent : *this; }
  /// The earliest impact so far, where only that is wanted: nothing later is of interest.
  void shrinkTo(double time);
  /// Whether a ball, or a box, in the frame of the drawables below is beyond the box of the swept body.
  bool beyond(const osg::Vec3d& centre, double radius);
  bool beyond(const osg::BoundingBox& box);

  BoxIntersector* _parent = nullptr;  ///< the intersector that this one was cloned for; it gets what is found
  roam::Body _body;
  osg::Vec3d _start, _end;
  bool _gather = false;
  double _boundsMargin = 0.0;
  osg::Vec3d _lower, _upper;  ///< box of the swept body

  bool _identity = true;  ///< the two matrices are
  osg::Matrixd _matrix;   ///< from the frame of the drawables below to the intersector's
  osg::Matrixd _inverse;  ///< meaningless where that has none
  bool _invertible = true;
  double _stretch = 1.0;  ///< no length in that frame becomes longer than so many times

  Intersections _intersections;
  std::vector<Candidate> _candidates;
  std::vector<CandidateDrawable> _candidateDrawables;
};

}  // namespace osgRoam
