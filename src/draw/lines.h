#pragma once
/// \file
/// Joins loose segments into few long lines, so that a drawing stays small for any number of triangles.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "draw/geometry.h"

namespace roam::draw {

/// Limit for each kind in one panel: some 3 MB of SVG.
inline constexpr std::size_t usual_segments = 60'000;

/// Removes the corners that lie within `tolerance` of the line between their neighbours.
[[nodiscard]] Polyline simplified(const Polyline& line, double tolerance);

/// Moves the segments to the sheet by `to_sheet` and rounds their ends to an eighth of a pixel. Removes points and
/// duplicates, joins ends that meet, and straightens lines within a fifth of a pixel. If more than `most` segments are
/// left, rounds to coarser grids, up to 4 pixels, and then keeps the longest.
[[nodiscard]] std::vector<Polyline> joined(std::span<const Segment> segments,
                                           const std::function<Point(const Point&)>& to_sheet, std::size_t most);

}  // namespace roam::draw
