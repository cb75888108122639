#include "stored_meshes.h"

#include "interrupt.h"
#include "loose_triangles.h"

namespace roam::app {
namespace {

constexpr std::size_t together = 16'384;

}  // namespace

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
        stop_if_interrupted();
        append(some, triangles);
        if (some.triangles.size() >= together) hand_out();
      },
      missing);
  hand_out();
}

}  // namespace roam::app
