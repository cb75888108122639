#include "scenes/solid.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

namespace roam::app {

double winding_number(std::span<const Mesh> meshes, const Vec3& place) {
  double half_angles = 0.0;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Triangle t = mesh.triangle(i);
      const Vec3 a = t[0] - place, b = t[1] - place, c = t[2] - place;
      const double la = glm::length(a), lb = glm::length(b), lc = glm::length(c);
      const double volume = glm::dot(a, glm::cross(b, c));
      const double rest = la * lb * lc + glm::dot(a, b) * lc + glm::dot(b, c) * la + glm::dot(c, a) * lb;
      half_angles += std::atan2(volume, rest);
    }
  }
  return half_angles / (2.0 * std::numbers::pi);
}

}  // namespace roam::app
