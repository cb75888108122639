#pragma once
/// \file
/// The contents of a Vicinity: the roots of searches around a body.

#include <cstdint>

#include "index/roots.h"
#include "world/nearby.h"

namespace roam {

/// The region of a query: everything within `reach` (m) of the body during its motion. For a sweep reach is hit_reach.
struct QueryRegion {
  const Body& body;
  const Vec3& from;
  const Vec3& motion;
  double reach;
  double largest_error;    ///< largest error of the space, metres
  std::uint64_t revision;  ///< revision of the space, which no other space has; not 0
};

struct Vicinity::State {
  Box box;                     ///< the region of `roots`; depends only on earlier queries and not on what was found
  std::uint64_t revision = 0;  ///< revision of the space in which they were gathered
  bool complete = false;       ///< they hold everything that meets the box
  index::Roots roots;

  /// Whether the box covers the region; if not, the box is moved so that it does. False if the region is too far or
  /// too wide for a vicinity.
  [[nodiscard]] bool cover(const QueryRegion& region);
};

/// The roots at which a search begins; null: at the root of the whole index. gather(box, roots) adds everything that
/// meets the box, and returns whether it could.
template <class Gather>
[[nodiscard]] const index::Roots* roots_in(Vicinity& vicinity, const QueryRegion& region, const Gather& gather) {
  Vicinity::State* const kept = vicinity.state();
  if (kept == nullptr || !kept->cover(region)) return nullptr;
  if (kept->revision != region.revision) {
    kept->revision = region.revision;
    kept->roots.count = 0;
    kept->complete = gather(kept->box, kept->roots);
  }
  return kept->complete ? &kept->roots : nullptr;
}

}  // namespace roam
