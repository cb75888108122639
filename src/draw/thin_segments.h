#pragma once
/// \file
/// Segments for drawing, in bounded memory: indistinguishable ones are held once.

#include <cstddef>
#include <vector>

#include "draw/geometry.h"

namespace roam::draw {

/// Takes any number of segments and holds about `most`. If there are more, rounds their ends to a grid over `area`, so
/// that lines stay joined, and removes points and duplicates. The grid begins far finer than a sheet can show, and
/// doubles its cells as needed. The same segments in the same order give the same result.
class ThinSegments {
 public:
  ThinSegments(const Rect& area, std::size_t most);

  void add(std::vector<Segment>&& segments);
  /// Call it once.
  [[nodiscard]] std::vector<Segment> take() { return std::move(segments_); }

 private:
  void thin();

  Point origin_{0.0};
  double grid_;  ///< metres
  std::size_t most_;
  std::vector<Segment> segments_;
};

}  // namespace roam::draw
