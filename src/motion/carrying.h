#pragma once
/// \file
/// Support of a body over cracks of the floor: by their rims, or by its support disc (WalkerSettings::support_radius).
/// The rooms above the core that look for cracks include this header, too; it is not installed.
///
/// Lengths are metres, angles degrees. All functions are thread-safe and allocate nothing. docs/walking.md, "The
/// support disc".

#include <cstdint>

#include "roam/space.h"

namespace roam {

class Walker;

/// The steepest contact with a rim that still carries; docs/cracks.md, "Which body crosses".
inline constexpr double rim_slope_degrees = 70.0;
inline constexpr double rim_cosine = 0.34202014332566873;
inline constexpr double rim_sine = 0.93969262078590838;
inline constexpr double rim_tangent = rim_sine / rim_cosine;
inline constexpr double carrying_band = 0.25;  ///< floor at most so far above or below the plane carries the disc

struct FloorPlane {
  Vec3 point{0.0};
  Vec3 normal{0.0, 0.0, 1.0};  ///< z > 0
  /// z of the plane above or below `place`.
  [[nodiscard]] double level(const Vec3& place) const {
    return point.z - (normal.x * (place.x - point.x) + normal.y * (place.y - point.y)) / normal.z;
  }
  friend bool operator==(const FloorPlane&, const FloorPlane&) = default;
};

struct SupportDisc {
  double radius = 0.0;          ///< (0, Space::reach_limit]
  double slope_degrees = 0.0;   ///< [0, 89]: the steepest floor
  double knee = 0.0;            ///< height above the plane: cracks behind walls so high do not count
  double band = carrying_band;  ///< floor is at most this much above or below the plane
};

enum class Carrying : std::uint8_t {
  no,
  unknown,  ///< yes, if unknown space is solid
  yes,
};

/// Whether the floor carries a disc about `axis`: `no` if some level disc of that radius, seen from above, contains
/// `axis` and is free of floor within the band about the plane; its centre must be in sight from the axis at the height
/// of the knee. Returns `no` also where it cannot decide: a disc fits or fails by less than a millimetre, or the search
/// takes too much work. Throws roam::Error as Space::floor_clearance() does.
[[nodiscard]] Carrying carrying(const Space& space, const FloorPlane& plane, const SupportDisc& disc, const Vec3& axis);

/// Whether a disc of that radius would carry the walker where it is, over the floor that it saw last: there is no floor
/// under its axis and no room for the disc. A radius below the body's counts as the body's. `no` if it saw no floor: a
/// walker without a support disc looks for none.
[[nodiscard]] Carrying carrying(const Walker& walker, double support_radius);

}  // namespace roam
