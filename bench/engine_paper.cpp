// The method of Xie and Niu (2020) as printed: each triangle that the box of the swept sphere may touch goes through
// equations (1) to (6). Objects outside that box are skipped whole, as a scene graph would do. There is no scene graph
// and no intersector around it here, which favours it.

#include <algorithm>
#include <memory>

#include "engine.h"
#include "memory.h"
#include "paper_equations.h"

namespace roam::bench {
namespace {

struct Object {
  Box box;
  std::vector<Triangle> triangles;
};

bool beyond(const Query& query, const Box& box) {
  for (int k = 0; k < 3; ++k) {
    const double a = query.from[k];
    const double b = query.from[k] + query.motion[k];
    if (box.upper[k] < std::min(a, b) - query.body.radius || box.lower[k] > std::max(a, b) + query.body.radius)
      return true;
  }
  return false;
}

}  // namespace

Engine make_paper(const Scene& scene) {
  Engine engine{.name = "the paper's method", .used = "equations (1)-(6) and box test, doubles", .spheres_only = true};
  const auto objects = std::make_shared<std::vector<Object>>();
  const std::size_t before = allocated_bytes();
  engine.build_one = seconds([&] {
    for (const Mesh& mesh : scene.meshes) {
      Object& object = objects->emplace_back();
      object.triangles.reserve(mesh.triangles.size());
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
        object.triangles.push_back(mesh.triangle(i));
        for (const Vec3& corner : object.triangles.back()) object.box.include(corner);
      }
    }
  });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([objects](const Query& query) {
    Answer first;
    for (const Object& object : *objects) {
      if (beyond(query, object.box)) continue;
      for (const Triangle& triangle : object.triangles) {
        const auto collision = paper::collide(query.body.radius, query.from, query.motion, triangle);
        if (collision && collision->time <= first.time) first = {true, collision->time};
      }
    }
    return first;
  });
  return engine;
}

}  // namespace roam::bench
