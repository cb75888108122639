#pragma once
/// \file
/// The walk through an OpenSceneGraph scene, down to its finest level, pages included.

#include <filesystem>
#include <vector>

#include "import/reader/mesh_sink.h"
#include "osg_triangles/graph_walk.h"

namespace roam::reader {

/// Puts the triangles that the walk meets into a sink: at the finest level of detail, pages read as they are met and
/// freed when they are walked.
class SceneGraphWalk : public osg_triangles::GraphWalk {
 public:
  explicit SceneGraphWalk(MeshSink& sink);

  /// Walks a node that was read from `file`.
  void walk(osg::Node& root, const std::filesystem::path& file);

 protected:
  void meet(osg::LOD& lod, osg::PagedLOD* paged) override;
  /// The file that a page is in.
  [[nodiscard]] std::filesystem::path page_file(const osg::PagedLOD& lod, unsigned i) const;

 private:
  void meet(osg::Geometry& geometry) override;
  void leave_out(const osg::Object& object) override;
  [[noreturn]] void refuse_depth() override;

  /// A child of a level of detail, and the file that it was read from; that is empty for one in the same file.
  struct Child {
    osg::ref_ptr<osg::Node> node;
    std::filesystem::path file;
  };
  [[nodiscard]] Child child(osg::LOD& lod, osg::PagedLOD* paged, unsigned i);

  MeshSink& sink_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace roam::reader
