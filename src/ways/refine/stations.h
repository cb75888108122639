#pragma once
/// \file
/// Places along a way, each moved sideways to where it is widest.

#include <cstddef>
#include <vector>

#include "ways/lattice/lattice.h"

namespace roam::ways {

struct Station {
  Vec3 place{0.0};
  double free = 0.0;      ///< clearance
  bool polished = false;  ///< as wide as it goes
};
using Stations = std::vector<Station>;

/// The clearance of a place near `place` (walking: of the foot that comes down there); free 0 where there is none.
[[nodiscard]] Station station_at(const Survey& survey, const Measure& measure, const Vec3& place);

/// The widest place at most `reach` to the sides of `station`, seen along `ahead`: a pattern search (Hooke and Jeeves,
/// "Direct search solution of numerical and statistical problems", 1961) to a hundredth of a millimetre.
[[nodiscard]] Station widest_beside(const Survey& survey, const Measure& measure, const Station& station,
                                    const Vec3& ahead, double reach);

/// A way within one opening, taken to its ridge: stations 2 cm apart at their widest, and one at the narrowest place
/// between them. The first and the last place stay.
[[nodiscard]] Stations polish(const Survey& survey, const Measure& measure, const Stations& way, double spacing);

}  // namespace roam::ways
