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

/// Counts the triangles of a part in `cell`, in narrower cells, ascending by key.
using Refine = std::function<std::vector<PartCell>(std::uint32_t part, const CurveCell& cell)>;

/// Divides the triangles of so many parts into shards. The result depends only on the triangles' positions, not on the
/// size of the cells. Keeps at most `most` of them at any moment: where there are more, it counts in wider ones,
/// and refines these again as it comes to them. Throws roam::Error if that is not enough.
[[nodiscard]] std::vector<Stretch> divide(std::uint32_t parts, const Refine& refine, std::size_t most,
                                          const ShardLimits& limits = {});

}  // namespace roam::store
