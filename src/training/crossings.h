#pragma once
/// \file
/// The gaps of the floor that a way crosses.

#include <cstddef>
#include <span>
#include <vector>

#include "cracks/cracks.h"
#include "roam/survey.h"

namespace roam::training {

/// A crossing of a way and a gap.
struct Crossing {
  std::size_t crack = 0;  ///< its number
  double at = 0.0;        ///< m along the way
};

/// Finds the gaps that ways cross: a way crosses a gap if it leaves the floor beside a place of the gap's rim.
class Crossings {
 public:
  Crossings(const Survey& survey, std::span<const cracks::FoundCrack> cracks, double smallest);
  /// The gaps that `way` (of the feet) crosses, by number, each at its first crossing.
  [[nodiscard]] std::vector<Crossing> on(std::span<const Vec3> way) const;

 private:
  struct Place {
    Vec3 rim;
    std::size_t crack;
  };

  const Survey* survey_;
  double reach_;
  std::vector<Place> places_;  ///< sorted by x
};

/// Whether floor lies under feet at `foot`, or so near that they stand on it.
[[nodiscard]] bool stands_on_floor(const Survey& survey, const Vec3& foot);

/// The part of a way within `reach` (m, along it) of a place on it, at least two points.
[[nodiscard]] std::vector<Vec3> stretch(std::span<const Vec3> way, double at, double reach);

/// A short way of the feet straight over the middle of a gap, from floor to floor. Empty if one side has no floor.
[[nodiscard]] std::vector<Vec3> way_over(const Survey& survey, const Crack& crack, double run_up);

}  // namespace roam::training
