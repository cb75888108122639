#pragma once
/// \file
/// The children of a level-of-detail node that are shown from near by.

#include <cstddef>
#include <functional>
#include <osg/Group>
#include <osg/LOD>
#include <set>
#include <vector>

namespace roam::osg_triangles {

/// Indices of children that are shown together, ascending.
using Level = std::vector<unsigned>;

/// The levels of a node, finest first: nearest for ranges of distance, largest for ranges of size on screen. A child
/// may belong to several levels.
[[nodiscard]] std::vector<Level> levels(const osg::LOD& lod);

/// The finest level whose children are all loaded. An incomplete level would leave holes. Empty if there is none.
[[nodiscard]] Level loaded_level(const osg::LOD& lod);

/// The levels of detail among the children that a node shows. Some modellers, and OpenFlight, give each level a node of
/// its own: a sibling that begins where another ends is a coarser level of it.
class SiblingLevels {
 public:
  /// `is_whole` returns whether a sibling leaves no hole. It is called at most once for each sibling, and only if
  /// needed. Siblings nested deeper than `depth_limit` count as if they had no bounds.
  SiblingLevels(osg::Group& parent, const std::function<bool(osg::LOD&)>& is_whole, std::size_t depth_limit);

  /// Whether the finer levels of a sibling are shown instead of it, without a hole.
  [[nodiscard]] bool is_replaced(const osg::LOD& lod) const { return replaced_.contains(&lod); }
  /// Whether a sibling has holes, and its coarser levels are shown instead of it, without a hole.
  [[nodiscard]] bool gives_way(const osg::LOD& lod) const { return giving_way_.contains(&lod); }

 private:
  std::set<const osg::LOD*> replaced_, giving_way_;
};

}  // namespace roam::osg_triangles
