#include "store/meshes.h"

#include <cstdint>

namespace roam::store {
namespace {

constexpr std::size_t together = 16'384;

}  // namespace

void append(Mesh& mesh, std::span<const Triangle> triangles) {
  for (const Triangle& triangle : triangles) {
    const auto first = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.insert(mesh.vertices.end(), triangle.begin(), triangle.end());
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
}

void each_mesh(const Store& store, const Box& box, const std::function<void(const Mesh&)>& take,
               const std::function<void(const std::string&)>& missing) {
  Mesh some;
  const auto hand_out = [&] {
    if (!some.triangles.empty()) take(some);
    some.vertices.clear();
    some.triangles.clear();
  };
  store.for_each_triangle(
      box,
      [&](std::span<const Triangle> triangles, std::span<const TriangleId>) {
        append(some, triangles);
        if (some.triangles.size() >= together) hand_out();
      },
      missing);
  hand_out();
}

}  // namespace roam::store
