#pragma once
/// \file
/// Local frames on the Earth: the ellipsoid WGS 84, Earth-centred coordinates (EPSG:4978), and planes that touch it.

#include <glm/mat4x4.hpp>
#include <optional>
#include <string>

#include "roam/math.h"

namespace roam::reader {

/// A place on the ellipsoid.
struct Geodetic {
  double latitude = 0.0;   ///< radians
  double longitude = 0.0;  ///< radians
  double height = 0.0;     ///< metres above the ellipsoid
};

/// The place of a point with Earth-centred coordinates in metres, to a micrometre for heights of some kilometres.
[[nodiscard]] Geodetic geodetic(const Vec3& earth_centred);

/// The Earth-centred coordinates of a place.
[[nodiscard]] Vec3 earth_centred(const Geodetic& place);

/// The rotation with east, north and up at a place as the images of x, y and z.
[[nodiscard]] glm::dmat4 axes_at(const Geodetic& place);

/// A frame with x to the east, y to the north and z up. Its origin is on the ellipsoid.
class LocalFrame {
 public:
  /// At latitude and longitude in degrees.
  LocalFrame(double latitude, double longitude);
  /// The frame near a place. Its latitude and longitude are whole hundredths of a degree, so that it stays the same if
  /// the scene grows a little.
  [[nodiscard]] static LocalFrame near(const Geodetic& place);
  /// The frame of a spatial reference system "ENU:latitude,longitude"; unset for any other text.
  [[nodiscard]] static std::optional<LocalFrame> of(const std::string& srs);

  /// "ENU:46.2,8.1", as in metadata.xml of photogrammetry.
  [[nodiscard]] std::string srs() const;
  /// The transform that gives local coordinates in place of Earth-centred ones. Keeps nanometres.
  [[nodiscard]] glm::dmat4 local(const glm::dmat4& to_earth_centred) const;

 private:
  double latitude_, longitude_;  ///< degrees
  Vec3 origin_{0.0}, east_{0.0}, north_{0.0}, up_{0.0};
};

}  // namespace roam::reader
