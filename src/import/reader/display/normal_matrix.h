#pragma once
/// \file
/// Transformation of normals with a surface that is moved, scaled, sheared or mirrored.

#include <glm/gtc/matrix_inverse.hpp>
#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>

namespace roam::reader {

/// The inverse transpose of the linear part of a transform; its columns are the images of the axes. A transform that
/// flattens the surface has no inverse: its normals are not finite, which counts as none.
inline glm::dmat3 normal_matrix(const glm::dmat3& linear) { return glm::inverseTranspose(linear); }

inline glm::vec3 transformed_normal(const glm::dmat3& matrix, const glm::dvec3& normal) {
  const glm::dvec3 n = matrix * normal;
  const double length = glm::length(n);
  // Normalised in double, because the inverse of a small scale is large.
  return length > 0.0 ? glm::vec3(n / length) : glm::vec3(0.0f);
}

}  // namespace roam::reader
