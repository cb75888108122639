#pragma once
/// \file
/// Rotations that make an axis of a file point up.

#include <glm/mat4x4.hpp>

#include "roam/scene_frame.h"

namespace roam::reader {

/// The rotation that turns an axis of glTF content to +z: (x, y, z) -> (x, -z, y) for y. For x, as in Cesium,
/// (x, y, z) -> (-z, y, x). Identity for other axes.
[[nodiscard]] inline glm::dmat4 upright_from(UpAxis up) {
  switch (up) {
    case UpAxis::y:
      return {1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 1};
    case UpAxis::x:
      return {0, 0, 1, 0, 0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 0, 1};
    default:
      return glm::dmat4(1.0);
  }
}

}  // namespace roam::reader
