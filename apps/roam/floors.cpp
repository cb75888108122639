#include "floors.h"

#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

namespace roam::app {
namespace {

constexpr double flat = 0.87;  // cosine of 30 degrees: what a floor may lean

bool lies_flat(const Triangle& t) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(normal);
  return length > 0.0 && std::abs(normal.z) > flat * length;
}

/// Calls visit(triangle, n) for the n-th flat triangle.
template <class Visit>
std::uint64_t each_flat(std::span<const Mesh> meshes, const Visit& visit) {
  std::uint64_t n = 0;
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const Triangle t = mesh.triangle(i);
      if (lies_flat(t)) visit(t, n++);
    }
  }
  return n;
}

}  // namespace

std::vector<Vec3> floor_samples(std::span<const Mesh> meshes, std::size_t count) {
  const std::uint64_t all = each_flat(meshes, [](const Triangle&, std::uint64_t) {});
  std::vector<Vec3> samples;
  samples.reserve(count);
  each_flat(meshes, [&](const Triangle& t, std::uint64_t n) {
    // The first of each of `count` equal runs.
    if (n == 0 || n * count / all != (n - 1) * count / all) samples.push_back((t[0] + t[1] + t[2]) / 3.0);
  });
  return samples;
}

}  // namespace roam::app
