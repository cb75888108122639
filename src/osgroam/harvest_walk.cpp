#include "harvest_walk.h"

#include <algorithm>
#include <set>

#include "math/boxes.h"
#include "osg_triangles/mesh_of.h"
#include "sphere_box.h"

namespace osgRoam {
namespace {

namespace triangles = roam::osg_triangles;

class HarvestWalk : public triangles::GraphWalk {
 public:
  HarvestWalk(const osg::Matrixd& place, const std::string& name, Harvest& harvest)
      : GraphWalk(place), name_(name), harvest_(harvest), target_(&harvest.meshes) {}

  using GraphWalk::apply;
  void apply(osg::ProxyNode& proxy) override {
    if (!inside_level_ && proxy.getLoadingExternalReferenceMode() != osg::ProxyNode::NO_AUTOMATIC_LOADING) {
      NamedFiles named{to_world(), boxOf(proxy.getBound(), to_world()), {}, {{}}, {}};
      for (unsigned i = proxy.getNumChildren(); i < proxy.getNumFileNames(); ++i) {
        if (!proxy.getFileName(i).empty()) {
          named.levels[0].push_back(proxy.getDatabasePath() + proxy.getFileName(i));
        }
      }
      if (!named.levels[0].empty()) keep(std::move(named));
    }
    GraphWalk::apply(static_cast<osg::Group&>(proxy));
  }

 private:
  void meet(osg::Geometry& geometry) override {
    roam::Mesh mesh = triangles::mesh_of(geometry, to_world(), harvest_.left_out);
    if (mesh.triangles.empty()) return;
    harvest_.triangles += mesh.triangles.size();
    mesh.name = triangles::innermost(names());
    if (mesh.name.empty()) mesh.name = name_;
    target_->push_back(std::move(mesh));
  }

  void meet(osg::LOD& lod, osg::PagedLOD* paged) override {
    // Inside a level that finer files replace, take the loaded level.
    if (paged == nullptr || inside_level_) {
      for (const unsigned i : triangles::loaded_level(lod)) lod.getChild(i)->accept(*this);
      return;
    }
    for (unsigned i = 0; i < std::min(paged->getNumChildren(), paged->getNumFileNames()); ++i) {
      if (!paged->getFileName(i).empty()) harvest_.loaded.push_back(file(*paged, i));
    }
    std::vector<triangles::Level> levels = triangles::levels(lod);
    std::erase_if(levels, [&](const triangles::Level& level) {
      return !std::all_of(level.begin(), level.end(),
                          [&](unsigned i) { return loaded(lod, i) || is_named(*paged, i); });
    });
    const auto here =
        std::find_if(levels.begin(), levels.end(), [&](const auto& level) { return loaded(lod, level.back()); });
    if (here == levels.begin()) {
      if (here != levels.end()) accept(lod, *here, {});
      return;
    }
    // Children that are in all finer levels too stay for good.
    std::set<unsigned> for_good;
    if (here != levels.end()) for_good.insert(here->begin(), here->end());
    for (auto level = levels.begin(); level != here; ++level) {
      std::erase_if(for_good, [&](unsigned i) { return !std::binary_search(level->begin(), level->end(), i); });
    }
    accept(lod, {for_good.begin(), for_good.end()}, {});
    NamedFiles named{to_world(), boxOf(lod.getBound(), to_world()), {}, {}, {}};
    if (here != levels.end()) copy(lod, *here, for_good, named.coarse);
    named.box.include(osgRoam::box_of(named.coarse));
    for (auto level = here; level != levels.begin();) {
      --level;
      add_level(*paged, *level, level == levels.begin(), named);
    }
    copy(lod, levels.front(), for_good, named.finest);
    keep(std::move(named));
  }

  void keep(NamedFiles&& named) {
    if (isFinite(named.to_scene)) {
      harvest_.named.push_back(std::move(named));
    } else {
      // Their triangles are not finite, and are left out one by one.
      for (const auto& level : named.levels)
        harvest_.nowhere.insert(harvest_.nowhere.end(), level.begin(), level.end());
    }
  }

  static bool loaded(const osg::LOD& lod, unsigned i) { return i < lod.getNumChildren(); }
  static bool is_named(const osg::PagedLOD& paged, unsigned i) {
    return i < paged.getNumFileNames() && !paged.getFileName(i).empty();
  }
  static std::string file(const osg::PagedLOD& paged, unsigned i) {
    return paged.getDatabasePath() + paged.getFileName(i);
  }

  void add_level(const osg::PagedLOD& paged, const triangles::Level& level, bool finest, NamedFiles& named) {
    std::vector<std::string> files;
    for (const unsigned i : level) {
      if (!loaded(paged, i)) files.push_back(file(paged, i));
    }
    if (finest || (files.size() == 1 && level.size() == 1)) named.levels.push_back(std::move(files));
  }

  void accept(osg::LOD& lod, const std::vector<unsigned>& children, const std::set<unsigned>& except) {
    for (const unsigned i : children) {
      if (loaded(lod, i) && !except.contains(i)) lod.getChild(i)->accept(*this);
    }
  }

  /// Copies children that exist only until files arrive, or only together with them.
  void copy(osg::LOD& lod, const std::vector<unsigned>& children, const std::set<unsigned>& except,
            std::vector<roam::Mesh>& target) {
    target_ = &target;
    inside_level_ = true;
    accept(lod, children, except);
    target_ = &harvest_.meshes;
    inside_level_ = false;
  }

  const std::string& name_;
  Harvest& harvest_;
  std::vector<roam::Mesh>* target_;
  bool inside_level_ = false;
};

}  // namespace

roam::Box box_of(const std::vector<roam::Mesh>& meshes) {
  roam::Box box;
  for (const roam::Mesh& mesh : meshes) box.include(roam::box_around(mesh.vertices));
  return box;
}

Harvest harvest(osg::Node& graph, const osg::Matrixd& place, const std::string& name) {
  Harvest result;
  HarvestWalk walk(place, name, result);
  graph.accept(walk);
  return result;
}

}  // namespace osgRoam
