#include "generate/scene.h"

#include <fmt/format.h>

#include <utility>

#include "math/floating_point.h"
#include "roam/error.h"

namespace roam::generate {

Scene::Scene(std::shared_ptr<const Plan> plan) : plan_(std::move(plan)) {}
std::uint64_t Scene::triangles() const { return plan_->made.triangles; }
std::uint64_t Scene::vertices() const { return plan_->made.vertices; }
std::uint64_t Scene::objects() const { return plan_->made.objects; }
const Box& Scene::bounds() const { return plan_->bounds; }

void Scene::stream(const Sink& sink, const Progress& progress) const {
  const DefaultFloatingPoint guard;
  std::uint64_t done = 0;
  Mesh mesh;
  for (std::uint64_t i = 0; i < plan_->parts; ++i) {
    const Part part = plan_->part(i);
    const auto meshes = slice(part);
    for (std::size_t k = 0; k < meshes.size(); ++k) {
      if (meshes[k].empty()) continue;
      mesh.name = k == 0 ? part.name : fmt::format("{}/{}", part.name, k + 1);
      mesh.vertices.clear();
      mesh.triangles.clear();
      emit(part, meshes[k], mesh);
      sink(mesh);
      done += mesh.triangles.size();
      if (progress && !progress(done)) throw Cancelled();
    }
  }
}

std::vector<Mesh> collect(const Scene& scene, const Progress& progress) {
  std::vector<Mesh> meshes;
  meshes.reserve(scene.objects());
  scene.stream([&](const Mesh& mesh) { meshes.push_back(mesh); }, progress);
  return meshes;
}

Count count(const Scene::Plan& plan) {
  Count sum;
  for (std::uint64_t i = 0; i < plan.parts; ++i) {
    const Part part = plan.part(i);
    for (const auto& slices : slice(part)) {
      const Count c = count(part, slices);
      sum.triangles += c.triangles;
      sum.vertices += c.vertices;
      sum.objects += c.triangles > 0;
    }
  }
  return sum;
}

Scene make_scene(Scene::Plan plan) {
  plan.made = count(plan);
  return Scene(std::make_shared<const Scene::Plan>(std::move(plan)));
}

void check_options(const char* what, std::uint64_t triangles, const Vec3& origin) {
  if (triangles < least_triangles || triangles > most_triangles) {
    throw Error(fmt::format("A {} of {} triangles cannot be made: ask for {} to {}.", what, triangles, least_triangles,
                            most_triangles));
  }
  for (int k = 0; k < 3; ++k) {
    if (!(origin[k] >= -origin_limit && origin[k] <= origin_limit)) {
      throw Error(fmt::format("The origin of the {} has {} = {}: each coordinate must lie within {} m of 0.", what,
                              "xyz"[k], origin[k], origin_limit));
    }
  }
}

}  // namespace roam::generate
