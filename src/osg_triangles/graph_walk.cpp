#include "osg_triangles/graph_walk.h"

#include <algorithm>
#include <cstring>
#include <osg/Billboard>

#include "roam/error.h"

namespace roam::osg_triangles {
namespace {

bool is_of(const osg::Object& object, const char* library) { return std::strcmp(object.libraryName(), library) == 0; }

/// Whether shaders make the triangles of these primitives.
bool made_by_shaders(const osg::PrimitiveSet& primitives) {
  switch (primitives.getMode()) {
    case osg::PrimitiveSet::PATCHES:
    case osg::PrimitiveSet::TRIANGLES_ADJACENCY:
    case osg::PrimitiveSet::TRIANGLE_STRIP_ADJACENCY:
      return true;
    default:
      return false;
  }
}

bool made_while_drawn(const osg::Object& object) { return is_of(object, "osgTerrain") || is_of(object, "osgVolume"); }

}  // namespace

bool has_no_surface(const osg::Object& object) {
  return is_of(object, "osgText") || is_of(object, "osgParticle") || made_while_drawn(object);
}

bool draws_elsewhere(const osg::Node& node) {
  const osg::Transform* transform = node.asTransform();
  if (transform == nullptr) return dynamic_cast<const osg::Projection*>(&node) != nullptr;
  return transform->getReferenceFrame() != osg::Transform::RELATIVE_RF;
}

osg::Node* shown_child(osg::Sequence& sequence) {
  const auto count = static_cast<int>(sequence.getNumChildren());
  if (count == 0) return nullptr;
  const int shown = sequence.getValue();
  return sequence.getChild(shown >= 0 && shown < count ? static_cast<unsigned>(shown) : 0);
}

/// Keeps what is known of the nodes between the root and the present node.
class GraphWalk::Entered {
 public:
  Entered(GraphWalk& walk, const osg::Object& object) : walk_(walk) {
    if (walk_.names_.size() >= depth_limit) walk_.refuse_depth();
    walk_.names_.push_back(object.getName());
    walk_.levels_below_.emplace_back();
  }
  ~Entered() {
    walk_.names_.pop_back();
    walk_.levels_below_.pop_back();
  }
  Entered(const Entered&) = delete;
  Entered& operator=(const Entered&) = delete;

 private:
  GraphWalk& walk_;
};

void GraphWalk::refuse_depth() {
  throw Error("a scene graph is nested more than " + std::to_string(depth_limit) +
              " nodes deep; it contains itself, or is damaged.");
}

void GraphWalk::apply(osg::Node& node) {
  const Entered entered(*this, node);
  traverse(node);
}

void GraphWalk::apply(osg::Group& group) {
  if (has_no_surface(group)) {
    if (made_while_drawn(group)) leave_out(group);
    return;
  }
  const Entered entered(*this, group);
  // In this mode, nodes that choose among their children (Switch, MultiSwitch, ProxyNode) do so themselves.
  traverse(group);
}

void GraphWalk::apply(osg::Billboard&) {}

void GraphWalk::apply(osg::Projection&) {}

void GraphWalk::apply(osg::Transform& transform) {
  if (draws_elsewhere(transform)) return;
  const Entered entered(*this, transform);
  const osg::Matrixd before = to_world_;
  transform.computeLocalToWorldMatrix(to_world_, this);
  traverse(transform);
  to_world_ = before;
}

void GraphWalk::apply(osg::Sequence& sequence) {
  const Entered entered(*this, sequence);
  if (osg::Node* child = shown_child(sequence)) child->accept(*this);
}

void GraphWalk::apply(osg::Drawable& drawable) {
  if (!has_no_surface(drawable) || made_while_drawn(drawable)) leave_out(drawable);
}

void GraphWalk::apply(osg::Geometry& geometry) {
  const Entered entered(*this, geometry);
  const auto& all = geometry.getPrimitiveSetList();
  if (std::any_of(all.begin(), all.end(), [](const auto& set) { return made_by_shaders(*set); })) leave_out(geometry);
  meet(geometry);
}

void GraphWalk::apply(osg::LOD& lod) { take(lod, nullptr); }

void GraphWalk::apply(osg::PagedLOD& lod) { take(lod, &lod); }

void GraphWalk::take(osg::LOD& lod, osg::PagedLOD* paged) {
  const Entered entered(*this, lod);
  if (!is_replaced(lod)) meet(lod, paged);
}

bool GraphWalk::is_replaced(const osg::LOD& lod) {
  const SiblingLevels* const all = siblings();
  return all != nullptr && all->is_replaced(lod);
}

bool GraphWalk::gives_way(const osg::LOD& lod) {
  const SiblingLevels* const all = siblings();
  return all != nullptr && all->gives_way(lod);
}

const SiblingLevels* GraphWalk::siblings() {
  const auto& path = getNodePath();
  osg::Group* const parent = path.size() > 1 ? path[path.size() - 2]->asGroup() : nullptr;
  if (parent == nullptr || levels_below_.size() < 2) return nullptr;
  std::optional<SiblingLevels>& known = levels_below_[levels_below_.size() - 2];
  const auto whole = [this](osg::LOD& lod) { return is_whole(lod); };
  if (!known) known.emplace(*parent, whole, depth_limit);
  return &*known;
}

}  // namespace roam::osg_triangles
