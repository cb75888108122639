#pragma once
/// \file
/// Visitor of the surfaces in an OpenSceneGraph scene, with their transforms.

#include <cstddef>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Projection>
#include <osg/Sequence>
#include <string>
#include <vector>

namespace roam::osg_triangles {

/// Whether a node or drawable has no surface in the scene's space: text, particles, and drawables that make their
/// surface only while they are drawn.
[[nodiscard]] bool has_no_surface(const osg::Object& object);

/// Whether a node has a frame of its own, because it draws a head-up display or a texture: a camera or transform whose
/// frame does not follow that of its parent, or a projection.
[[nodiscard]] bool draws_elsewhere(const osg::Node& node);

/// The child that a sequence shows: the first if it has not started, null if it has none.
[[nodiscard]] osg::Node* shown_child(osg::Sequence& sequence);

/// Visits the geometries of a graph. Transforms are multiplied in doubles, instances expanded, and only visible
/// children of switches entered. It leaves out billboards, text, particles, lights, head-up displays, and nodes that
/// node masks hide.
class GraphWalk : public osg::NodeVisitor {
 public:
  void apply(osg::Node& node) override;
  void apply(osg::Group& group) override;
  void apply(osg::Drawable& drawable) override;
  void apply(osg::Geometry& geometry) override;
  void apply(osg::Billboard& billboard) override;
  void apply(osg::Projection& projection) override;
  void apply(osg::Transform& transform) override;
  void apply(osg::Sequence& sequence) override;
  void apply(osg::LOD& lod) override;
  void apply(osg::PagedLOD& lod) override;

 protected:
  /// Limit of nesting. A deeper graph contains itself, and would exhaust the stack.
  static constexpr std::size_t depth_limit = 2000;

  explicit GraphWalk(const osg::Matrixd& place = osg::Matrixd::identity())
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), to_world_(place) {}

  /// Called for each geometry; to_world() is its frame.
  virtual void meet(osg::Geometry& geometry) = 0;
  /// Called for each LOD node; `paged` is the same node if it is a PagedLOD. Must call accept() on the children that
  /// count.
  virtual void meet(osg::LOD& lod, osg::PagedLOD* paged) = 0;
  /// Whether the level of detail `finer` may replace its sibling `coarser`, which continues it. No if it would leave a
  /// hole.
  [[nodiscard]] virtual bool stands_for(osg::LOD& /*finer*/, const osg::LOD& /*coarser*/) { return true; }
  /// Called for a node or drawable that is left out although it may have a surface, and before meet() for a geometry
  /// with primitives of which only shaders make triangles.
  virtual void leave_out(const osg::Object&) {}
  /// Called when nodes are nested deeper than depth_limit. Throws.
  [[noreturn]] virtual void refuse_depth();

  /// The parent of the present node; null if it has none.
  [[nodiscard]] osg::Group* parent() const;
  [[nodiscard]] const osg::Matrixd& to_world() const { return to_world_; }
  /// Names of the nodes from the root to the present node, outermost first.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  class Entered;
  void take(osg::LOD& lod, osg::PagedLOD* paged);
  [[nodiscard]] bool is_replaced(const osg::LOD& lod, osg::Group& parent);

  osg::Matrixd to_world_;
  std::vector<std::string> names_;
};

}  // namespace roam::osg_triangles
