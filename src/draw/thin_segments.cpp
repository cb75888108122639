#include "draw/thin_segments.h"

#include <algorithm>
#include <glm/common.hpp>
#include <tuple>

namespace roam::draw {
namespace {

/// Cells of the first grid along the longer side of the area: a sheet has 2,000 pixels, and magnifies parts of it.
constexpr double first_cells = 1 << 17;

auto key(const Segment& s) { return std::tuple(s.a.x, s.a.y, s.b.x, s.b.y); }

}  // namespace

ThinSegments::ThinSegments(const Rect& area, std::size_t most) : grid_(1e-6), most_(most) {
  if (area.empty()) return;
  origin_ = area.lower;
  grid_ = std::max(grid_, std::max(area.width(), area.height()) / first_cells);
}

void ThinSegments::add(std::vector<Segment>&& segments) {
  segments_.insert(segments_.end(), segments.begin(), segments.end());
  if (segments_.size() <= most_) return;
  thin();
  // Half as many, so that the next few segments do not thin again at once.
  while (segments_.size() > most_ / 2) {
    grid_ *= 2.0;
    thin();
  }
}

void ThinSegments::thin() {
  for (Segment& s : segments_) {
    for (Point* p : {&s.a, &s.b}) *p = origin_ + grid_ * glm::round((*p - origin_) / grid_);
    if (std::tie(s.b.x, s.b.y) < std::tie(s.a.x, s.a.y)) std::swap(s.a, s.b);
  }
  std::erase_if(segments_, [](const Segment& s) { return s.a == s.b; });
  std::sort(segments_.begin(), segments_.end(), [](const Segment& a, const Segment& b) { return key(a) < key(b); });
  const auto last = std::unique(segments_.begin(), segments_.end(),
                                [](const Segment& a, const Segment& b) { return a.a == b.a && a.b == b.b; });
  segments_.erase(last, segments_.end());
}

}  // namespace roam::draw
