#include "measure/edges.h"

#include <algorithm>
#include <array>
#include <vector>

namespace roam::measure {
namespace {

struct Corner {
  Vec3 position{0.0};
  std::uint64_t place = 0;  ///< three times the triangle's number, plus the corner's
};

bool before(const Vec3& a, const Vec3& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

}  // namespace

Edges count_edges(std::span<const Mesh> meshes) {
  std::size_t triangles = 0;
  for (const Mesh& mesh : meshes) triangles += mesh.triangles.size();
  std::vector<Corner> corners;
  corners.reserve(3 * triangles);
  for (const Mesh& mesh : meshes) {
    for (const auto& triangle : mesh.triangles) {
      for (const std::uint32_t vertex : triangle) corners.push_back({mesh.vertices[vertex], corners.size()});
    }
  }
  std::sort(corners.begin(), corners.end(),
            [](const Corner& a, const Corner& b) { return before(a.position, b.position); });
  // The number of each corner's position.
  std::vector<std::uint64_t> position(corners.size());
  for (std::size_t i = 0, number = 0; i < corners.size(); ++i) {
    if (i > 0 && before(corners[i - 1].position, corners[i].position)) number = i;
    position[corners[i].place] = number;
  }
  std::vector<std::array<std::uint64_t, 2>> edges;
  edges.reserve(3 * triangles);
  for (std::size_t i = 0; i < position.size(); i += 3) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint64_t a = position[i + k], b = position[i + (k + 1) % 3];
      if (a != b) edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::sort(edges.begin(), edges.end());
  Edges found;
  for (std::size_t i = 0, next = 0; i < edges.size(); i = next) {
    while (next < edges.size() && edges[next] == edges[i]) ++next;
    ++found.all;
    if (next - i > 1) continue;
    ++found.open;
    if (!found.hole) found.hole = 0.5 * (corners[edges[i][0]].position + corners[edges[i][1]].position);
  }
  return found;
}

}  // namespace roam::measure
