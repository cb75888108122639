#pragma once
/// \file
/// The lower end: the gaps of a floor that bodies fall into, found from the floor itself.

#include <functional>
#include <span>
#include <vector>

#include "roam/survey.h"
#include "roam/train.h"

namespace roam::training {

struct CrackOptions {
  double step = 0.3;         ///< ground so much lower still counts as walked on
  double knee = 0.3;         ///< m above the floor: what is lower is no wall
  double smallest = 0.05;    ///< r_min: gaps that a disc of this radius does not enter are not looked for
  double support_max = 1.0;  ///< R_max: a free disc as large is an open drop
  int threads = 0;
};

/// All cracks, steps down and open drops along the floor that `reached` (of the feet) stand on, widest crack first.
/// `is_reached` says whether a place of the floor belongs to what can be walked on; it is asked from several threads.
/// `goes_on` as TrainOptions::progress, with the fraction done; false ends it with what was found.
[[nodiscard]] std::vector<Crack> find_cracks(const Survey& survey, const CrackOptions& options,
                                             const std::function<bool(const Vec3& foot)>& is_reached,
                                             const std::function<bool(double)>& goes_on = {});

}  // namespace roam::training
