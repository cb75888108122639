#include "scene_visitor.h"

#include <map>
#include <osg/Camera>
#include <osg/PagedLOD>
#include <osg/ProxyNode>
#include <osg/Sequence>

#include "osg_triangles/graph_walk.h"
#include "osg_triangles/level_of_detail.h"
#include "sphere_box.h"

namespace osgRoam {

namespace triangles = roam::osg_triangles;

void SceneVisitor::apply(osg::Camera& camera) {
  if (!triangles::draws_elsewhere(camera)) apply(static_cast<osg::Transform&>(camera));
}

void SceneVisitor::apply(osg::Sequence& sequence) {
  if (!enter(sequence)) return;
  if (osg::Node* child = triangles::shown_child(sequence)) child->accept(*this);
  leave();
}

bool SceneVisitor::continues_a_sibling(const osg::LOD& lod) const {
  const auto& path = getNodePath();
  const osg::Group* parent = path.size() > 1 ? path[path.size() - 2]->asGroup() : nullptr;
  return parent != nullptr && triangles::continues_a_finer_sibling(lod, *parent);
}

void SceneVisitor::apply(osg::LOD& lod) {
  if (continues_a_sibling(lod) || !enter(lod)) return;
  for (const unsigned i : triangles::loaded_level(lod, true)) lod.getChild(i)->accept(*this);
  leave();
}

osg::ref_ptr<osg::Node> SceneVisitor::read(const std::string& file) {
  return getReadCallback() == nullptr ? nullptr : getReadCallback()->readNodeFile(file);
}

void SceneVisitor::apply(osg::PagedLOD& lod) {
  if (continues_a_sibling(lod) || !enter(lod)) return;
  std::string missing;
  bool shown = false;
  std::map<unsigned, osg::ref_ptr<osg::Node>> pages;  // also those that cannot be read
  const auto child = [&](unsigned i) -> osg::ref_ptr<osg::Node> {
    if (i < lod.getNumChildren()) return lod.getChild(i);
    if (i >= lod.getNumFileNames() || lod.getFileName(i).empty()) return nullptr;
    const std::string file = lod.getDatabasePath() + lod.getFileName(i);
    const auto [page, is_new] = pages.try_emplace(i);
    if (is_new) page->second = read(file);
    if (page->second == nullptr && missing.empty()) missing = file;
    return page->second;
  };
  // A level that is not whole would leave holes: the next coarser one stands in for all of it.
  for (const triangles::Level& level : triangles::levels(lod)) {
    std::vector<osg::ref_ptr<osg::Node>> children;
    for (const unsigned i : level) {
      if (const auto node = child(i)) children.push_back(node);
    }
    if (children.size() != level.size()) continue;
    for (const auto& node : children) node->accept(*this);
    shown = true;
    break;
  }
  if (!shown && !missing.empty()) add_unknown(lod, missing);
  leave();
}

void SceneVisitor::apply(osg::ProxyNode& proxy) {
  if (!enter(proxy)) return;
  for (unsigned i = 0; i < proxy.getNumChildren(); ++i) proxy.getChild(i)->accept(*this);
  for (unsigned i = proxy.getNumChildren(); i < proxy.getNumFileNames(); ++i) {
    if (proxy.getFileName(i).empty()) continue;
    const std::string file = proxy.getDatabasePath() + proxy.getFileName(i);
    if (osg::ref_ptr<osg::Node> page = read(file)) {
      page->accept(*this);
    } else {
      add_unknown(proxy, file);
    }
  }
  leave();
}

void SceneVisitor::add_unknown(const osg::Node& node, const std::string& file) {
  const osg::Matrixd matrix = getModelMatrix() == nullptr ? osg::Matrixd() : *getModelMatrix();
  const roam::Box box = boxOf(node.getBound(), matrix);
  if (box.empty()) {
    unplaced_.push_back(file);
    return;
  }
  unknown_.push_back({box, getNodePath(), file});
}

}  // namespace osgRoam
