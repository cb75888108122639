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

SceneGraphWalk::Child SceneGraphWalk::child(osg::LOD& lod, osg::PagedLOD* paged, unsigned i, bool quietly) {
  if (i < lod.getNumChildren()) return {lod.getChild(i), {}};
  const bool named = paged != nullptr && i < paged->getNumFileNames() && !paged->getFileName(i).empty();
  if (!named) return {};
  const fs::path file = page_file(*paged, i);
  if (std::find(files_.begin(), files_.end(), file) != files_.end()) {
    if (!quietly) sink_.report_missing_page(file.string());
    return {};
  }
  return {quietly ? read_osg_file_quietly(file) : read_osg_file(file, false), file};
}

SceneGraphWalk::Found SceneGraphWalk::find_level(osg::LOD& lod, osg::PagedLOD* paged, bool quietly) {
  std::set<unsigned> absent;
  std::vector<Child> finest;
  for (const osg_triangles::Level& level : osg_triangles::levels(lod)) {
    std::vector<Child> children;
    for (const unsigned i : level) {
      if (absent.contains(i)) continue;
      children.push_back(child(lod, paged, i, quietly));
      if (children.back().node != nullptr) continue;
      absent.insert(i);
      children.pop_back();
    }
    // An incomplete level would leave holes. The next coarser level replaces all of it.
    if (children.size() < level.size()) continue;
    const bool whole =
        std::none_of(children.begin(), children.end(), [](const Child& one) { return misses_files(*one.node); });
    if (whole) return {std::move(children), true};
    if (finest.empty()) finest = std::move(children);
  }
  return {std::move(finest), false};
}

void SceneGraphWalk::meet(osg::LOD& lod, osg::PagedLOD* paged) {
  Found found = find_level(lod, paged, false);
  // If no level is whole, the finest has most, unless a sibling is a coarser level.
  if (found.whole || !gives_way(lod)) show(found.children);
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

bool SceneGraphWalk::is_whole(osg::LOD& lod) { return find_level(lod, dynamic_cast<osg::PagedLOD*>(&lod), true).whole; }

}  // namespace roam::reader
