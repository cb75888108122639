#pragma once
/// \file
/// The widest way through the air.

#include <functional>

#include "roam/passage.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

struct FlyOptions {
  double spacing = 0.2;                             ///< m, as PassageOptions::spacing
  std::uint64_t most_places = 4'000'000;            ///< most cubes of air, 60 bytes each
  std::function<bool(std::uint64_t)> goes_on = {};  ///< receives their number; false ends the search
};

/// As roam::widest_way, between two places where a sphere of measure.narrowest is free. `bound` is infinite if nothing
/// is known.
[[nodiscard]] Passage widest_flight(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                                    const FlyOptions& options);

/// `known`, or a way between the same ends that is wider by more than some millimetres. `bound` limits how much wider
/// any way can be.
[[nodiscard]] Passage widened_flight(const Survey& survey, const Measure& measure, Passage known,
                                     const FlyOptions& options);

}  // namespace roam::ways
