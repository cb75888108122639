#include <algorithm>
#include <cmath>
#include <cstdint>
#include <glm/geometric.hpp>

#include "math/floating_point.h"
#include "roam/wander.h"

namespace roam {
namespace {

constexpr double flat = 0.87;  // cosine of 30 degrees: what a floor may lean

/// The way the triangle faces, by the order of its corners: 1 up, -1 down, 0 neither.
int facing(const Triangle& t) {
  const Vec3 normal = glm::cross(t[1] - t[0], t[2] - t[0]);
  const double length = glm::length(normal);
  if (!(std::abs(normal.z) > flat * length)) return 0;
  return normal.z > 0.0 ? 1 : -1;
}

template <class Visit>
void each_triangle(std::span<const Mesh> meshes, const Visit& visit) {
  for (const Mesh& mesh : meshes) {
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) visit(mesh.triangle(i));
  }
}

}  // namespace

std::vector<Vec3> floor_samples(std::span<const Mesh> meshes, std::size_t count) {
  const DefaultFloatingPoint guard;
  std::uint64_t up = 0;
  std::uint64_t down = 0;
  each_triangle(meshes, [&](const Triangle& t) {
    const int way = facing(t);
    up += way > 0 ? 1 : 0;
    down += way < 0 ? 1 : 0;
  });
  // In a file that winds all its triangles the other way, floors face down.
  const bool upright = up > 0;
  const std::uint64_t all = upright ? up : down;
  std::vector<Vec3> samples;
  const std::uint64_t most = std::min<std::uint64_t>(count, all);
  if (most == 0) return samples;
  std::uint64_t n = 0;
  each_triangle(meshes, [&](const Triangle& t) {
    if (facing(t) != (upright ? 1 : -1)) return;
    // The first of each of `most` equal runs.
    if (n == 0 || n * most / all != (n - 1) * most / all) samples.push_back((t[0] + t[1] + t[2]) / 3.0);
    ++n;
  });
  return samples;
}

}  // namespace roam
