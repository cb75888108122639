#pragma once
/// \file
/// Loose segments made into few long lines, so that a drawing stays small however many triangles were cut.

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "draw/geometry.h"

namespace roam::draw {

/// Of each kind in one panel: some 3 MB of SVG.
inline constexpr std::size_t usual_segments = 60'000;

/// The corners that stay when those that lie within `tolerance` of the line between their neighbours are left out.
[[nodiscard]] Polyline simplified(const Polyline& line, double tolerance);

/// Moves the segments to the sheet by `to_sheet`, rounds their ends to an eighth of a pixel, leaves out what has
/// shrunk to a point and what is there twice, joins the rest where ends meet, and straightens what is straight within
/// a fifth of a pixel. Where more than `most` segments are left it rounds to coarser grids, up to 4 pixels, and then
/// keeps the longest.
[[nodiscard]] std::vector<Polyline> joined(std::span<const Segment> segments,
                                           const std::function<Point(const Point&)>& to_sheet, std::size_t most);

}  // namespace roam::draw
