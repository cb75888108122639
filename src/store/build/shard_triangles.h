#pragma once
/// \file
/// The triangles of one shard, in memory.

#include <cstdint>
#include <memory>
#include <span>

#include "roam/mesh.h"
#include "store/build/plan.h"
#include "store/build/work.h"
#include "store/part.h"

namespace roam::store {

struct ShardItem {
  CurveKey key;
  float reach;             ///< see Place
  std::uint32_t triangle;  ///< of ShardTriangles::triangles
};
static_assert(sizeof(ShardItem) == 32);

struct ShardTriangles {
  struct Source {
    std::uint64_t number;  ///< in the part
    std::uint32_t part;    ///< of the plan
  };
  explicit ShardTriangles(std::size_t count)
      : triangles(std::make_unique_for_overwrite<Triangle[]>(count)),
        sources(std::make_unique_for_overwrite<Source[]>(count)),
        all_items(std::make_unique_for_overwrite<ShardItem[]>(count)),
        items(all_items.get(), count) {}

  // Left uninitialized, so that the threads that fill them touch them first.
  std::unique_ptr<Triangle[]> triangles;  ///< in no order
  std::unique_ptr<Source[]> sources;
  std::unique_ptr<ShardItem[]> all_items;
  /// Sorted along the curve. In one cell they are sorted by their coordinates, so that the tiles do not depend on the
  /// order of the scene, then by source.
  std::span<ShardItem> items;
};

/// Reads the stretch from the runs of the plan. Throws roam::Error when a run is missing or damaged.
[[nodiscard]] ShardTriangles read_shard(Work& work, const Plan& plan, const Stretch& stretch);

}  // namespace roam::store
