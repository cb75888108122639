#pragma once
/// \file
/// The lower end: the gaps of a floor that bodies fall into, found from the floor itself.
///
/// docs/cracks.md has the definitions, the method and what was measured.

#include <algorithm>
#include <functional>
#include <vector>

#include "roam/crack.h"
#include "roam/survey.h"

namespace roam::cracks {

struct CrackOptions {
  double step = 0.3;         ///< m, > 0: ground so much lower still counts as walked on
  double knee = 0.3;         ///< m above the floor, >= 0.1: what is lower is no wall
  double smallest = 0.05;    ///< r_min, m, >= 0.02: gaps that a disc of this radius does not enter are not looked for
  double support_max = 1.0;  ///< R_max, m, > smallest: a free disc as large is an open drop
  int threads = 0;           ///< 0: one per core
  bool operator==(const CrackOptions&) const = default;
};

/// Above the floor (m), of who steps so high: what is lower is no wall.
[[nodiscard]] inline double knee_height(double step) { return std::max(CrackOptions{}.knee, step); }

/// A gap, and where one comes to it.
struct FoundCrack : Crack {
  /// m, at least `radius`: a foot that carries even the thinnest body, which comes closer to walls and so, where a gap
  /// runs along or obliquely into a wall, farther from floor. To the spacing of a lattice, 3 cm for a radius of 5 cm.
  double foot = 0.0;
  /// m, of its bottom where that is so near below the rim that a walker's foot takes it for floor: it is no gap that a
  /// foot carries over, nor does a step reach it. 0: it is deeper.
  double shallow_depth = 0.0;
  /// Places of the floor's rim along it, each at most 2 * smallest from the next along a triangle's edge, sorted. A way
  /// of the feet that goes over the gap passes between or over them.
  std::vector<Vec3> rim;
};

/// All cracks, steps down and open drops along the floor that is reached, widest crack first (open drops, whose radius
/// is support_max, before all others). `is_reached` says whether a place of the floor belongs to what can be walked on;
/// it is asked about places on the edges of floors and at the bottoms of gaps, from several threads. `goes_on` is
/// asked with the fraction done, by one thread at a time; false ends it with what was found.
///
/// The same bits for any number of threads. Radii are exact to 0.02 mm where the survey is lossless, and change by less
/// than 0.2 mm where triangles come in another order, split, flipped or doubled.
[[nodiscard]] std::vector<FoundCrack> find_cracks(const Survey& survey, const CrackOptions& options,
                                                  const std::function<bool(const Vec3& foot)>& is_reached,
                                                  const std::function<bool(double)>& goes_on = {});

class RimEdges;
/// The same of what `edges` knows by now, by its options; it knows more then.
[[nodiscard]] std::vector<FoundCrack> find_cracks(const Survey& survey, RimEdges& edges,
                                                  const std::function<bool(const Vec3& foot)>& is_reached,
                                                  const std::function<bool(double)>& goes_on = {});

}  // namespace roam::cracks
