#include "import/reader/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roam::reader {
namespace {

bool by_distance(const osg::LOD& lod) { return lod.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT; }

/// A range that nothing can fall into hides its child.
bool shows_something(const osg::LOD::MinMaxPair& range) { return range.first < range.second; }

}  // namespace

std::vector<unsigned> finest_children(const osg::LOD& lod, const std::vector<unsigned>& absent) {
  const auto& ranges = lod.getRangeList();
  const bool near = by_distance(lod);
  const auto counts = [&](unsigned i) {
    return shows_something(ranges[i]) && !std::binary_search(absent.begin(), absent.end(), i);
  };
  // The finest place: just beyond the least distance, or just below the largest size.
  float place = near ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
  for (unsigned i = 0; i < ranges.size(); ++i) {
    if (counts(i)) place = near ? std::min(place, ranges[i].first) : std::max(place, ranges[i].second);
  }
  std::vector<unsigned> shown;
  for (unsigned i = 0; i < ranges.size(); ++i) {
    const bool at_place = near ? ranges[i].first <= place : ranges[i].second >= place;
    if (counts(i) && at_place) shown.push_back(i);
  }
  return shown;
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
  // Writers convert units, so that one level's end and the next one's beginning may differ in the last digits.
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

}  // namespace roam::reader
