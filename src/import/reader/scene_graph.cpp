#include "import/reader/scene_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <osg/ProxyNode>
#include <set>
#include <utility>

#include "import/reader/osg_files.h"
#include "import/reader/osg_geometry.h"
#include "osg_triangles/level_of_detail.h"
#include "roam/error.h"

namespace roam::reader {

namespace fs = std::filesystem;

namespace {

/// Finds proxies without their files. Levels of detail below replace theirs themselves.
class FindMissingFiles : public osg_triangles::GraphWalk {
 public:
  using GraphWalk::apply;
  void apply(osg::ProxyNode& proxy) override {
    unsigned named = 0;
    for (unsigned i = 0; i < proxy.getNumFileNames(); ++i) named += proxy.getFileName(i).empty() ? 0 : 1;
    const bool automatic = proxy.getLoadingExternalReferenceMode() != osg::ProxyNode::NO_AUTOMATIC_LOADING;
    found_ = found_ || (automatic && named > proxy.getNumChildren());
    if (!found_) GraphWalk::apply(static_cast<osg::Group&>(proxy));
  }
  void apply(osg::LOD&) override {}
  void apply(osg::PagedLOD&) override {}
  [[nodiscard]] bool found() const { return found_; }

 private:
  void meet(osg::Geometry&) override {}
  void meet(osg::LOD&, osg::PagedLOD*) override {}

  bool found_ = false;
};

bool misses_files(osg::Node& node) {
  FindMissingFiles find;
  node.accept(find);
  return find.found();
}

bool is_named(const osg::PagedLOD* paged, unsigned i) {
  return paged != nullptr && i < paged->getNumFileNames() && !paged->getFileName(i).empty();
}

}  // namespace

SceneGraphWalk::SceneGraphWalk(MeshSink& sink) : sink_(sink) {}

void SceneGraphWalk::walk(osg::Node& root, const fs::path& file) {
  files_.push_back(file);
  root.accept(*this);
  files_.pop_back();
}

void SceneGraphWalk::refuse_depth() {
  throw Error(files_.back().string(),
              fmt::format("its nodes are nested more than {} deep; the file is damaged.", depth_limit));
}

void SceneGraphWalk::leave_out(const osg::Object& object) {
  const osg::Node* const node = object.asNode();
  const char* sentence = "{}: drawables of kind {}::{} hold no triangles that can be read; they are left out.";
  if (node != nullptr && node->asGroup() != nullptr) {
    sentence = "{}: nodes of kind {}::{} make their surface while they are drawn; they are not read.";
  } else if (node != nullptr && node->asGeometry() != nullptr && !osg_triangles::has_no_surface(object)) {
    sentence =
        "{}: patches, and triangles with neighbours, in an {}::{} get their surface from shaders; they are left out.";
  }
  sink_.report_note_once(
      fmt::format(fmt::runtime(sentence), files_.back().string(), object.libraryName(), object.className()));
}

void SceneGraphWalk::meet(osg::Geometry& geometry) {
  sink_.begin_object(names(), files_.back().stem().string());
  if (sink_.parts() == nullptr) return add_geometry(geometry, to_world(), nullptr, sink_);
  const OsgLooks looks(geometry, getNodePath(), to_world(), sink_.parts()->textures());
  sink_.set_look(looks.look());
  add_geometry(geometry, to_world(), &looks, sink_);
}

fs::path SceneGraphWalk::page_file(const osg::PagedLOD& lod, unsigned i) const {
  const fs::path named_from =
      lod.getDatabasePath().empty() ? files_.back().parent_path() : fs::path(lod.getDatabasePath());
  // Normal form, so that circles are recognised by name.
  return (named_from / lod.getFileName(i)).lexically_normal();
}

SceneGraphWalk::Child SceneGraphWalk::child(osg::LOD& lod, osg::PagedLOD* paged, unsigned i) {
  if (i < lod.getNumChildren()) return {lod.getChild(i), {}};
  if (!is_named(paged, i)) return {};
  const fs::path file = page_file(*paged, i);
  if (is_open(file)) {
    sink_.report_missing_page(file.string());
    return {};
  }
  return {read_osg_file(file, false), file};
}

bool SceneGraphWalk::is_open(const fs::path& file) const {
  return std::find(files_.begin(), files_.end(), file) != files_.end();
}

void SceneGraphWalk::meet(osg::LOD& lod, osg::PagedLOD* paged) {
  std::set<unsigned> absent;
  std::vector<Child> finest;
  for (const osg_triangles::Level& level : osg_triangles::levels(lod)) {
    std::vector<Child> children;
    for (const unsigned i : level) {
      if (absent.contains(i)) continue;
      children.push_back(child(lod, paged, i));
      if (children.back().node != nullptr) continue;
      absent.insert(i);
      children.pop_back();
    }
    // An incomplete level would leave holes. The next coarser level replaces all of it.
    if (children.size() < level.size()) continue;
    const bool whole =
        std::none_of(children.begin(), children.end(), [](const Child& one) { return misses_files(*one.node); });
    if (whole) return show(children);
    if (finest.empty()) finest = std::move(children);
  }
  // If no level is whole, the finest has most, unless a sibling is a coarser level.
  const osg::Group* const above = parent();
  for (unsigned i = 0; above != nullptr && i < above->getNumChildren(); ++i) {
    const auto* const sibling = dynamic_cast<const osg::LOD*>(above->getChild(i));
    if (sibling != nullptr && osg_triangles::continues(*sibling, lod)) return;
  }
  show(finest);
}

void SceneGraphWalk::show(std::vector<Child>& children) {
  for (Child& shown : children) {
    if (shown.file.empty()) {
      shown.node->accept(*this);
    } else {
      walk(*shown.node, shown.file);
    }
    shown.node = nullptr;
  }
}

bool SceneGraphWalk::stands_for(osg::LOD& finer, const osg::LOD&) {
  const auto* const paged = dynamic_cast<const osg::PagedLOD*>(&finer);
  const auto is_there = [&](unsigned i) {
    if (i < finer.getNumChildren()) return !misses_files(*finer.getChild(i));
    return is_named(paged, i) && !is_open(page_file(*paged, i)) && is_osg_file(page_file(*paged, i));
  };
  const std::vector<osg_triangles::Level> levels = osg_triangles::levels(finer);
  return std::any_of(levels.begin(), levels.end(), [&](const osg_triangles::Level& level) {
    return std::all_of(level.begin(), level.end(), is_there);
  });
}

}  // namespace roam::reader
