#pragma once
/// \file
/// What carries a body over gaps of the floor: their rims, and its foot (WalkerSettings::support_radius).
///
/// docs/walking.md, "The foot", has the reasons. All functions are const and safe to call from any number of threads,
/// as the space is; they allocate nothing. Lengths are metres, up is +z.

#include <cstdint>

#include "roam/space.h"

namespace roam {

class Walker;

/// The steepest contact with a rim that still carries, degrees. A crack of width w carries a sphere of radius r when
/// r >= w / (2 sin 70) = 0.532 w, and lets it through when r < w / 2; in between it is caught between the rims, from
/// where it can not step up.
/// At 1.25 m: carried from 0.665 m on, through below 0.625 m.
inline constexpr double rim_slope_degrees = 70.0;
inline constexpr double rim_cosine = 0.34202014332566873;
inline constexpr double rim_sine = 0.93969262078590838;
inline constexpr double rim_tangent = rim_sine / rim_cosine;

/// Floor that is at most so much higher or lower than the plane carries a foot, metres.
inline constexpr double carrying_band = 0.25;

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

/// The level disc that a foot is.
struct SupportDisc {
  double radius = 0.0;         ///< metres, > 0
  double slope_degrees = 0.0;  ///< what is at most so steep is floor
  /// Metres above the plane: what is as high is a wall, and a gap behind it does not count.
  double knee = 0.0;
  /// Metres above and below the plane in which there is floor.
  double band = carrying_band;
};

/// Whether there is room for a disc in a gap of the floor: a foot that is as large falls through.
enum class DiscRoom : std::uint8_t {
  none,
  unknown,  ///< none, if what is not known yet is solid
  free,
};

/// Whether a disc of that radius, seen from above, holds `axis` and is free of floor within the band about the plane;
/// its centre must be in sight from the axis at the height of the knee. Where it is not settled, because a disc fits to
/// within a millimetre or after more work than is sensible, the answer is that it is free.
[[nodiscard]] DiscRoom free_disc(const Space& space, const FloorPlane& plane, const SupportDisc& disc,
                                 const Vec3& axis);

/// Whether a foot carries.
enum class Carrying : std::uint8_t {
  no,
  unknown,  ///< yes, if what is not known yet is solid
  yes,
};

/// Whether a foot of that radius would carry the walker where it is, over the floor that it saw last: there is no floor
/// under its axis, and no room for a disc as large.
[[nodiscard]] Carrying carrying(const Walker& walker, double support_radius);

}  // namespace roam
