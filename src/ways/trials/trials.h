#pragma once
/// \file
/// Trials: a real Walker is sent along a planned way.

#include <functional>
#include <span>

#include "roam/survey.h"
#include "roam/trial.h"
#include "roam/walker.h"

namespace roam::ways {

/// What bodies of several sizes have in common.
struct BodyKind {
  Mode mode = Mode::walk;
  double height = 0.0;  ///< m, on foot; 0: a sphere
  double step = 0.3;    ///< m; a sphere climbs at most its radius
  double slope_degrees = 45.0;
  double speed = 1.4;  ///< m/s
};

/// The largest radius that a body of this kind can have: half of what is between its knee and the top of its head.
[[nodiscard]] double largest_radius(const BodyKind& kind);

/// The settings of such a body. It does not crouch: a lower body is another body.
[[nodiscard]] WalkerSettings settings_of(const BodyKind& kind, double radius, double support_radius);

/// A trial's patience: it takes at most so many times the steps of free motion along its way, and of two seconds more.
/// Route ends what gets on by less than a twentieth of its speed; this, what is held up in each of its steps.
inline constexpr double trial_patience = 10.0;

/// Sends a body along `way` (of the feet on foot, else of the centre). Differs from Route's outcome in two cases:
///   - a body that does not fit at the start, and was put elsewhere by Walker::place, is `held`;
///   - a body that ends more than a step below the way has fallen into what stops it, however shallow: `fell`.
/// Who is not through when `patience` is at its end is `blocked`. `goes_on` is asked now and then; false ends the
/// trial, with the outcome so far `held`.
[[nodiscard]] Trial try_way(const Survey& survey, const BodyKind& kind, double radius, double support_radius,
                            std::span<const Vec3> way, const std::function<bool()>& goes_on = {},
                            double patience = trial_patience);

}  // namespace roam::ways
