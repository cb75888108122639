#pragma once
/// \file
/// Visitor of an OpenSceneGraph scene at its finest level of detail, pages included.

#include <filesystem>
#include <vector>

#include "import/reader/mesh_sink.h"
#include "osg_triangles/graph_walk.h"

namespace roam::reader {

/// Adds the triangles of a scene to a sink, at the finest level of detail. Pages are read when they are visited and
/// freed afterwards.
class SceneGraphWalk : public osg_triangles::GraphWalk {
 public:
  explicit SceneGraphWalk(MeshSink& sink);

  /// Walks a node that was read from `file`.
  void walk(osg::Node& root, const std::filesystem::path& file);

 protected:
  void meet(osg::LOD& lod, osg::PagedLOD* paged) override;
  [[nodiscard]] bool is_whole(osg::LOD& lod) override;
  /// The file of page `i`.
  [[nodiscard]] std::filesystem::path page_file(const osg::PagedLOD& lod, unsigned i) const;

 private:
  void meet(osg::Geometry& geometry) override;
  void leave_out(const osg::Object& object) override;
  [[noreturn]] void refuse_depth() override;

  /// A child of a level of detail, and the file that it was read from; empty if that is the parent's file.
  struct Child {
    osg::ref_ptr<osg::Node> node;
    std::filesystem::path file;
  };
  /// The level to show, and whether no file of it is missing.
  struct Found {
    std::vector<Child> children;
    bool whole = false;
  };
  /// Finds the finest level that is whole, otherwise the finest of which all pages can be read. Quietly: without
  /// reporting anything.
  [[nodiscard]] Found find_level(osg::LOD& lod, osg::PagedLOD* paged, bool quietly);
  [[nodiscard]] Child child(osg::LOD& lod, osg::PagedLOD* paged, unsigned i, bool quietly);
  void show(std::vector<Child>& children);

  MeshSink& sink_;
  std::vector<std::filesystem::path> files_;
};

}  // namespace roam::reader
