#pragma once
/// \file
/// What a surveyor would measure along a way: the room beside the body, floor and ceiling.

#include <functional>
#include <optional>
#include <vector>

#include "draw/way.h"
#include "roam/space.h"

namespace roam::draw {

/// A place at which was measured.
struct Station {
  Vec3 centre{0.0};               ///< of the body, metres
  double height = 0.0;            ///< of the body on the way to the next station, metres
  double along = 0.0;             ///< metres, as WayPoint::along
  bool jump = false;              ///< no way leads here from the station before
  Vec3 heading{0.0};              ///< level, unit length; 0 where the way leads straight up or down
  Vec3 across{0.0};               ///< level, to the left, unit length; 0 where nothing was measured beside
  double left = 0.0;              ///< metres that are free beside the body along `across`, at most the survey's reach
  double right = 0.0;             ///< and the other way
  std::optional<double> floor;    ///< height in the scene of what is right below the centre, metres
  std::optional<double> ceiling;  ///< the same above
};

/// The narrowest place of a walk, see measure::NarrowPlace.
struct Narrowest {
  Vec3 centre{0.0};
  double height = 0.0;
  double along = 0.0;  ///< metres, as WayPoint::along
  double width = 0.0;  ///< metres
  Vec3 left{0.0};      ///< the ends of the width
  Vec3 right{0.0};
};

struct Survey {
  double reach = 0.0;  ///< metres beside the body that were looked at
  std::vector<Station> stations;
  std::optional<Narrowest> narrowest;  ///< survey() leaves it out
};

/// Is called before each place that is looked at: `reach` metres around it should be known then.
using Arrive = std::function<void(const Vec3& place, double reach)>;

/// Measures at every corner of the way, and in between at least every half radius, but at some 10,000 places at most.
/// Where the way is not true enough for the body to fit on it, at its corners alone. On foot the room beside is that
/// above the step height: what is lower is walked onto.
[[nodiscard]] Survey survey(const Space& space, const Way& way, const WalkerSettings& settings, Mode mode,
                            const Arrive& arrive = {});

}  // namespace roam::draw
