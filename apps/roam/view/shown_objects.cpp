#include "view/shown_objects.h"

#include <algorithm>
#include <osg/NodeVisitor>
#include <utility>

namespace roam::app {
namespace {

/// The objects of a geometry, kept as its user data.
class Kept : public osg::Referenced {
 public:
  Kept(std::vector<DisplayRun> runs, osg::DrawElementsUShort* all) : runs_(std::move(runs)), all_(all) {}

  /// Returns whether it changed anything.
  bool show(osg::Geometry& geometry, const SceneObjects::Flags& flags) {
    if (std::exchange(version_, flags.version) == flags.version) return false;
    const auto hides = [&](const DisplayRun& run) { return flags.hides(run.object); };
    const bool some = std::any_of(runs_.begin(), runs_.end(), hides);
    const bool all = some && std::all_of(runs_.begin(), runs_.end(), hides);
    const bool was_shown = geometry.getNodeMask() != 0u;
    geometry.setNodeMask(all ? 0u : ~0u);
    if (all || (!some && geometry.getPrimitiveSet(0) == all_.get())) return was_shown == all;
    geometry.setPrimitiveSet(0, some ? part(flags).get() : all_.get());
    return true;
  }

 private:
  [[nodiscard]] osg::ref_ptr<osg::DrawElementsUShort> part(const SceneObjects::Flags& flags) const {
    const osg::ref_ptr<osg::DrawElementsUShort> shown = new osg::DrawElementsUShort(GL_TRIANGLES);
    auto at = all_->begin();
    for (const DisplayRun& run : runs_) {
      const auto end = at + 3 * static_cast<std::ptrdiff_t>(run.triangles);
      if (!flags.hides(run.object)) shown->insert(shown->end(), at, end);
      at = end;
    }
    return shown;
  }

  std::vector<DisplayRun> runs_;
  osg::ref_ptr<osg::DrawElementsUShort> all_;
  std::uint64_t version_ = 0;  ///< of the flags for which it is shown
};

class Show : public osg::NodeVisitor {
 public:
  explicit Show(const SceneObjects::Flags& flags) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), flags_(flags) {
    setNodeMaskOverride(~0u);  // what is hidden may be shown again
  }
  void apply(osg::Geometry& geometry) override {
    if (auto* const kept = dynamic_cast<Kept*>(geometry.getUserData())) has_changed_ |= kept->show(geometry, flags_);
  }
  [[nodiscard]] bool has_changed() const { return has_changed_; }

 private:
  const SceneObjects::Flags& flags_;
  bool has_changed_ = false;
};

}  // namespace

void keep_objects(osg::Geometry& geometry, std::vector<DisplayRun> runs, const SceneObjects::Flags& flags) {
  if (runs.empty() || geometry.getNumPrimitiveSets() != 1) return;
  auto* const all = dynamic_cast<osg::DrawElementsUShort*>(geometry.getPrimitiveSet(0));
  if (all == nullptr) return;
  const osg::ref_ptr<Kept> kept = new Kept(std::move(runs), all);
  kept->show(geometry, flags);
  geometry.setUserData(kept);
}

bool show_objects(osg::Node& node, const SceneObjects::Flags& flags) {
  Show show(flags);
  node.accept(show);
  return show.has_changed();
}

}  // namespace roam::app
