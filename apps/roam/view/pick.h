#pragma once
/// \file
/// The surface behind a point of the picture.

#include <array>
#include <optional>
#include <osg/Matrixd>
#include <span>
#include <string>

#include "roam/space.h"

namespace roam::app {

/// A point on a surface of the collision data, in the scene's frame.
struct Pick {
  Vec3 point{0.0};
  Vec3 normal{0.0};    ///< of length 1, towards the eye
  std::string object;  ///< name; may be empty, and may be known later: see Space::object()
  TriangleId triangle = no_triangle;
};

/// Degrees between the surface and the level, [0, 90].
[[nodiscard]] double slope_degrees(const Pick& pick);

/// A camera at this moment. Its matrices are in the graph's frame: the scene minus `origin`.
struct CameraView {
  osg::Matrixd view, projection;
  Vec3 origin{0.0};
};

/// A line of sight in the scene's frame.
struct Sightline {
  Vec3 eye{0.0};
  Vec3 direction{1.0, 0.0, 0.0};  ///< of length 1
};

/// The line through a point of the picture; x and y in [-1, 1], right and up. None for a camera without a view.
[[nodiscard]] std::optional<Sightline> sightline(const CameraView& camera, double x, double y);

/// The point of the picture where a point of the scene is seen; none behind the eye.
[[nodiscard]] std::optional<std::array<double, 2>> seen_at(const CameraView& camera, const Vec3& point);

/// A length that from `eye` reaches beyond everything in the space, m.
[[nodiscard]] double sight(const Space& space, const Vec3& eye);

/// The first known surface along a line. Surfaces in the half spaces are not found.
[[nodiscard]] std::optional<Pick> seen_along(const Space& space, const Sightline& line,
                                             std::span<const HalfSpace> hidden = {});

/// The same behind a point of the picture.
[[nodiscard]] std::optional<Pick> pick(const Space& space, const CameraView& camera, double x, double y,
                                       std::span<const HalfSpace> hidden = {});

}  // namespace roam::app
