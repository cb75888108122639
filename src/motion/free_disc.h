#pragma once
/// \file
/// Whether a level disc fits into a gap of the floor: what a foot that is as large would fall through.

#include <cstdint>

#include "roam/space.h"

namespace roam::walking {

/// A plane that the floor around goes on in.
struct FloorPlane {
  Vec3 point{0.0};
  Vec3 normal{0.0, 0.0, 1.0};  ///< z > 0

  /// z of the plane over a place, metres.
  [[nodiscard]] double level(const Vec3& place) const {
    return point.z - (normal.x * (place.x - point.x) + normal.y * (place.y - point.y)) / normal.z;
  }

  friend bool operator==(const FloorPlane&, const FloorPlane&) = default;
};

/// Floor that is at most so much higher or lower than the plane carries, metres.
constexpr double carrying_band = 0.25;

struct Foot {
  double radius = 0.0;         ///< of the disc, metres, > 0
  double slope_degrees = 0.0;  ///< what is at most so steep is floor
  /// Metres above the plane: what is as high is a wall, and a gap behind it does not count.
  double knee = 0.0;
  /// Metres above and below the plane in which there is floor.
  double band = carrying_band;
};

/// Whether there is room for a disc.
enum class DiscRoom : std::uint8_t {
  none,
  unknown,  ///< none, if what is not known yet is solid
  free,
};

/// Where a disc was found: the next one asked for is likely to be there too.
struct DiscFound {
  bool found = false;
  double x = 0.0, y = 0.0;  ///< of its centre, metres
};

/// Whether a disc of the foot's radius, seen from above, holds `axis` and is free of floor within the band about the
/// plane; its centre must be in sight from the axis at the height of the knee. Where it is not settled, because a disc
/// fits to within a millimetre or after more work than is sensible, the answer is that it is free. `last` is where one
/// was found before, if anywhere, and becomes where one is now: a body that hardly moves is answered by two questions.
[[nodiscard]] DiscRoom free_disc(const Space& space, const FloorPlane& plane, const Foot& foot, const Vec3& axis,
                                 DiscFound* last = nullptr);

}  // namespace roam::walking
