#pragma once
/// \file
/// The walk through an OpenSceneGraph scene, down to its finest level, pages included.

#include <filesystem>
#include <osg/Matrixd>
#include <osg/NodeVisitor>
#include <string>
#include <vector>

#include "import/reader/mesh_sink.h"

namespace roam::reader {

/// Puts the triangles of all drawables into a sink: transforms multiplied in doubles, instances expanded, the visible
/// child of switches, the finest level of detail, pages read as they are met and freed when they are walked.
/// Billboards, text, particles, lights and head-up displays have no place in the scene's space and are left out.
class SceneGraphWalk : public osg::NodeVisitor {
 public:
  explicit SceneGraphWalk(MeshSink& sink);

  /// Walks a node that was read from `file`.
  void walk(osg::Node& root, const std::filesystem::path& file);

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

 private:
  class Entered;

  bool left_out(const osg::Node& node);
  void walk_children_shown(osg::LOD& lod, osg::PagedLOD* paged);

  MeshSink& sink_;
  osg::Matrixd to_world_;
  std::vector<std::string> names_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace roam::reader
