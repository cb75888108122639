// The paper's method and the polytope in OpenSceneGraph, and the files for its rows.

#include <glm/geometric.hpp>
#include <map>
#include <memory>
#include <osg/Geode>
#include <osg/Geometry>
#include <osg/KdTree>
#include <osg/PagedLOD>
#include <osgDB/DatabasePager>
#include <osgDB/ReadFile>
#include <osgDB/WriteFile>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/PolytopeIntersector>

#include "osgRoam/BoxIntersector.h"
#include "osg_scene.h"
#include "paper_equations.h"
#include "paper_movers.h"
#include "roam/error.h"

namespace roam::bench {
namespace {

std::string tile_name(std::size_t i) { return std::to_string(i) + ".osgb"; }

/// Reads pages when an intersection meets them, and keeps them, like osgSim::DatabaseCacheReadCallback.
class ReadOnce : public osgUtil::IntersectionVisitor::ReadCallback {
 public:
  osg::ref_ptr<osg::Node> readNodeFile(const std::string& name) override {
    osg::ref_ptr<osg::Node>& node = nodes_[name];
    if (!node) node = osgDB::readRefNodeFile(name);
    return node;
  }

 private:
  std::map<std::string, osg::ref_ptr<osg::Node>> nodes_;
};

osg::ref_ptr<osg::Node> read(const std::string& file) {
  osg::ref_ptr<osg::Node> node = osgDB::readRefNodeFile(file);
  if (!node) throw Error("OpenSceneGraph cannot read " + file + ", which this command has written");
  return node;
}

/// A graph with the settings for visiting it.
struct Scenery {
  osg::ref_ptr<osg::Node> node;
  osg::ref_ptr<osgUtil::IntersectionVisitor::ReadCallback> pages;
  bool kd_trees = false;

  void visit(osgUtil::Intersector& intersector) const {
    osgUtil::IntersectionVisitor visitor(&intersector, pages.get());
    visitor.setUseKdTreeWhenAvailable(kd_trees);
    node->accept(visitor);
  }
};

std::shared_ptr<Scenery> load(const PaperScene& scene, Graph graph) {
  const auto scenery = std::make_shared<Scenery>();
  if (graph == Graph::paged) {
    scenery->node = read(scene.tiles + "/paged.osgb");
    scenery->pages = new ReadOnce;
    return scenery;
  }
  osg::ref_ptr<osg::Group> group = new osg::Group;
  for (std::size_t i = 0; i < scene.tile_count; ++i) group->addChild(read(scene.tiles + "/" + tile_name(i)));
  if (graph == Graph::with_kd_trees) {
    osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
    group->accept(*builder);
    scenery->kd_trees = true;
  }
  group->getBound();  // computed on first use, so that no step pays for it
  scenery->node = group;
  return scenery;
}

}  // namespace

struct TileWriter::State {
  std::string folder;
  std::size_t count = 0;
  osg::ref_ptr<osg::Group> paged = new osg::Group;
};

TileWriter::TileWriter(std::string folder) : state_(new State{std::move(folder), 0, new osg::Group}) {}
TileWriter::~TileWriter() { delete state_; }

void TileWriter::add(const Mesh& mesh) {
  const osg::ref_ptr<osg::Geode> geode = to_geode(mesh, paper_shift);
  const std::string name = tile_name(state_->count++);
  if (!osgDB::writeNodeFile(*geode, state_->folder + "/" + name)) {
    throw Error("cannot write " + state_->folder + "/" + name + "; check the free space");
  }
  osg::ref_ptr<osg::PagedLOD> page = new osg::PagedLOD;
  page->setCenter(geode->getBound().center());
  page->setRadius(geode->getBound().radius());
  page->setFileName(0, name);
  page->setRange(0, 0.0F, 1e10F);
  state_->paged->addChild(page);
}

void TileWriter::finish() {
  if (!osgDB::writeNodeFile(*state_->paged, state_->folder + "/paged.osgb")) {
    throw Error("cannot write " + state_->folder + "/paged.osgb; check the free space");
  }
}

Mover paper_method(const PaperScene& scene, Graph graph) {
  const auto scenery = load(scene, graph);
  return collide_and_slide(
      [scenery](double radius, const Vec3& from, const Vec3& motion) {
        osg::ref_ptr<osgRoam::BoxIntersector> box =
            new osgRoam::BoxIntersector({.radius = radius}, to_osg(from), to_osg(from + motion));
        box->setGatherCandidates(true);
        scenery->visit(*box);
        std::optional<Touch> first;
        for (const Triangle& candidate : box->getCandidates()) {
          const auto collision = paper::collide(radius, from, motion, candidate);
          if (!collision || (first && collision->time >= first->time)) continue;
          const Vec3 out = from + collision->time * motion - collision->point;
          const double length = glm::length(out);
          first = Touch{collision->time, length > 0.0 ? out / length : Vec3(0.0)};
        }
        return first;
      },
      paper_shift);
}

Mover polytope_method(const PaperScene& scene, Graph graph) {
  const auto scenery = load(scene, graph);
  return go_or_stay(
      [scenery](double radius, const Vec3& from, const Vec3& motion) {
        osg::ref_ptr<osgUtil::PolytopeIntersector> intersector = new osgUtil::PolytopeIntersector(
            osgUtil::Intersector::MODEL, box_of_sweep(Vec3(radius), from, from + motion));
        intersector->setPrimitiveMask(osgUtil::PolytopeIntersector::TRIANGLE_PRIMITIVES);
        intersector->setIntersectionLimit(osgUtil::Intersector::LIMIT_ONE);
        scenery->visit(*intersector);
        return intersector->containsIntersections();
      },
      paper_shift);
}

void read_tiles(const PaperScene& scene, const std::function<void(FloatMesh tile)>& take) {
  for (std::size_t i = 0; i < scene.tile_count; ++i) {
    const osg::ref_ptr<osg::Node> node = read(scene.tiles + "/" + tile_name(i));
    const auto* geometry = node->asGeode()->getDrawable(0)->asGeometry();
    FloatMesh tile;
    for (const osg::Vec3& v : *static_cast<const osg::Vec3Array*>(geometry->getVertexArray())) {
      tile.vertices.insert(tile.vertices.end(), {v.x(), v.y(), v.z()});
    }
    const auto* triangles = static_cast<const osg::DrawElementsUInt*>(geometry->getPrimitiveSet(0));
    tile.indices.assign(triangles->begin(), triangles->end());
    take(std::move(tile));
  }
}

}  // namespace roam::bench
