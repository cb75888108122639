#pragma once
/// \file
/// Sweeps through a store, which load the tiles that they need.

#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <string>

#include "scenes/open_scene.h"
#include "sweep/rows.h"

namespace roam::app {

/// m: distances in which the gap around a free motion is searched. The near one is cheap and mostly enough.
inline constexpr double gap_reaches[] = {1.0, 10.0};

/// The result of a sweep, and its unreadable tiles.
struct SweepAnswer {
  Impact impact;
  std::string missing;  ///< what could not be read, and why; empty: all was read
};

/// Sweeps in parts if memory cannot hold the surroundings of the whole motion. One thread at a time.
class PagedSweep {
 public:
  explicit PagedSweep(OpenScene& scene) : scene_(scene) {}

  /// Like Space::sweep, but the triangle's number is that of the scene. For a miss, `distance` is certified too; it may
  /// be too low if memory does not hold the surroundings of the motion. Unreadable space is unknown, and hit as if it
  /// were solid; so is what has not come after a minute without any tile. If only the triangle's number is unreadable,
  /// it is no_triangle.
  [[nodiscard]] SweepAnswer operator()(const SweepQuery& query);

 private:
  [[nodiscard]] std::optional<Impact> sweep(const SweepQuery& part, bool may_part);
  [[nodiscard]] double gap(const SweepQuery& part);
  [[nodiscard]] bool is_stuck() const;

  OpenScene& scene_;
  std::set<std::string> given_up_;  ///< unreadable after broken_after; not awaited again
  std::uint64_t stuck_at_ = std::numeric_limits<std::uint64_t>::max();  ///< loads when nothing more had come
  double fits_ = std::numeric_limits<double>::infinity();  ///< m of a motion that memory can hold, as known so far
};

}  // namespace roam::app
