#pragma once
/// \file
/// A gallery as a closed tube: a cross-section carried along an axis, with roughness, and with openings cut along
/// the lines of its grid.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "generate/axis.h"
#include "generate/surface.h"

namespace roam::generate {

/// Marks in growing order with the spans between them divided into steps of at most `cell`, one at least.
[[nodiscard]] std::vector<double> subdivide(std::span<const double> marks, double cell);
/// The same with `extra` lines in all besides the marks, shared out by the length of the spans.
[[nodiscard]] std::vector<double> distribute(std::span<const double> marks, std::int64_t extra);
/// Where a mark lies among the lines that came of it.
[[nodiscard]] int index_of(std::span<const double> lines, double mark);

/// The outline of a tube, seen along the axis: y to the left, z up from the floor, in metres. It runs along the floor
/// to the left, up, and back over the crown.
struct Section {
  /// A corner and the way to the next one.
  struct Corner {
    double y, z;
    double roughness = 0.0;  ///< of the way to the next corner: largest displacement, m
    bool sharp = true;       ///< a true corner or the end of a rough surface: it stays where it is
    bool arch = false;       ///< the way to the next is half a circle around (0, z)
  };
  struct Column {
    double y, z;
    double ny, nz;     ///< into the tube
    double roughness;  ///< m
    double v;          ///< along the outline, m
  };
  std::vector<Column> columns;
  std::vector<int> corner;  ///< the column of each corner

  Section(std::span<const Corner> corners, double cell);
};

/// A rectangular opening: between two stations, and between two corners of the section.
struct Opening {
  double from, to;
  int corner0, corner1;
};

struct Tube {
  Axis axis;
  Section section;
  std::vector<double> stations;   ///< one a row of vertices
  std::vector<Opening> openings;  ///< by growing `from`; the surface around them is smooth
  /// Station and height of the floor, joined by straight lines; level before the first and after the last.
  std::vector<std::pair<double, double>> floor;
  std::uint64_t seed = 0;
  Vec3 origin{0.0};

  [[nodiscard]] Vec3 point(double station, double y, double z) const;
  [[nodiscard]] double floor_at(double station) const;
  [[nodiscard]] Hole hole(const Opening& opening) const;
  void row_points(int row, std::span<Vec3> points) const;
};

/// Rows [row0, row1) of a tube, with the openings that lie in them cut out.
[[nodiscard]] Grid tube_grid(const std::shared_ptr<const Tube>& tube, int row0, int row1);
/// The bulkhead at the first (or last) row: a fan over the given columns around (y, z) at the floor.
[[nodiscard]] Fan bulkhead(const std::shared_ptr<const Tube>& tube, bool last, std::vector<int> columns, double y,
                           double z);
/// Columns from one corner of the section to another, both included, over the end of the outline if need be.
[[nodiscard]] std::vector<int> columns_between(const Section& section, int corner0, int corner1);

}  // namespace roam::generate
