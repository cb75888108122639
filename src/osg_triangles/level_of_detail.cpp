#include "osg_triangles/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>

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

bool continues(const osg::LOD& coarser, const osg::LOD& finer) {
  if (!by_distance(coarser) || !by_distance(finer)) return false;
  const float nearest = nearest_of(coarser);
  if (!(nearest > 0.0f && nearest < infinite && nearest_of(finer) < nearest)) return false;
  // Writers convert units: the end of one level and the beginning of the next may differ in the last digits.
  const float rounding = 1e-4f * nearest;
  const auto& ranges = finer.getRangeList();
  const bool ends_there = std::any_of(ranges.begin(), ranges.end(),
                                      [&](const auto& range) { return std::abs(range.second - nearest) <= rounding; });
  // A parent may have several objects. Levels without bounds lie anywhere.
  const osg::BoundingSphere &here = coarser.getBound(), &there = finer.getBound();
  return ends_there && (!here.valid() || !there.valid() || here.intersects(there));
}

}  // namespace roam::osg_triangles
