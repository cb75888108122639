#pragma once
/// \file
/// The surface behind a point of the picture.

#include <optional>
#include <osg/Matrixd>
#include <span>
#include <string>

#include "graphics/shading.h"
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

/// The first known surface behind a point of the picture; x and y in [-1, 1], right and up. `view` and `projection` are
/// the camera's matrices, in the graph's frame: the scene minus `origin`. Surfaces that the planes hide are not found.
[[nodiscard]] std::optional<Pick> pick(const Space& space, const osg::Matrixd& view, const osg::Matrixd& projection,
                                       const Vec3& origin, double x, double y,
                                       std::span<const graphics::SectionPlane> hidden = {});

}  // namespace roam::app
