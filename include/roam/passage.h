#pragma once
/// \file
/// Passage: the widest way between two positions, and the opening that limits it.
///
///     const roam::Passage p = roam::widest_way(survey, {0, 0, 1}, {40, 3, 1}, {.height = 1.9});
///     if (p.found) std::cout << "passable up to a radius of " << p.radius << " m\n";
///
/// The walking clearance of a position on a floor at height z is the largest radius of a free vertical capsule from
/// z + step to z + height. It must stay free when lowered to the floor, or to an obstacle at most a step high: such
/// obstacles are stepped over. Floor steeper than the slope limit is a wall. A body of height 0 is a sphere: it
/// must be free when it is lifted off the floor by at most the step and its radius, and when it is lowered again. The
/// flying clearance is the distance of the centre from everything. A body of radius r passes a way if the clearance is
/// at least r all along it.
///
/// A way leads in both directions: no step down is higher than `step`. probe() searches ways with higher ones, too.
///
/// The way is certified: sweeps with `radius` - 0.5 mm - 2 * Space::largest_error() meet nothing along it. `bound` and
/// `proven` say how wide another way could be. probe.h tests one size of a body, and names its obstacle.
///
/// Metres, up is +z. The same input gives the same bits on every machine and for any number of threads. Thread-safe.
/// Target roam::ways.

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "roam/math.h"
#include "roam/opening.h"
#include "roam/survey.h"
#include "roam/walker.h"

namespace roam {

struct PassageOptions {
  Mode mode = Mode::walk;    ///< walk or fly
  double height = 0.0;       ///< of a walking body, >= step: 1.8 for a person; 0: a sphere
  double step = 0.3;         ///< see WalkerSettings::step. A sphere climbs at most its radius.
  double widest = 1.0;       ///< > 0: largest radius searched for
  double narrowest = 0.05;   ///< > 0, < widest: smallest radius searched for
  double support_max = 1.0;  ///< > 0: a way does not cross cracks of the floor that a disc of this radius fits into
  double spacing = 0.2;      ///< >= 0.001: of the search grid. Openings narrower than 0.7 * it may be overlooked.
  /// Limit of the number of searched positions, which take 100 bytes each, or 60 when flying. Beyond it the best way so
  /// far is returned, with Passage::complete false.
  std::uint64_t most_places = 20'000'000;
  /// Called now and then with the number of searched positions. Returning false ends the search, as most_places does.
  std::function<bool(std::uint64_t)> progress = {};
};

struct Passage {
  bool found = false;  ///< there is a way for a radius of at least `narrowest`
  /// The largest radius that passes `way`; PassageOptions::widest if nothing limits it.
  double radius = 0.0;
  bool limited = false;  ///< `opening` limits `radius`
  /// A polyline from start to end: of the feet when walking, of the centre when flying. standing.h turns feet into
  /// centres, which follow() takes.
  std::vector<Vec3> way;
  double length = 0.0;  ///< of the way
  /// The limit, if limited. If no way was found: the opening of width 0 between the positions reached from both ends,
  /// unless they are far apart.
  std::optional<Opening> opening;
  /// Certified: no way exists for a larger radius than this. Infinite: unknown.
  double bound = 0.0;
  bool proven = false;       ///< `bound` is within 5 mm of `radius`
  bool complete = true;      ///< false: most_places, progress or 2^20 spacings ended the search
  std::uint64_t places = 0;  ///< positions searched
};

/// The widest way between two positions. Walking, they are of feet or eyes, and drop to the floor below; flying, of the
/// centre. Throws roam::Error if a position is not finite, an option is out of range, or no body of radius `narrowest`
/// fits at an end.
[[nodiscard]] Passage widest_way(const Survey& survey, const Vec3& from, const Vec3& to,
                                 const PassageOptions& options = {});

}  // namespace roam
