#pragma once
/// \file
/// The paper's procedure: paths are roamed in turn. If the viewpoint cannot enter, the radius goes down; if it flies
/// off the scene, it goes up (Xie & Niu 2020, figure 6).
///
/// The paper leaves some rules open; here they are these. The largest radius that fell and the smallest that was
/// blocked are kept, and the next one lies half way between them. After a change of the radius, earlier paths are
/// roamed again. It ends when all paths are passed with one radius, or when none can be.

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "roam/train.h"

namespace roam::training {

struct PaperOptions {
  double start = 0.3;       ///< m, the first radius
  double smallest = 0.05;   ///< m, and
  double largest = 1.0;     ///< m: no other radius is tried
  double precision = 0.01;  ///< m: no radius is tried between bounds that are this near to each other
  int most_trials = 20;     ///< of each path
};

struct PaperRun : PaperResult {
  std::vector<Trial> trials;  ///< all, in their order
};

/// Adjusts the radius over `paths` paths. `roam` sends a body along one of them; none ends the procedure.
[[nodiscard]] PaperRun adjust_radius(std::size_t paths, const PaperOptions& options,
                                     const std::function<std::optional<Trial>(std::size_t path, double radius)>& roam);

}  // namespace roam::training
