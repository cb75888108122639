#include <algorithm>
#include <cmath>
#include <osg/Billboard>
#include <osg/Geometry>
#include <osg/NodeVisitor>
#include <osg/Transform>
#include <vector>

#include "affine.h"
#include "osgRoam/BoxIntersector.h"
#include "osg_triangles/graph_walk.h"
#include "osg_triangles/primitives.h"

namespace osgRoam {
namespace {

/// A node above the visit whose sphere BoxIntersector tests.
struct Bounded {
  osg::Vec3d centre;
  double radius;
  osg::Matrixd to_bounded;  ///< from the present frame to that of the sphere
  double stretch;           ///< greatest stretch from the sphere's frame to that of the graph
};

/// Keeps the greatest distance by which a vertex in a triangle lies outside of the spheres above it.
class Farthest {
 public:
  explicit Farthest(const std::vector<Bounded>& above) : above_(above) {}

  template <class Vertex>
  void begin(const Vertex* vertices, std::size_t count) {
    vertices_ = roam::osg_triangles::Vertices(count, vertices);
    seen_.assign(vertices_.size(), false);
  }
  void triangle(const roam::osg_triangles::Corners& t) {
    for (const std::uint64_t i : {t.a, t.b, t.c}) {
      if (i >= seen_.size() || seen_[i]) continue;
      seen_[i] = true;
      measure(vertices_[i]);
    }
  }
  double excess = 0.0;  ///< metres

 private:
  void measure(const osg::Vec3d& vertex) {
    for (const Bounded& node : above_) {
      const double d = ((vertex * node.to_bounded - node.centre).length() - node.radius) * node.stretch;
      if (d > excess && std::isfinite(d)) excess = d;
    }
  }

  const std::vector<Bounded>& above_;
  roam::osg_triangles::Vertices vertices_;
  std::vector<bool> seen_;
};

class MarginVisitor : public osg::NodeVisitor {
 public:
  MarginVisitor() : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN) {}

  void apply(osg::Node& node) override {
    const std::size_t depth = above_.size();
    include(node);
    traverse(node);
    above_.resize(depth);
  }
  void apply(osg::Transform& transform) override {
    // BoxIntersector passes these, but may begin at one.
    if (getNodePath().size() > 1 && roam::osg_triangles::draws_elsewhere(transform)) return;
    const std::vector<Bounded> above = above_;
    const osg::Matrixd to_graph = to_graph_;
    include(transform);
    osg::Matrixd own;
    transform.computeLocalToWorldMatrix(own, this);
    transform.computeLocalToWorldMatrix(to_graph_, this);
    for (Bounded& node : above_) node.to_bounded.preMult(own);
    traverse(transform);
    above_ = above;
    to_graph_ = to_graph;
  }
  void apply(osg::Billboard&) override {}
  void apply(osg::Geometry& geometry) override {
    Farthest farthest(above_);
    roam::osg_triangles::Primitives<Farthest> primitives(farthest);
    primitives.run(geometry);
    excess_ = std::max(excess_, farthest.excess);
  }

  [[nodiscard]] double excess() const { return excess_; }

 private:
  void include(const osg::Node& node) {
    if (!node.isCullingActive() || !node.getBound().valid()) return;
    const osg::BoundingSphere& sphere = node.getBound();
    above_.push_back({sphere.center(), sphere.radius(), osg::Matrixd::identity(), greatestStretch(to_graph_)});
  }

  std::vector<Bounded> above_;
  osg::Matrixd to_graph_;
  double excess_ = 0.0;
};

}  // namespace

double boundsMargin(osg::Node& node) {
  MarginVisitor visitor;
  node.accept(visitor);
  // Relative error of distances in doubles, which may be far from the origin.
  constexpr double rounding = 1e-9;
  const osg::BoundingSphere& all = node.getBound();
  const double coordinates = osg::Vec3d(all.center()).length() + all.radius();
  // A sphere that is not finite rejects nothing.
  const bool bounds = all.valid() && std::isfinite(coordinates);
  return visitor.excess() * (1.0 + rounding) + (bounds ? rounding * coordinates : 0.0);
}

}  // namespace osgRoam
