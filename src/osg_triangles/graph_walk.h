#pragma once
/// \file
/// Visitor of the surfaces in an OpenSceneGraph scene, with their transforms.

#include <cstddef>
#include <optional>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Projection>
#include <osg/Sequence>
#include <string>
#include <vector>

#include "osg_triangles/level_of_detail.h"

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
  /// Whether a level of detail, the present node or a sibling of it, would leave no hole.
  [[nodiscard]] virtual bool is_whole(osg::LOD&) { return true; }
  /// Whether finer siblings replace the present node, so that it is not met.
  [[nodiscard]] virtual bool is_replaced(const osg::LOD& lod);
  /// Whether coarser siblings replace the present node, because it is not whole.
  [[nodiscard]] bool gives_way(const osg::LOD& lod);
  /// Called for a node or drawable that is left out although it may have a surface, and before meet() for a geometry
  /// with primitives of which only shaders make triangles.
  virtual void leave_out(const osg::Object&) {}
  /// Called when nodes are nested deeper than depth_limit. Throws.
  [[noreturn]] virtual void refuse_depth();

  [[nodiscard]] const osg::Matrixd& to_world() const { return to_world_; }
  /// Names of the nodes from the root to the present node, outermost first.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  class Entered;
  void take(osg::LOD& lod, osg::PagedLOD* paged);
  [[nodiscard]] const SiblingLevels* siblings();

  osg::Matrixd to_world_;
  std::vector<std::string> names_;
  /// For each of these nodes, what replaces what among its children; empty until the first of them is met.
  std::vector<std::optional<SiblingLevels>> levels_below_;
};

}  // namespace roam::osg_triangles
