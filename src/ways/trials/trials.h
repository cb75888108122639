#pragma once
/// \file
/// Trials: a real Walker follows a planned way.

#include <functional>
#include <span>

#include "roam/route.h"
#include "roam/survey.h"
#include "roam/trial.h"
#include "roam/walker.h"

namespace roam::ways {

/// The common properties of bodies of several sizes.
struct BodyKind {
  Mode mode = Mode::walk;
  double height = 0.0;  ///< m, on foot; 0: a sphere
  double step = 0.3;    ///< m; a sphere climbs at most its radius
  double slope_degrees = 45.0;
  double speed = 1.4;  ///< m/s
};

/// The largest radius of a body of this kind: half the height between its knee and its top.
[[nodiscard]] double largest_radius(const BodyKind& kind);

/// The settings of such a body. It does not crouch: a lower body is another body.
[[nodiscard]] WalkerSettings settings_of(const BodyKind& kind, double radius, double support_radius);

/// A trial ends after this many times the steps that free motion along its way takes, plus two seconds. Route ends a
/// body that moves slower than a twentieth of its speed; this limit ends one that is slowed in every step.
inline constexpr double trial_patience = 10.0;

/// On foot: whether a body has fallen into an obstacle, however shallow. It then ends more than its step below the way
/// (of the centres or feet; `end` likewise), and Route's outcome is `reached` or `blocked`.
[[nodiscard]] bool has_sunk(std::span<const Vec3> way, const RouteResult& result, const Vec3& end, double step);

/// Moves a body along `way` (of the feet on foot, else of the centre). Differs from Route's outcome in two cases:
/// - a body that does not fit at the start, and was put elsewhere by Walker::place, is `held`;
/// - a body that has_sunk() `fell`.
///
/// A body still under way when `patience` ends is `blocked`. Calls `goes_on` now and then; false ends the trial with
/// the outcome `held`.
[[nodiscard]] Trial try_way(const Survey& survey, const BodyKind& kind, double radius, double support_radius,
                            std::span<const Vec3> way, const std::function<bool()>& goes_on = {},
                            double patience = trial_patience);

}  // namespace roam::ways
