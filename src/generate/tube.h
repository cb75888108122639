#pragma once
/// \file
/// A gallery as a closed tube: a cross-section extruded along an axis, with roughness, and with openings along the
/// lines of its grid.

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "generate/axis.h"
#include "generate/surface.h"

namespace roam::generate {

/// Marks in ascending order. Each span between them is divided into at least one step of at most `cell`.
[[nodiscard]] std::vector<double> subdivide(std::span<const double> marks, double cell);
/// The same marks with `extra` more lines in all, distributed by the length of the spans.
[[nodiscard]] std::vector<double> distribute(std::span<const double> marks, std::int64_t extra);
/// The index of a mark among the lines made from it.
[[nodiscard]] int index_of(std::span<const double> lines, double mark);

/// The outline of a tube, seen along the axis: y to the left, z up from the floor, in metres. It runs along the floor
/// to the left, up, and back over the crown.
struct Section {
  /// A corner and the edge to the next one.
  struct Corner {
    double y, z;
    double roughness = 0.0;  ///< of the edge to the next corner: largest displacement, m
    bool sharp = true;       ///< a true corner or the end of a rough surface; it is not displaced
    bool arch = false;       ///< the edge to the next corner is half a circle around (0, z)
  };
  struct Column {
    double y, z;
    double ny, nz;     ///< the normal, into the tube
    double roughness;  ///< m
    double v;          ///< along the outline, m
  };
  std::vector<Column> columns;
  std::vector<int> corner;  ///< the column of each corner

  Section(std::span<const Corner> corners, double cell);
};

/// A rectangular opening between two stations and two corners of the section.
struct Opening {
  double from, to;
  int corner0, corner1;
};

struct Tube {
  Axis axis;
  Section section;
  std::vector<double> stations;   ///< one for each row of vertices
  std::vector<Opening> openings;  ///< ascending by `from`; the surface around them is smooth
  /// Station and height of the floor, joined by straight lines. It is level before the first and after the last.
  std::vector<std::pair<double, double>> floor;
  std::uint64_t seed = 0;
  Vec3 origin{0.0};

  [[nodiscard]] Vec3 point(double station, double y, double z) const;
  [[nodiscard]] double floor_at(double station) const;
  [[nodiscard]] Hole hole(const Opening& opening) const;
  void row_points(int row, std::span<Vec3> points) const;
};

/// Rows [row0, row1) of a tube, without the openings in them.
[[nodiscard]] Grid tube_grid(const std::shared_ptr<const Tube>& tube, int row0, int row1);
/// The bulkhead at the first or last row: a fan over the given columns. Its centre is (y, z) relative to the floor.
[[nodiscard]] Fan bulkhead(const std::shared_ptr<const Tube>& tube, bool last, std::vector<int> columns, double y,
                           double z);
/// Columns from one corner of the section to another, both included. The range may wrap past the end of the outline.
[[nodiscard]] std::vector<int> columns_between(const Section& section, int corner0, int corner1);

}  // namespace roam::generate
