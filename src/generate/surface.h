#pragma once
/// \file
/// Surfaces as grids with rectangular holes, and the fittings of these holes.
///
/// Every scene consists of grids and fans whose numbers of triangles and vertices follow from their dimensions. Where
/// two surfaces meet, the same function of the same integers computes the shared points, so their bits are equal.

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "roam/math.h"
#include "roam/mesh.h"

namespace roam::generate {

/// A hole: the cells of rows [row0, row1) and columns [col0, col1) of a grid. Holes of one grid do not touch each
/// other.
struct Hole {
  int row0, row1, col0, col1;
};

/// Fills one row of vertices of a grid.
using RowPoints = std::function<void(int row, std::span<Vec3> points)>;

/// A surface of rows x cols cells, two triangles each. Triangles are counter-clockwise as seen from the side of
/// (direction of growing row) x (direction of growing column), or from the other side if `flipped`.
struct Grid {
  int rows = 0, cols = 0;
  RowPoints points = {};  ///< rows + 1 rows of cols + 1 vertices, or of cols vertices if closed
  bool closed = false;    ///< column `cols` is column 0
  bool flipped = false;
  std::vector<Hole> holes = {};

  [[nodiscard]] int vertex_cols() const { return cols + (closed ? 0 : 1); }
};

/// A polygon that is star-shaped about its centre, closed by triangles (centre, p[k], p[k+1]).
struct Fan {
  Vec3 center{0.0};
  int corners = 0;
  std::function<void(std::span<Vec3>)> points = {};
  bool flipped = false;
};

/// A part becomes one object of the scene, or several if it is large.
struct Part {
  std::string name = {};
  std::vector<Grid> grids = {};
  std::vector<Fan> fans = {};
};

/// A run of rows of one grid of a part, or all its fans (grid < 0). A slice lies in one mesh.
struct Slice {
  int grid, row0, row1;
};

struct Count {
  std::uint64_t triangles = 0, vertices = 0, objects = 0;
};

/// Divides a part into meshes of at most piece_triangles triangles.
[[nodiscard]] std::vector<std::vector<Slice>> slice(const Part& part);
[[nodiscard]] Count count(const Part& part, const std::vector<Slice>& slices);
/// Appends the slices' vertices and triangles to `mesh`.
void emit(const Part& part, const std::vector<Slice>& slices, Mesh& mesh);

/// The vertices around a hole without repetition: the first row by growing column, the last column, and back.
[[nodiscard]] int loop_size(const Hole& hole);
[[nodiscard]] std::vector<Vec3> loop(const Grid& grid, const Hole& hole);

/// Fits a box into a hole of `grid`: sides of `layers` layers, and a bottom of the hole's own grid displaced by
/// `depth`. A depth against the surface's normal makes a pit, a recess or a dead-end tunnel; one along it makes a
/// plinth or a corbel.
void add_pocket(Part& part, const Grid& grid, const Hole& hole, const Vec3& depth, int layers);

/// Joins a hole of one grid to a hole of equal dimensions of another, by a tunnel of `layers` layers.
void add_passage(Part& part, const Grid& from, const Hole& hole, const Grid& to, const Hole& end, int layers);

}  // namespace roam::generate
