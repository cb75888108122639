#pragma once
/// \file
/// Which gaps of the floor a way goes over.

#include <cstddef>
#include <span>
#include <vector>

#include "cracks/cracks.h"
#include "roam/survey.h"

namespace roam::training {

/// A way comes to a gap.
struct Crossing {
  std::size_t crack = 0;  ///< its number
  double at = 0.0;        ///< m along the way
};

/// The gaps over which ways are led: where a way leaves the floor beside a place of a gap's rim, it goes over that gap.
class Crossings {
 public:
  Crossings(const Survey& survey, std::span<const cracks::FoundCrack> cracks, double smallest);
  /// The gaps that `way` (of the feet) goes over, in their order, each where it is come to first.
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

/// Whether floor lies under a foot, or so near beside it that the foot stands on it.
[[nodiscard]] bool stands_on_floor(const Survey& survey, const Vec3& foot);

/// The part of a way within `reach` (m, along it) of a place on it, at least two points.
[[nodiscard]] std::vector<Vec3> stretch(std::span<const Vec3> way, double at, double reach);

/// A short way straight over the middle of a gap, from floor to floor, of the feet; empty
/// where there is no floor on both sides.
[[nodiscard]] std::vector<Vec3> way_over(const Survey& survey, const Crack& crack, double run_up);

}  // namespace roam::training
