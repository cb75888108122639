#include "store/build/histogram.h"

#include <algorithm>

#include "store/build/curve.h"

namespace roam::store {
namespace {

constexpr std::size_t most_cells_at_once = most_cells;
constexpr std::size_t few_cells = 256;
/// Plans of scenes of 10^10 triangles must fit into the memory of a small machine: some 100 MB of cells.
constexpr std::uint64_t triangles_per_cell = 2048;

void count(std::vector<Cell>& cells, CurveKey key, std::uint64_t triangles) {
  if (!cells.empty() && cells.back().key == key) {
    cells.back().triangles += triangles;
  } else {
    cells.push_back({key, triangles});
  }
}

CurveKey cell_of(CurveKey key, int bits) { return key >> bits << bits; }

}  // namespace

void Histogram::add(std::span<const RunItem> items) {
  std::vector<Cell> merged;
  merged.reserve(cells_.size() + std::min(items.size(), most_cells_at_once));
  auto cell = cells_.begin();
  for (const RunItem& item : items) {
    const CurveKey key = cell_of(item.key, bits_);
    for (; cell != cells_.end() && cell->key <= key; ++cell) count(merged, cell->key, cell->triangles);
    count(merged, key, 1);
  }
  for (; cell != cells_.end(); ++cell) count(merged, cell->key, cell->triangles);
  cells_ = std::move(merged);
  coarsen(most_cells_at_once);
}

void Histogram::coarsen(std::size_t most) {
  while (cells_.size() > most) {
    ++bits_;
    std::size_t kept = 0;
    for (const Cell cell : cells_) {
      const CurveKey key = cell_of(cell.key, bits_);
      if (kept > 0 && cells_[kept - 1].key == key) {
        cells_[kept - 1].triangles += cell.triangles;
      } else {
        cells_[kept++] = {key, cell.triangles};
      }
    }
    cells_.resize(kept);
  }
}

void Histogram::finish(PartFile& part) {
  coarsen(static_cast<std::size_t>(
      std::clamp<std::uint64_t>(part.triangles / triangles_per_cell, few_cells, most_cells_at_once)));
  part.cell_bits = bits_;
  part.cells = std::move(cells_);
}

}  // namespace roam::store
