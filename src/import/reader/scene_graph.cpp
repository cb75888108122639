#include "import/reader/scene_graph.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <osg/Billboard>
#include <osg/Camera>
#include <osg/Geometry>
#include <osg/LOD>
#include <osg/PagedLOD>
#include <osg/Sequence>
#include <osg/Transform>
#include <system_error>
#include <utility>

#include "import/reader/level_of_detail.h"
#include "import/reader/osg_files.h"
#include "import/reader/osg_geometry.h"
#include "roam/error.h"

namespace roam::reader {
namespace {

namespace fs = std::filesystem;

/// Nodes inside nodes; more is a graph that contains itself, and would exhaust the stack.
constexpr std::size_t depth_limit = 2000;

bool is_of(const osg::Object& object, const char* library) { return std::strcmp(object.libraryName(), library) == 0; }

}  // namespace

/// Keeps the names of the nodes that the walk is in.
class SceneGraphWalk::Entered {
 public:
  Entered(SceneGraphWalk& walk, const osg::Object& object) : walk_(walk) {
    if (walk_.names_.size() >= depth_limit) {
      throw Error(fmt::format("{}: its nodes are nested more than {} deep; the file is damaged.",
                              walk_.files_.back().string(), depth_limit));
    }
    walk_.names_.push_back(object.getName());
  }
  ~Entered() { walk_.names_.pop_back(); }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

 private:
  SceneGraphWalk& walk_;
};

SceneGraphWalk::SceneGraphWalk(MeshSink& sink) : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN), sink_(sink) {}

void SceneGraphWalk::walk(osg::Node& root, const fs::path& file) {
  files_.push_back(file);
  root.accept(*this);
  files_.pop_back();
}

bool SceneGraphWalk::left_out(const osg::Node& node) {
  if (is_of(node, "osgTerrain") || is_of(node, "osgVolume")) {
    sink_.report_note_once(
        fmt::format("{}: nodes of kind {}::{} make their surface while they are drawn; they are not "
                    "read.",
                    files_.back().string(), node.libraryName(), node.className()));
    return true;
  }
  return is_of(node, "osgParticle") || is_of(node, "osgText");
}

void SceneGraphWalk::apply(osg::Node& node) {
  const Entered entered(*this, node);
  traverse(node);
}

void SceneGraphWalk::apply(osg::Group& group) {
  if (left_out(group)) return;
  const Entered entered(*this, group);
  // Nodes that choose among their children (Switch, MultiSwitch, ProxyNode) do so themselves in this mode.
  traverse(group);
}

void SceneGraphWalk::apply(osg::Billboard&) {}

void SceneGraphWalk::apply(osg::Camera& camera) {
  // A camera with a frame of its own draws a head-up display or a texture.
  if (camera.getReferenceFrame() == osg::Transform::RELATIVE_RF) apply(static_cast<osg::Transform&>(camera));
}

void SceneGraphWalk::apply(osg::Transform& transform) {
  const Entered entered(*this, transform);
  const osg::Matrixd before = to_world_;
  transform.computeLocalToWorldMatrix(to_world_, this);
  traverse(transform);
  to_world_ = before;
}

void SceneGraphWalk::apply(osg::Sequence& sequence) {
  const Entered entered(*this, sequence);
  if (sequence.getNumChildren() == 0) return;
  const int shown = sequence.getValue();
  const bool started = shown >= 0 && static_cast<unsigned>(shown) < sequence.getNumChildren();
  sequence.getChild(started ? static_cast<unsigned>(shown) : 0)->accept(*this);
}

void SceneGraphWalk::apply(osg::Drawable& drawable) {
  if (left_out(drawable)) return;
  sink_.report_note_once(
      fmt::format("{}: drawables of kind {}::{} hold no triangles that can be read; they are left out.",
                  files_.back().string(), drawable.libraryName(), drawable.className()));
}

void SceneGraphWalk::apply(osg::Geometry& geometry) {
  const Entered entered(*this, geometry);
  sink_.begin_object(names_, files_.back().stem().string());
  if (sink_.parts() == nullptr) return add_geometry(geometry, to_world_, nullptr, sink_);
  const OsgLooks looks(geometry, getNodePath(), to_world_, sink_.parts()->textures());
  sink_.set_look(looks.look());
  add_geometry(geometry, to_world_, &looks, sink_);
}

void SceneGraphWalk::apply(osg::LOD& lod) { walk_children_shown(lod, nullptr); }

void SceneGraphWalk::apply(osg::PagedLOD& lod) { walk_children_shown(lod, &lod); }

void SceneGraphWalk::walk_children_shown(osg::LOD& lod, osg::PagedLOD* paged) {
  const Entered entered(*this, lod);
  const auto& path = getNodePath();
  const osg::Group* parent = path.size() > 1 ? path[path.size() - 2]->asGroup() : nullptr;
  if (parent != nullptr && continues_a_finer_sibling(lod, *parent)) return;

  struct Shown {
    osg::ref_ptr<osg::Node> node;
    fs::path file;  ///< empty for a child that lies in the same file
  };
  std::vector<unsigned> absent;
  while (true) {
    const std::vector<unsigned> finest = finest_children(lod, absent);
    std::vector<Shown> shown;
    std::vector<unsigned> missing;
    for (const unsigned i : finest) {
      if (i < lod.getNumChildren()) {
        shown.push_back({lod.getChild(i), {}});
        continue;
      }
      const bool named = paged != nullptr && i < paged->getNumFileNames() && !paged->getFileName(i).empty();
      if (!named) {
        missing.push_back(i);
        continue;
      }
      const fs::path named_from =
          paged->getDatabasePath().empty() ? files_.back().parent_path() : fs::path(paged->getDatabasePath());
      // Normal, so that a circle is known by its name.
      const fs::path file = (named_from / paged->getFileName(i)).lexically_normal();
      const bool circle = std::find(files_.begin(), files_.end(), file) != files_.end();
      if (circle) sink_.report_missing_page(file.string());
      if (osg::ref_ptr<osg::Node> page = circle ? nullptr : read_osg_file(file, false)) {
        shown.push_back({page, file});
      } else {
        missing.push_back(i);
      }
    }
    // A level that is not whole would leave holes: the next coarser one stands in for all of it.
    if (!missing.empty()) {
      absent.insert(absent.end(), finest.begin(), finest.end());
      std::sort(absent.begin(), absent.end());
      continue;
    }
    for (Shown& child : shown) {
      if (child.file.empty()) {
        child.node->accept(*this);
      } else {
        walk(*child.node, child.file);
      }
      child.node = nullptr;
    }
    return;
  }
}

}  // namespace roam::reader
