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
  /// No shard holds more: what one shard takes in memory is bounded by it. A multiple of AbsoluteCurve::most_tile_triangles.
  std::uint64_t shard = 1u << 20;
  /// Cells of the curve with more triangles than this share no shard with their neighbours, so that what changes in one
  /// of them moves no border of another's shards.
  std::uint64_t district = 1u << 22;
};

/// How many triangles of a part lie in a cell of the curve.
struct PartCell {
  CurveKey key = 0;
  std::uint64_t triangles = 0;
  std::uint32_t part = 0;
  int bits = 0;  ///< as CurveCell
};

/// A stretch of the curve. Its cells, in order, are those that any cut into tiles has borders at, because the cell
/// around two of them holds more triangles than a tile.
struct Stretch {
  std::vector<CurveCell> cells;
  /// Where a single smallest cell holds more triangles than a shard: those from `skip` on, by part and number, belong
  /// to this one. 0 elsewhere.
  std::uint64_t skip = 0;
  std::uint64_t triangles = 0;
  std::vector<std::uint32_t> parts;  ///< with triangles here, ascending
};

/// Counts the triangles of a part in the cells into which `cell` falls when `bits` low bits of the keys are left out.
using Refine = std::function<std::vector<PartCell>(std::uint32_t part, const CurveCell& cell, int bits)>;

/// The shards of these cells, which ascend by key; those of one part do not overlap. Depends on where the triangles are
/// only, not on how finely the cells say it.
[[nodiscard]] std::vector<Stretch> divide(std::vector<PartCell> cells, const Refine& refine,
                                          const ShardLimits& limits = {});

}  // namespace roam::store
