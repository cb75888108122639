#pragma once
/// \file
/// A scene graph as a space to move in, asked anew with every query: for scenes that change, or that nobody wants to
/// index.
///
///     osgRoam::SceneSpace space(scene);
///     roam::Walker walker(space, {.radius = 0.3, .height = 1.8}, roam::Mode::walk, start);
///
/// What roam/space.h promises holds for the graph as it is at each query, in doubles and to 1e-5 m, with these
/// differences: queries allocate, read files where a read callback is set, and belong to one thread at a time, which
/// must not be one beside which the graph changes: ask in the viewer's update, or before frame(). And they are slow: a
/// query looks at every triangle of each geometry that it comes near, unless the geometry has a KdTree
/// (BoxIntersector.h). Where the scene stands still, osgRoam::buildWorld is a thousand times faster.
///
/// Taken are the triangles of collectMeshes (Triangles.h), at the finest level: nearest for ranges of distance, largest
/// for ranges of size on screen. A PagedLOD whose finest child is not loaded is read with the read callback; where that
/// does not help, its finest loaded child counts; where there is none, the box of its bounding sphere is unknown. So is
/// that of a ProxyNode whose file is missing. A node without a usable sphere, or under a transform that is not finite,
/// is in no place: what its file would bring is left out, as triangles are whose vertices are not finite, and
/// getUnplacedFiles tells.

#include <memory>
#include <osg/Node>
#include <osg/Vec3d>
#include <osgUtil/IntersectionVisitor>
#include <string>
#include <vector>

#include "roam/space.h"

namespace osgRoam {

class SceneSpace final : public roam::Space {
 public:
  /// The graph below `scene`, its coordinates moved by `origin` (metres): where the graph that is drawn is the scene
  /// minus an origin, pass that origin. The graph is kept alive. Measures boundsMargin (BoxIntersector.h). Throws
  /// roam::Error for a null graph.
  explicit SceneSpace(osg::Node* scene, const osg::Vec3d& origin = osg::Vec3d());
  ~SceneSpace() override;
  SceneSpace(const SceneSpace&) = delete;
  SceneSpace& operator=(const SceneSpace&) = delete;

  /// Reads pages that are not loaded: osgSim::DatabaseCacheReadCallback, for one.
  void setReadCallback(osgUtil::IntersectionVisitor::ReadCallback* callback);
  /// Use KdTrees where geometries have them; true at first. Turn it off where vertices change.
  void setUseKdTreeWhenAvailable(bool use);
  /// Metres by which bounding volumes are taken larger than they say. Set it, to boundsMargin or to what is known, when
  /// the graph gets coordinates, or uneven scales, that are larger than those that it had. Throws roam::Error for a
  /// margin that is negative or not finite.
  void setBoundsMargin(double margin);

  roam::Impact sweep(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion) const override;
  std::size_t contacts(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion, double reach,
                       std::span<roam::Contact> contacts) const override;
  using roam::Space::clearance;
  roam::Clearance clearance(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion,
                            double reach) const override;
  using roam::Space::floor_clearance;
  roam::Clearance floor_clearance(const roam::Body& body, const roam::Vec3& place, double reach,
                                  const roam::Floor& floor) const override;
  /// Of the bounding sphere of the graph; where vertices that are not finite have spoilt that, of all that is loaded or
  /// unknown, which looks at every triangle.
  roam::Box bounds() const override;
  double largest_error() const override { return 0.0; }
  /// The innermost name on the way to the triangle; of what is unknown, the file that is not loaded. Triangles are
  /// numbered by their drawables, in the order in which queries came upon them, and within those as the primitives are.
  /// A number whose drawable has gone gives "".
  std::string object_name(roam::TriangleId triangle) const override;

  /// The first 100 files that queries came upon, could not read, and found no place for.
  std::vector<std::string> getUnplacedFiles() const;

 private:
  struct State;
  std::unique_ptr<State> _state;
};

}  // namespace osgRoam
