#pragma once
/// \file
/// Cracks: the gaps of a floor that bodies fall into, found from the floor itself. They give the lower end of the
/// interval.
///
/// docs/cracks.md has the definitions, the method and the measurements.

#include <algorithm>
#include <functional>
#include <vector>

#include "roam/crack.h"
#include "roam/survey.h"

namespace roam::cracks {

/// m: the smallest disc of a search. Tolerances for the error of stored triangles leave no room for less.
inline constexpr double smallest_disc = 0.02;

struct CrackOptions {
  double step = 0.3;         ///< m, > 0: ground lower by up to this is still within reach of a walker
  double knee = 0.3;         ///< m above the floor, >= 0.1: lower obstacles are no walls
  double smallest = 0.05;    ///< r_min, m, >= smallest_disc: gaps too narrow for a disc of this radius are ignored
  double support_max = 1.0;  ///< R_max, m, > smallest: a free disc this large is an open drop
  int threads = 0;           ///< 0: one per core
  bool operator==(const CrackOptions&) const = default;
};

/// The knee's height above the floor (m) for a body with that step. Lower obstacles are no walls.
[[nodiscard]] inline double knee_height(double step) { return std::max(CrackOptions{}.knee, step); }

/// A crack with the data that training needs.
struct FoundCrack : Crack {
  /// m, at least `radius`: a support disc that carries even the thinnest body. Such a body comes closer to walls, and
  /// so farther from floor if the gap runs along or obliquely into a wall. Exact to the spacing of a lattice, 3 cm for
  /// a radius of 5 cm.
  double support_radius = 0.0;
  /// m, the depth of a gap whose bottom is so near below the rim that a walker's support disc takes it for floor. No
  /// support disc bridges such a gap, and no step reaches its bottom. 0: the gap is deeper.
  double shallow_depth = 0.0;
  /// Places along the rim, sorted. Along a triangle's edge, each is at most 2 * smallest, or 1/65536 of the edge, from
  /// the next. A way of the feet that crosses the gap passes between or over them.
  std::vector<Vec3> rim;
};

/// All cracks, steps down and open drops along the reached floor, widest first. Open drops, whose radius is
/// support_max, come before all others. `is_reached` says whether a place of the floor can be reached on foot. It is
/// called from several threads, for places on the edges of floors and at the bottoms of gaps. `goes_on` receives the
/// fraction done, from one thread at a time; false ends the search with the cracks found so far.
///
/// The result has the same bits for any number of threads. Radii are exact to 0.02 mm if the survey is lossless. They
/// change by less than 0.2 mm if triangles are reordered, split, flipped or doubled.
[[nodiscard]] std::vector<FoundCrack> find_cracks(const Survey& survey, const CrackOptions& options,
                                                  const std::function<bool(const Vec3& foot)>& is_reached,
                                                  const std::function<bool(double)>& goes_on = {});

class RimEdges;
/// The same with the options and known edges of `edges`. Adds to them.
[[nodiscard]] std::vector<FoundCrack> find_cracks(const Survey& survey, RimEdges& edges,
                                                  const std::function<bool(const Vec3& foot)>& is_reached,
                                                  const std::function<bool(double)>& goes_on = {});

}  // namespace roam::cracks
