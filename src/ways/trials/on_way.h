#pragma once
/// \file
/// The position of a point along a way.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/geometric.hpp>
#include <limits>
#include <span>

#include "roam/math.h"
#include "roam/walker.h"

namespace roam::ways {

/// The place of a way that is nearest to a point.
struct OnWay {
  double along = 0.0;                                      ///< m along the way
  double apart = std::numeric_limits<double>::infinity();  ///< m from the point; infinite: the way has no places
  Vec3 place{0.0};
  Vec3 heading{0.0};  ///< unit, the way's direction there; 0 if it has none
};

/// When flying, the nearest place in space. On foot the way is that of the feet and the point lies on or in the floor:
/// the nearest place seen from above, on the same storey.
[[nodiscard]] OnWay nearest_on(std::span<const Vec3> way, const Vec3& point, Mode mode);

/// Calls f(place, run, along) for places of a way at most `apart` metres apart. `run` is the leg with the place,
/// `along` its distance from the way's start.
template <class F>
void for_each_station(std::span<const Vec3> way, double apart, const F& f) {
  double gone = 0.0;
  for (std::size_t i = 0; i + 1 < way.size(); ++i) {
    const Vec3 run = way[i + 1] - way[i];
    const double length = glm::length(run);
    const int parts = std::max(1, static_cast<int>(std::ceil(length / apart)));
    for (int k = 0; k < parts; ++k) {
      const double part = static_cast<double>(k) / parts;
      f(way[i] + part * run, run, gone + part * length);
    }
    gone += length;
  }
}

}  // namespace roam::ways
