#pragma once
/// \file
/// Long lines in few points, so that a drawing stays small for any number of triangles: the corners that keep the shape
/// of a line, loose segments joined into lines, and segments held in bounded memory.

#include <cstddef>
#include <functional>
#include <glm/geometric.hpp>
#include <span>
#include <utility>
#include <vector>

#include "draw/geometry.h"

namespace roam::draw {

/// Limit for each kind in one panel: some 3 MB of SVG.
inline constexpr std::size_t usual_segments = 60'000;
/// Pixels: a drawn line may be straightened by this.
inline constexpr double straight = 0.2;
/// Pixels: drawn lines lie this near to their places, unless they are many.
inline constexpr double usual_exactness = 2.0 * straight;

/// The position of the place of the segment from `a` (0) to `b` (1) nearest to `p`; 0 if the segment is no longer than
/// a point.
template <typename V>
[[nodiscard]] double nearest_part(const V& p, const V& a, const V& b) {
  const V d = b - a;
  const double square = glm::dot(d, d);
  return square > 0.0 ? std::clamp(glm::dot(p - a, d) / square, 0.0, 1.0) : 0.0;
}

/// Sets keep[i] to 1 for the places of [first, last] that must stay, including first and last. Every other place
/// deviates by at most `tolerance` from the straight piece between its kept neighbours (Douglas and Peucker, 1973).
/// `deviation(i, from, to)` is that of `i` from the piece between `from` and `to`.
template <typename Deviation>
void keep_corners(std::size_t first, std::size_t last, double tolerance, const Deviation& deviation,
                  std::vector<char>& keep) {
  std::vector<std::pair<std::size_t, std::size_t>> open{{first, last}};
  keep[first] = keep[last] = 1;
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double worst = tolerance;
    std::size_t at = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double d = deviation(i, from, to);
      if (d > worst) {
        worst = d;
        at = i;
      }
    }
    if (at == from) continue;
    keep[at] = 1;
    open.emplace_back(from, at);
    open.emplace_back(at, to);
  }
}

/// Removes the corners that lie within `tolerance` of the line between their neighbours.
[[nodiscard]] Polyline simplified(const Polyline& line, double tolerance);

/// How much less exact lines are, because they would be too many.
struct Coarsened {
  double grid = 0.0;         ///< pixels that ends were rounded to; 0: an eighth, as usual
  std::size_t left_out = 0;  ///< short segments
};

/// Moves the segments to the sheet by `to_sheet` and rounds their ends to an eighth of a pixel. Removes points and
/// duplicates, joins ends that meet, and straightens lines. If these have more than `most` pieces, rounds to coarser
/// grids, up to 4 pixels, then keeps only the longest segments; `coarsened` gets the grid and the number left out.
[[nodiscard]] std::vector<Polyline> joined(std::span<const Segment> segments,
                                           const std::function<Point(const Point&)>& to_sheet, std::size_t most,
                                           Coarsened& coarsened);

/// Takes any number of segments and holds about `most`. If there are more, rounds their ends to a grid, so that lines
/// stay joined, and removes points and duplicates. Its cells are squares on the sheet of `frame`, whatever its heights
/// are exaggerated by. They begin far smaller than a sheet can show, and double as needed. The same segments in the
/// same order give the same result.
class ThinSegments {
 public:
  ThinSegments(const Frame& frame, std::size_t most);

  void add(std::vector<Segment>&& segments);
  /// Call it once.
  [[nodiscard]] std::vector<Segment> take() { return std::move(segments_); }
  /// Metres to the right that ends were rounded to; 0: no cell is larger than the first ones.
  [[nodiscard]] double coarsened() const { return coarsened_; }

 private:
  Point origin_{0.0};
  Point grid_;  ///< a cell, metres
  std::size_t most_;
  double coarsened_ = 0.0;
  std::vector<Segment> segments_;
};

}  // namespace roam::draw
