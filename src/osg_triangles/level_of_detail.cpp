#include "osg_triangles/level_of_detail.h"

#include <algorithm>
#include <limits>
#include <map>
#include <optional>
#include <osg/NodeVisitor>

namespace roam::osg_triangles {
namespace {

bool by_distance(const osg::LOD& lod) { return lod.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT; }

constexpr float infinite = std::numeric_limits<float>::infinity();

/// The distance from which on a node is shown; infinite if it never is.
float nearest_of(const osg::LOD& lod) {
  float nearest = infinite;
  for (const auto& range : lod.getRangeList()) nearest = std::min(nearest, range.first);
  return nearest;
}

struct Sibling {
  osg::LOD* lod = nullptr;
  float nearest = 0.0f;
  std::optional<osg::BoundingSphere> bound{};
  std::optional<bool> whole{};
  std::optional<bool> coarser_fill{};  ///< whether all its coarser levels fill its holes; empty if it has none
};

/// Finds the levels among the children that a node shows.
struct FindSiblings : osg::NodeVisitor {
  FindSiblings() : osg::NodeVisitor(TRAVERSE_ACTIVE_CHILDREN) {}
  void apply(osg::Node&) override {}
  void apply(osg::LOD& lod) override {
    if (by_distance(lod)) found.push_back({&lod, nearest_of(lod)});
  }
  std::vector<Sibling> found;
};

/// Finds nodes nested deeper than a limit. A damaged graph may contain itself.
struct FindDepth : osg::NodeVisitor {
  explicit FindDepth(std::size_t deepest) : osg::NodeVisitor(TRAVERSE_ALL_CHILDREN), limit(deepest) {
    setNodeMaskOverride(~0u);
  }
  void apply(osg::Node& node) override {
    too_deep = too_deep || getNodePath().size() > limit;
    if (too_deep || seen.contains(&node)) return;
    traverse(node);
    seen.insert(&node);
  }
  std::size_t limit;
  bool too_deep = false;
  std::set<const osg::Node*> seen;  ///< with all that is below
};

/// Whether OpenSceneGraph might exhaust the stack when it computes the bounds of a node.
bool is_deeper(osg::Node& node, std::size_t limit) {
  FindDepth find(limit);
  node.accept(find);
  return find.too_deep;
}

}  // namespace

std::vector<Level> levels(const osg::LOD& lod) {
  // Between two neighbouring ends of ranges the same children are shown. The lower end stands for the interval.
  const auto& ranges = lod.getRangeList();
  std::vector<float> ends;
  for (const auto& [first, second] : ranges) {
    // An empty range, or one with a NaN, hides its child.
    if (first < second) ends.insert(ends.end(), {first, second});
  }
  std::sort(ends.begin(), ends.end());
  if (!by_distance(lod)) std::reverse(ends.begin(), ends.end());
  std::vector<Level> all;
  for (const float end : ends) {
    Level shown;
    for (unsigned i = 0; i < ranges.size(); ++i) {
      if (ranges[i].first <= end && end < ranges[i].second) shown.push_back(i);
    }
    if (!shown.empty() && (all.empty() || all.back() != shown)) all.push_back(std::move(shown));
  }
  return all;
}

Level loaded_level(const osg::LOD& lod) {
  for (Level& level : levels(lod)) {
    // Numbers are ascending, so the last one decides.
    if (level.back() < lod.getNumChildren()) return std::move(level);
  }
  return {};
}

SiblingLevels::SiblingLevels(osg::Group& parent, const std::function<bool(osg::LOD&)>& is_whole,
                             std::size_t depth_limit) {
  // A level of detail chooses among its own children.
  if (dynamic_cast<osg::LOD*>(&parent) != nullptr) return;
  FindSiblings find;
  parent.traverse(find);
  std::vector<Sibling>& all = find.found;
  std::stable_sort(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.nearest < b.nearest; });
  std::multimap<float, Sibling*> by_end;
  for (Sibling& one : all) {
    for (const auto& [first, second] : one.lod->getRangeList()) {
      if (first < second) by_end.emplace(second, &one);
    }
  }

  const auto bound = [&](Sibling& one) -> const osg::BoundingSphere& {
    if (!one.bound) one.bound = is_deeper(*one.lod, depth_limit) ? osg::BoundingSphere() : one.lod->getBound();
    return *one.bound;
  };
  // A parent may have several objects. Levels without bounds lie anywhere.
  const auto meet = [&](Sibling& one, Sibling& other) {
    return !bound(one).valid() || !bound(other).valid() || bound(one).intersects(bound(other));
  };
  const auto finer_than = [&](Sibling& coarser) {
    std::vector<Sibling*> finer;
    if (!(coarser.nearest > 0.0f && coarser.nearest < infinite)) return finer;
    // Writers convert units: the end of one level and the beginning of the next may differ in the last digits.
    const float rounding = 1e-4f * coarser.nearest;
    const auto last = by_end.upper_bound(coarser.nearest + rounding);
    for (auto end = by_end.lower_bound(coarser.nearest - rounding); end != last; ++end) {
      if (end->second->nearest < coarser.nearest && meet(*end->second, coarser)) finer.push_back(end->second);
    }
    return finer;
  };
  const auto whole = [&](Sibling& one) {
    if (!one.whole) one.whole = is_whole(*one.lod);
    return *one.whole;
  };

  const auto filled_from_near = [&](Sibling* one) { return is_replaced(*one->lod) || whole(*one); };
  for (Sibling& one : all) {
    const std::vector<Sibling*> finer = finer_than(one);
    if (!finer.empty() && std::all_of(finer.begin(), finer.end(), filled_from_near)) replaced_.insert(one.lod);
  }
  // Coarsest first, so that a level is judged after all that are coarser.
  for (auto one = all.rbegin(); one != all.rend(); ++one) {
    if (is_replaced(*one->lod)) continue;
    if (one->coarser_fill.value_or(false)) giving_way_.insert(one->lod);
    for (Sibling* finer : finer_than(*one)) {
      if (filled_from_near(finer)) continue;
      finer->coarser_fill = finer->coarser_fill.value_or(true) && (gives_way(*one->lod) || whole(*one));
    }
  }
}

}  // namespace roam::osg_triangles
