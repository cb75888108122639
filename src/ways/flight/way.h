#pragma once
/// \file
/// The widest way through the air.

#include <functional>

#include "roam/passage.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

struct FlyOptions {
  double spacing = 0.2;                             ///< m, as PassageOptions::spacing
  std::uint64_t most_places = 4'000'000;            ///< cubes of air that are looked at, 60 bytes each
  std::function<bool(std::uint64_t)> goes_on = {};  ///< asked with their number; false ends the search
};

/// As roam::widest_way, between two places where a sphere of measure.narrowest is free. `bound` is infinite where
/// nothing is known.
[[nodiscard]] Passage widest_flight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                                    const FlyOptions& options);

/// A way that is known, or a wider one between the same ends where there is one that is wider by more than some
/// millimetres; `bound` says how sure that is.
[[nodiscard]] Passage widened_flight(const Survey& survey, const Measure& measure, Passage known,
                                     const FlyOptions& options);

}  // namespace roam::ways
