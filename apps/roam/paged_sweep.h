#pragma once
/// \file
/// Sweeps that are answered from a store: what they meet is brought first.

#include <limits>
#include <optional>

#include "open_scene.h"
#include "sweep_rows.h"

namespace roam::app {

/// How far around a way that is free its gap is looked for, in metres: near first, which is cheap and mostly enough.
inline constexpr double gap_reaches[] = {1.0, 10.0};

/// One thread at a time. A motion along which memory does not hold all that must be known is answered part by part.
class PagedSweep {
 public:
  explicit PagedSweep(OpenScene& scene) : scene_(scene) {}

  /// As Space::sweep, but nothing is unknown, the triangle is that of the scene, and of a miss `distance` is certified
  /// as well: less than it could be where memory does not hold what lies around the way. Throws roam::Error where what
  /// lies along the way cannot be read.
  [[nodiscard]] Impact operator()(const SweepQuery& query);

 private:
  [[nodiscard]] std::optional<Impact> sweep(const SweepQuery& part, bool may_part);
  [[nodiscard]] double gap(const SweepQuery& part);

  OpenScene& scene_;
  double fits_ = std::numeric_limits<double>::infinity();  ///< metres of a motion, as far as is known
};

}  // namespace roam::app
