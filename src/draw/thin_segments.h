#pragma once
/// \file
/// Segments that are to be drawn, in bounded memory: what cannot be told apart is held once.

#include <cstddef>
#include <vector>

#include "draw/geometry.h"

namespace roam::draw {

/// Takes any number of segments and holds about `most`. Where there are more, ends are rounded to a grid over `area`,
/// so that lines stay joined, and what has shrunk to a point or is there twice goes. The grid begins far finer than a
/// sheet shows and gets coarser by twos, as it must. The same segments in the same order give the same.
class ThinSegments {
 public:
  ThinSegments(const Rect& area, std::size_t most);

  void add(std::vector<Segment>&& segments);
  /// Once.
  [[nodiscard]] std::vector<Segment> take() { return std::move(segments_); }

 private:
  void thin();

  Point origin_{0.0};
  double grid_;  ///< metres
  std::size_t most_;
  std::vector<Segment> segments_;
};

}  // namespace roam::draw
