#pragma once
/// \file
/// How wide a body may be that gets from one place to another, and the opening that decides.
///
///     const roam::Passage p = roam::widest_way(survey, {0, 0, 1}, {40, 3, 1}, {.height = 1.9});
///     if (p.found) std::cout << "passable up to a radius of " << p.radius << " m\n";
///
/// *Walking clearance* of a place of the floor at height z is the largest r for which a vertical capsule of radius r
/// from the knee, z + step, to z + height is free. Nothing below the knee is a wall: kerbs, stairs and sills are walked
/// over. Floor steeper than the slope limit is a wall. A body of height 0 is the sphere of the paper: it fits where it
/// is free when it is lifted off the floor by something between nothing and the step, but at most its radius. *Flying
/// clearance* is the distance of the centre from everything. A way lets a body of radius r pass when its clearance is
/// at least r everywhere; a body "cannot get through" when no way does, not when some walker stopped.
///
/// The way that is answered is certified: sweeps along it with `radius` less 0.5 mm meet nothing. That nothing wider
/// exists is known only as far as Passage::proven says. probe.h says of a body of one size whether it gets through, and
/// what stops it.
///
/// Lengths are metres, up is +z. Same input, same bits, on every machine and for any number of threads.
/// Library target roam::ways.

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
  Mode mode = Mode::walk;  ///< walk or fly
  /// Of the body on foot: say 1.8 for a person (as WalkerSettings{} is); 0: a sphere, 2 * radius high. At least `step`
  /// where it is not 0.
  double height = 0.0;
  double step = 0.3;         ///< what walking climbs, see WalkerSettings::step. A sphere climbs at most its radius.
  double widest = 1.0;       ///< > 0: no larger radius is looked for, and a way where it fits is "not limited"
  double narrowest = 0.05;   ///< > 0, < widest: ways for no larger radius than this are not looked for
  double support_max = 1.0;  ///< > 0: where a disc of this radius fits into a gap of the floor, no way leads over it
  double spacing = 0.2;      ///< of the places that are looked at, > 0. Openings under 0.7 of it may be overlooked.
  /// Places looked at, at most (100 bytes each on foot; flying they are cubes of air, 60 bytes each); then what was
  /// found so far is answered and Passage::complete is false.
  std::uint64_t most_places = 20'000'000;
  /// Called now and then with the number of places looked at. Returning false ends the search: as most_places.
  std::function<bool(std::uint64_t)> progress = {};
};

struct Passage {
  bool found = false;  ///< there is a way for `narrowest` at least
  /// The largest radius that passes all along `way`; PassageOptions::widest where nothing limits it. Not found: 0, or
  /// the largest that was seen to come nearest.
  double radius = 0.0;
  bool limited = false;  ///< an opening decides `radius`; false: nothing as narrow as `widest` is on the way
  /// Of the feet (walk: on the floor) or the centre (fly), from the start to the end, straight between points. On foot
  /// not for follow() as it is, which takes places of the centre: see standing() in standing.h.
  std::vector<Vec3> way;
  double length = 0.0;  ///< of the way
  /// What decides, when limited. When not found: where what is reached from the start comes nearest to what is reached
  /// from the end, of width 0 and across what parts them; none where they are far apart. When one of the two has been
  /// looked at whole, only so much of the other is.
  std::optional<Opening> opening;
  /// No way for a radius larger than `bound` exists: certified, by what fits at the ends and under the height, and in
  /// the air by cubes that nobody of that radius fits into: 4 mm more than `radius`, or 16, 64, ... where that could
  /// not be said. Infinite where nothing is known.
  double bound = 0.0;
  bool proven = false;       ///< `bound` is within 5 mm of `radius`
  bool complete = true;      ///< false: most_places or progress ended it early
  std::uint64_t places = 0;  ///< looked at
};

/// The widest way between two places of a scene: of the feet or the eyes of a person, taken down to the floor below on
/// foot, however deep; of the centre when flying. Throws roam::Error for places that are not finite, options
/// out of range and, naming the place, for one where no body of `narrowest` can be.
[[nodiscard]] Passage widest_way(const Survey& survey, const Vec3& from, const Vec3& to,
                                 const PassageOptions& options = {});

}  // namespace roam
