#pragma once
/// \file
/// Box intersector: sweeps a body through a scene graph without an index (Xie and Niu 2020, figure 5).
///
///     osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector({.radius = 0.3}, from, to);
///     osgUtil::IntersectionVisitor visitor(box);
///     scene->accept(visitor);
///     if (box->containsIntersections()) stop_at(box->getFirstIntersection().time);
///
/// Nodes, drawables and triangles outside of the box of the swept body are rejected; the rest goes through the
/// certified sweep of roam/sweep.h. The body keeps its shape in its own frame: triangles are transformed there in
/// doubles, so any affine transform is right. The triangles are those of collectMeshes (Triangles.h). The visitor
/// chooses children of LOD and PagedLOD, and reads pages if it has a read callback.
///
/// It relies on two things that it cannot check cheaply:
///   - Bounding spheres hold their triangles. osg::Transform computes them too small under an uneven scale with a
///     rotation: see setBoundsMargin. Rounding of eight nested transforms is allowed for.
///   - A KdTree that the visitor uses was built from the present vertices. Geometries with triangles that osg::KdTree
///     drops (two equal corners) are scanned.
///
/// For one thread at a time; several intersectors may traverse one graph that does not change.

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

/// The metres by which triangles under `node` reach beyond the bounding spheres above them, for setBoundsMargin. Visits
/// the whole loaded graph.
double boundsMargin(osg::Node& node);

class BoxIntersector : public osgUtil::Intersector {
 public:
  /// Moves the centre of `body` from `start` to `end`, metres, in the frame of the visited graph. Throws roam::Error if
  /// they are not finite.
  BoxIntersector(const roam::Body& body, const osg::Vec3d& start, const osg::Vec3d& end);
  /// As above, in frame MODEL or VIEW; a capsule's axis is the z of that frame. Throws roam::Error for other frames.
  BoxIntersector(CoordinateFrame frame, const roam::Body& body, const osg::Vec3d& start, const osg::Vec3d& end);

  const roam::Body& getBody() const { return _body; }
  const osg::Vec3d& getStart() const { return _start; }
  const osg::Vec3d& getEnd() const { return _end; }

  /// A triangle that the body meets.
  struct Intersection {
    double time = 1.0;      ///< fraction of the motion that is certified free of it
    double distance = 0.0;  ///< see roam::SweepResult; negative if they overlap at the start
    osg::NodePath nodePath;
    osg::ref_ptr<osg::Drawable> drawable;
    osg::ref_ptr<osg::RefMatrix> matrix;  ///< from the drawable's frame to the intersector's; null for identity
    /// Number of the primitive, counted as osgUtil's intersectors do: polygons and fans count as their triangles.
    unsigned int primitiveIndex = 0;
    unsigned int half = 0;  ///< of a quad: 0 or 1
    roam::Feature feature = roam::Feature::face;
    osg::Vec3d localIntersectionPoint;   ///< on the triangle, in the drawable's frame
    osg::Vec3d localIntersectionNormal;  ///< unit, in the drawable's frame
    osg::Vec3d worldIntersectionPoint;   ///< on the triangle, in the intersector's frame
    osg::Vec3d worldIntersectionNormal;  ///< unit, from the point towards the body's axis

    /// Earliest first; among overlaps at the start, deepest first.
    bool operator<(const Intersection& other) const;
  };
  typedef std::multiset<Intersection> Intersections;

  /// Intersections by the intersection limit: LIMIT_NEAREST (default, fastest) the earliest, LIMIT_ONE_PER_DRAWABLE the
  /// earliest of each drawable, LIMIT_ONE any, NO_LIMIT each triangle on the whole motion.
  Intersections& getIntersections() { return _parent ? _parent->getIntersections() : _intersections; }
  /// The earliest; default-constructed if there is none.
  Intersection getFirstIntersection();

  /// Collects candidates instead of intersections, for a narrow phase of your own: the triangles whose box overlaps the
  /// box of the swept body, in the intersector's frame.
  void setGatherCandidates(bool gather) { _gather = gather; }
  bool getGatherCandidates() const { return _gather; }
  const std::vector<roam::Triangle>& getCandidates() const { return _parent ? _parent->getCandidates() : _candidates; }

  /// Metres by which bounding spheres and boxes are enlarged; see boundsMargin. Throws roam::Error if negative or not
  /// finite.
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
  /// The time of the earliest impact so far, if only that is wanted: later ones are dropped.
  void shrinkTo(double time);
  /// Whether a ball, or a box, in the frame of the drawables below is beyond the box of the swept body.
  bool beyond(const osg::Vec3d& centre, double radius);
  bool beyond(const osg::BoundingBox& box);

  BoxIntersector* _parent = nullptr;  ///< the intersector that this one was cloned for; it gets the results
  roam::Body _body;
  osg::Vec3d _start, _end;
  bool _gather = false;
  double _boundsMargin = 0.0;
  osg::Vec3d _lower, _upper;  ///< box of the swept body

  bool _identity = true;  ///< the two matrices are
  osg::Matrixd _matrix;   ///< from the frame of the drawables below to the intersector's
  osg::Matrixd _inverse;  ///< meaningless if that has none
  bool _invertible = true;
  double _stretch = 1.0;  ///< factor by which a length in that frame grows at most

  Intersections _intersections;
  std::vector<roam::Triangle> _candidates;
};

}  // namespace osgRoam
