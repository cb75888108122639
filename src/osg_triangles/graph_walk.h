#pragma once
/// \file
/// The walk through an OpenSceneGraph scene: what of it has a surface, and where that lies.

#include <cstddef>
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <osg/PagedLOD>
#include <osg/Sequence>
#include <string>
#include <vector>

namespace roam::osg_triangles {

/// Whether a node or drawable has no place in the scene's space: text, particles, and what makes its surface only while
/// it is drawn.
[[nodiscard]] bool has_no_surface(const osg::Object& object);

/// Whether a camera has a frame of its own: it draws a head-up display or a texture.
[[nodiscard]] bool draws_elsewhere(const osg::Camera& camera);

/// The child that a sequence shows; the first of one that has not started. Null when it has none.
[[nodiscard]] osg::Node* shown_child(osg::Sequence& sequence);

/// Meets the geometries of a graph: transforms multiplied in doubles, instances expanded, the visible child of
/// switches. Left out are billboards, text, particles, lights, head-up displays, and what node masks hide.
class GraphWalk : public osg::NodeVisitor {
 public:
  void apply(osg::Node& node) override;
  void apply(osg::Group& group) override;
  void apply(osg::Drawable& drawable) override;
  void apply(osg::Geometry& geometry) override;
  void apply(osg::Billboard& billboard) override;
  void apply(osg::Camera& camera) override;
  void apply(osg::Transform& transform) override;
  void apply(osg::Sequence& sequence) override;
  void apply(osg::LOD& lod) override;
  void apply(osg::PagedLOD& lod) override;

 protected:
  /// Nodes inside nodes; more is a graph that contains itself, and would exhaust the stack.
  static constexpr std::size_t depth_limit = 2000;

  explicit GraphWalk(const osg::Matrixd& place = osg::Matrixd::identity())
      : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), to_world_(place) {}

  /// A geometry in the frame to_world().
  virtual void meet(osg::Geometry& geometry) = 0;
  /// A LOD node; `paged` is the same node when it is a PagedLOD. Calls accept() of the children that count.
  virtual void meet(osg::LOD& lod, osg::PagedLOD* paged) = 0;
  /// Whether a finer sibling stands for the level of detail that continues it.
  [[nodiscard]] virtual bool stands_for(const osg::LOD&) const { return true; }
  /// A node or drawable that is left out though it may have a surface.
  virtual void leave_out(const osg::Object&) {}
  /// Nodes are nested more than depth_limit deep. Throws.
  [[noreturn]] virtual void refuse_depth();

  [[nodiscard]] const osg::Matrixd& to_world() const { return to_world_; }
  /// Of the nodes that the walk is in, outermost first.
  [[nodiscard]] const std::vector<std::string>& names() const { return names_; }

 private:
  class Entered;

  osg::Matrixd to_world_;
  std::vector<std::string> names_;
};

}  // namespace roam::osg_triangles
