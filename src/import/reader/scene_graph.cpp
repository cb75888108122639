#include "import/reader/scene_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <set>
#include <utility>

#include "import/reader/osg_files.h"
#include "import/reader/osg_geometry.h"
#include "osg_triangles/level_of_detail.h"
#include "roam/error.h"

namespace roam::reader {

namespace fs = std::filesystem;

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
  const char* sentence = object.asNode() != nullptr && object.asNode()->asGroup() != nullptr
                             ? "{}: nodes of kind {}::{} make their surface while they are drawn; they are not read."
                             : "{}: drawables of kind {}::{} hold no triangles that can be read; they are left out.";
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
  const bool named = paged != nullptr && i < paged->getNumFileNames() && !paged->getFileName(i).empty();
  if (!named) return {};
  const fs::path file = page_file(*paged, i);
  if (std::find(files_.begin(), files_.end(), file) != files_.end()) {
    sink_.report_missing_page(file.string());
    return {};
  }
  return {read_osg_file(file, false), file};
}

void SceneGraphWalk::meet(osg::LOD& lod, osg::PagedLOD* paged) {
  std::set<unsigned> absent;
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
    for (Child& shown : children) {
      if (shown.file.empty()) {
        shown.node->accept(*this);
      } else {
        walk(*shown.node, shown.file);
      }
      shown.node = nullptr;
    }
    return;
  }
}

}  // namespace roam::reader
