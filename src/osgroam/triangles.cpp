#include "osgRoam/Triangles.h"

#include "osg_triangles/graph_walk.h"
#include "osg_triangles/level_of_detail.h"
#include "osg_triangles/mesh_of.h"

namespace osgRoam {
namespace {

namespace triangles = roam::osg_triangles;

class MeshCollector : public triangles::GraphWalk {
 public:
  explicit MeshCollector(const osg::Vec3d& origin) : GraphWalk(osg::Matrixd::translate(origin)) {}

  std::vector<roam::Mesh> take() { return std::move(meshes_); }

 private:
  void meet(osg::Geometry& geometry) override {
    std::uint64_t left_out = 0;
    roam::Mesh mesh = triangles::mesh_of(geometry, to_world(), left_out);
    if (mesh.triangles.empty()) return;
    mesh.name = triangles::innermost(names());
    meshes_.push_back(std::move(mesh));
  }

  void meet(osg::LOD& lod, osg::PagedLOD*) override {
    for (const unsigned i : triangles::loaded_level(lod)) lod.getChild(i)->accept(*this);
  }

  bool is_whole(osg::LOD& lod) override { return !triangles::loaded_level(lod).empty(); }

  std::vector<roam::Mesh> meshes_;
};

}  // namespace

std::vector<roam::Mesh> collectMeshes(osg::Node& node, const osg::Vec3d& origin) {
  MeshCollector collector(origin);
  node.accept(collector);
  return collector.take();
}

roam::World buildWorld(osg::Node& node, const osg::Vec3d& origin, const roam::BuildOptions& options) {
  return roam::World::build(collectMeshes(node, origin), options);
}

}  // namespace osgRoam
