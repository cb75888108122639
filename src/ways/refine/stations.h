#pragma once
/// \file
/// Places along a way, each moved sideways to its widest.

#include <cstddef>
#include <vector>

#include "ways/lattice/lattice.h"

namespace roam::ways {

/// Metres between stations of a polished way.
inline constexpr double station_spacing = 0.02;

struct Station {
  Vec3 place{0.0};
  double free = 0.0;      ///< clearance
  bool polished = false;  ///< as wide as possible
};
using Stations = std::vector<Station>;

/// The clearance at a place near `place` (on foot: where the foot comes down); 0 if no body fits there.
[[nodiscard]] Station station_at(const Survey& survey, const Measure& measure, const Vec3& place);

/// The widest place at most `reach` to the sides of `station`, for a body that moves along `ahead`. A pattern search to
/// a hundredth of a millimetre: Hooke and Jeeves, "Direct search solution of numerical and statistical problems", 1961.
[[nodiscard]] Station widest_beside(const Survey& survey, const Measure& measure, const Station& station,
                                    const Vec3& ahead, double reach);

/// Moves a way within one opening to its ridge: stations 2 cm apart at their widest, and one at the narrowest place
/// between them. The first and the last place stay.
[[nodiscard]] Stations polish(const Survey& survey, const Measure& measure, const Stations& way, double spacing);

}  // namespace roam::ways
