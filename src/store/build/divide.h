#pragma once
/// \file
/// Divides the curve into shards.

#include <cstdint>
#include <functional>
#include <vector>

#include "store/build/curve.h"
#include "store/part.h"

namespace roam::store {

struct ShardLimits {
  /// The largest shard, which bounds the memory for one shard. A multiple of AbsoluteCurve::most_tile_triangles.
  std::uint64_t shard = 1u << 20;
  /// Cells of the curve with more triangles than this share no shard with their neighbours. So a change in one of them
  /// moves no border of another's shards.
  std::uint64_t district = 1u << 22;
};

/// The number of triangles of a part in a cell of the curve.
struct PartCell {
  CurveKey key = 0;
  std::uint64_t triangles = 0;
  std::uint32_t part = 0;
  int bits = 0;  ///< as CurveCell
};

/// A range of the curve. Every division into tiles has borders at those of its cells, which are in order: the smallest
/// cell around two of them holds more triangles than a tile.
struct Stretch {
  std::vector<CurveCell> cells;
  /// If a single smallest cell holds more triangles than a shard: of the triangles of `parts` in it, by part and
  /// number, those from `skip` on belong to this stretch. 0 otherwise.
  std::uint64_t skip = 0;
  std::uint64_t triangles = 0;
  std::vector<std::uint32_t> parts;  ///< with triangles here, ascending
};

/// Counts the triangles of a part in the parts of `cell` that remain when the `bits` low bits of the keys are left out.
using Refine = std::function<std::vector<PartCell>(std::uint32_t part, const CurveCell& cell, int bits)>;

/// Divides these cells into shards. Cells of one part may not overlap. The result depends only on the triangles'
/// positions, not on the size of the cells.
[[nodiscard]] std::vector<Stretch> divide(std::vector<PartCell> cells, const Refine& refine,
                                          const ShardLimits& limits = {});

}  // namespace roam::store
