#pragma once
/// \file
/// Sweeps that are answered from a store: what they meet is brought first.

#include <limits>
#include <optional>
#include <set>
#include <string>

#include "scenes/open_scene.h"
#include "sweep/rows.h"

namespace roam::app {

/// How far around a way that is free its gap is looked for, in metres: near first, which is cheap and mostly enough.
inline constexpr double gap_reaches[] = {1.0, 10.0};

/// An answer, and what is not known of it.
struct SweepAnswer {
  Impact impact;
  std::string missing;  ///< what could not be read, and why; empty: nothing is missing
};

/// One thread at a time. A motion along which memory does not hold all that must be known is answered part by part.
class PagedSweep {
 public:
  explicit PagedSweep(OpenScene& scene) : scene_(scene) {}

  /// As Space::sweep, but the triangle is that of the scene, and of a miss `distance` is certified as well: less than
  /// it could be where memory does not hold what lies around the way. What cannot be read is unknown, and met as if it
  /// were solid; where only the number of the triangle cannot be read, that is no_triangle. Throws roam::Error where
  /// what lies along the way can be read, but does not come in a minute.
  [[nodiscard]] SweepAnswer operator()(const SweepQuery& query);

 private:
  [[nodiscard]] std::optional<Impact> sweep(const SweepQuery& part, bool may_part);
  [[nodiscard]] double gap(const SweepQuery& part);

  OpenScene& scene_;
  std::set<std::string> given_up_;  ///< what could not be read in broken_after, which need not be waited for again
  double fits_ = std::numeric_limits<double>::infinity();  ///< metres of a motion, as far as is known
};

}  // namespace roam::app
