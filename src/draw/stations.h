#pragma once
/// \file
/// Measurements along a way: the room beside the body, floor and ceiling.

#include <functional>
#include <optional>
#include <vector>

#include "draw/way.h"
#include "measure/along.h"
#include "roam/space.h"

namespace roam::draw {

/// A measured place.
struct Station {
  Vec3 centre{0.0};               ///< of the body, metres
  double height = 0.0;            ///< of the body on the way to the next station, metres
  double along = 0.0;             ///< metres, as WayPoint::along
  bool jump = false;              ///< no way leads here from the station before
  Vec3 heading{0.0};              ///< level, unit length; 0 where the way leads straight up or down
  Vec3 across{0.0};               ///< level, to the left, unit length; 0 without a measurement
  double left = 0.0;              ///< free metres beside the body along `across`, at most the survey's reach
  double right = 0.0;             ///< the same to the other side
  std::optional<double> floor;    ///< height of the surface straight below the centre, metres
  std::optional<double> ceiling;  ///< the same above
};

struct RoomSurvey {
  double reach = 0.0;  ///< measured metres beside the body, at most
  std::vector<Station> stations;
  /// Its `along` is as WayPoint::along. Set by the caller; survey() leaves it empty.
  std::optional<measure::NarrowPlace> narrowest;
};

/// Called before each measurement: `reach` metres around the place should be loaded then.
using Arrive = std::function<void(const Vec3& place, double reach)>;

/// Measures at every corner of the way, and in between at least every half radius, at some 10,000 places at most. If
/// the way is too imprecise for the body to fit on it, measures only at its corners. On foot the room beside the body
/// counts above the step height, because the body walks over lower obstacles.
[[nodiscard]] RoomSurvey survey(const Space& space, const Way& way, const WalkerSettings& settings, Mode mode,
                                const Arrive& arrive = {});

}  // namespace roam::draw
