#include "osg_triangles/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roam::osg_triangles {
namespace {

bool by_distance(const osg::LOD& lod) { return lod.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT; }

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

bool continues_a_finer_sibling(const osg::LOD& lod, const osg::Group& parent) {
  if (!by_distance(lod) || lod.getNumRanges() == 0) return false;
  const auto nearest_of = [](const osg::LOD& node) {
    float nearest = std::numeric_limits<float>::infinity();
    for (const auto& range : node.getRangeList()) nearest = std::min(nearest, range.first);
    return nearest;
  };
  const float nearest = nearest_of(lod);
  if (!(nearest > 0.0f)) return false;
  // Writers convert units: the end of one level and the beginning of the next may differ in the last digits.
  const float rounding = 1e-4f * nearest;
  for (unsigned i = 0; i < parent.getNumChildren(); ++i) {
    const osg::LOD* sibling = dynamic_cast<const osg::LOD*>(parent.getChild(i));
    if (sibling == nullptr || sibling == &lod || !by_distance(*sibling) || !(nearest_of(*sibling) < nearest)) continue;
    for (const auto& range : sibling->getRangeList()) {
      if (std::abs(range.second - nearest) <= rounding) return true;
    }
  }
  return false;
}

}  // namespace roam::osg_triangles
