#include "store/pager/cells.h"

#include <cstdint>

#include "roam/pager.h"
#include "store/mask.h"
#include "world/unknown.h"

namespace roam::paging {
namespace {

using store::mask_cells;
using store::TileEntry;

/// A cube of cells, a power of two wide.
struct Cube {
  int x, y, z, size;

  [[nodiscard]] Box box(const TileEntry& t) const {
    const int from[3] = {x, y, z};
    Box out;
    for (int k = 0; k < 3; ++k) {
      const double extent = t.upper[k] - t.lower[k];
      out.lower[k] = t.lower[k] + extent * (double(from[k]) / mask_cells);
      out.upper[k] =
          from[k] + size == mask_cells ? t.upper[k] : t.lower[k] + extent * (double(from[k] + size) / mask_cells);
    }
    return out;
  }
  [[nodiscard]] TriangleId number() const { return static_cast<TriangleId>(x + mask_cells * (y + mask_cells * z)); }
  [[nodiscard]] store::CellRange range() const { return {{x, y, z}, {x + size - 1, y + size - 1, z + size - 1}}; }
  /// The octant that the bits of `i` choose: bit k is the upper half along axis k.
  [[nodiscard]] Cube part(int i) const {
    const int half = size / 2;
    return {x + (i & 1) * half, y + (i >> 1 & 1) * half, z + (i >> 2 & 1) * half, half};
  }
};

/// Visits the boxes of occupied cells for which look(box) is true. Boxes are as large as possible. `order` is the
/// octant of each cube that is visited first.
template <class Look, class Visit>
void visit_cells(const TileEntry& t, const Cube& cube, int order, const Look& look, const Visit& visit) {
  const store::Filled state = store::filled(t, cube.range());
  if (state == store::Filled::none) return;
  const Box box = cube.box(t);
  if (!look(box)) return;
  if (state == store::Filled::all) return visit(Cells{box, cube.number()});
  for (int i = 0; i < 8; ++i) visit_cells(t, cube.part(i ^ order), order, look, visit);
}

constexpr Cube all_cells{0, 0, 0, mask_cells};

}  // namespace

Sweep way_around(const index::Piece& piece, double reach) {
  const double around = piece.body.radius + reach + Pager::margin;
  return {piece.start, piece.motion, {around, around, around + piece.body.half_height}};
}

MetCells sweep_cells(const TileEntry& tile, const index::Piece& piece, double until) {
  MetCells met;
  met.time = until;
  const Sweep way = way_around(piece, 0.0);
  int backwards = 0;
  for (int k = 0; k < 3; ++k) backwards |= piece.motion[k] < 0.0 ? 1 << k : 0;
  visit_cells(
      tile, all_cells, backwards,
      [&](const Box& box) {
        const Interval when = way.meets(box);
        return !when.empty() && when.begin <= met.time;
      },
      [&](const Cells& cells) {
        const Impact impact = unknown::sweep(cells.box, Pager::margin, piece.body, piece.start, piece.motion);
        if (impact.hit && impact.time < met.time) met = {impact.time, cells};
      });
  return met;
}

void near_cells(const TileEntry& tile, const index::Piece& piece, TriangleId base, Collector& collector) {
  int far_side = 0;
  for (int k = 0; k < 3; ++k) far_side |= piece.start[k] > 0.5 * (tile.lower[k] + tile.upper[k]) ? 1 << k : 0;
  visit_cells(
      tile, all_cells, far_side,
      [&](const Box& box) { return !way_around(piece, collector.reach()).meets(box).empty(); },
      [&](const Cells& cells) {
        if (!collector.takes_unknown(cells.box, piece.body.radius, Pager::margin)) return;
        collector.offer(near_box(cells.box, piece, base + cells.first * unknown::sides), Pager::margin);
      });
}

Contact near_box(const Box& box, const index::Piece& piece, TriangleId base) {
  Contact c = unknown::nearest(box, Pager::margin, piece.body, piece.start, piece.motion);
  c.triangle += base;
  return c;
}

}  // namespace roam::paging
