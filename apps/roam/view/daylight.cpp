#include "view/daylight.h"

#include <cmath>
#include <numbers>

#include "view/pick.h"
#include "view/surroundings.h"

namespace roam::app {

double open_sky(const Space& space, const Vec3& eye) {
  constexpr int around = 8;
  constexpr double steep = 0.96, flat = 0.61;  // radians above the horizon, in turns: 55 and 35 degrees
  const double reach = sight(space, eye);
  int open = 0, known = 0;
  const auto look = [&](const Vec3& direction) {
    const FirstImpact hit = space.first_impact({0.0, 0.0}, eye, reach * direction);
    open += hit.hit ? 0 : 1;
    known += hit.unknown ? 0 : 1;
  };
  look({0.0, 0.0, 1.0});
  for (int i = 0; i < around; ++i) look(gaze(2.0 * std::numbers::pi * i / around, i % 2 == 0 ? steep : flat));
  return known == 0 ? 1.0 : static_cast<double>(open) / known;
}

double Daylight::follow(double sky, double seconds) {
  constexpr double time = 0.5;  // s
  if (share_ < 0.0) {
    share_ = sky;
  } else {
    share_ += (1.0 - std::exp(-seconds / time)) * (sky - share_);
  }
  return share_;
}

}  // namespace roam::app
