#include "osg_triangles/level_of_detail.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace roam::osg_triangles {
namespace {

bool by_distance(const osg::LOD& lod) { return lod.getRangeMode() == osg::LOD::DISTANCE_FROM_EYE_POINT; }

/// A range that nothing can fall into hides its child.
bool shows_something(const osg::LOD::MinMaxPair& range) { return range.first < range.second; }

/// The children at one end of all ranges that count: just beyond the least first value, or just below the largest
/// second one.
std::vector<unsigned> children_at_end(const osg::LOD& lod, const std::vector<unsigned>& absent, bool least) {
  const auto& ranges = lod.getRangeList();
  const auto counts = [&](unsigned i) {
    return shows_something(ranges[i]) && !std::binary_search(absent.begin(), absent.end(), i);
  };
  float place = least ? std::numeric_limits<float>::infinity() : -std::numeric_limits<float>::infinity();
  for (unsigned i = 0; i < ranges.size(); ++i) {
    if (counts(i)) place = least ? std::min(place, ranges[i].first) : std::max(place, ranges[i].second);
  }
  std::vector<unsigned> shown;
  for (unsigned i = 0; i < ranges.size(); ++i) {
    const bool at_place = least ? ranges[i].first <= place : ranges[i].second >= place;
    if (counts(i) && at_place) shown.push_back(i);
  }
  return shown;
}

}  // namespace

std::vector<unsigned> finest_children(const osg::LOD& lod, const std::vector<unsigned>& absent) {
  return children_at_end(lod, absent, by_distance(lod));
}

std::vector<unsigned> coarsest_children(const osg::LOD& lod, const std::vector<unsigned>& absent) {
  return children_at_end(lod, absent, !by_distance(lod));
}

std::vector<unsigned> loaded_children(const osg::LOD& lod, bool finest) {
  std::vector<unsigned> absent;
  while (true) {
    const std::vector<unsigned> shown = finest ? finest_children(lod, absent) : coarsest_children(lod, absent);
    // Numbers are ascending: the last one decides.
    if (shown.empty() || shown.back() < lod.getNumChildren()) return shown;
    absent.insert(absent.end(), shown.begin(), shown.end());
    std::sort(absent.begin(), absent.end());
  }
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

}  // namespace roam::osg_triangles
