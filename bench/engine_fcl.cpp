// FCL as Debian builds it: doubles. Its own continuous collision is conservative advancement over the mesh. Here its
// distance query does the same with longer steps, as a translation allows: each is as long as the last distance, until
// the body is within `touch` of the mesh.

#include <fcl/config.h>
#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/geometry/shape/capsule.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/math/bv/OBBRSS.h>
#include <fcl/narrowphase/distance.h>

#include <glm/geometric.hpp>
#include <memory>

#include "engine.h"
#include "memory.h"

namespace roam::bench {
namespace {

using Model = fcl::BVHModel<fcl::OBBRSSd>;

constexpr double touch = 1e-4;       // m: nearer than this is a hit
constexpr int most_distances = 200;  // at grazing contacts the steps become as short as the gap

std::shared_ptr<Model> model_of(const Scene& scene) {
  auto model = std::make_shared<Model>();
  model->beginModel(static_cast<int>(scene.triangles()));
  for (const Mesh& mesh : scene.meshes) {
    std::vector<fcl::Vector3d> vertices;
    vertices.reserve(mesh.vertices.size());
    for (const Vec3& v : mesh.vertices) vertices.emplace_back(v.x, v.y, v.z);
    std::vector<fcl::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    model->addSubModel(vertices, triangles);
  }
  model->endModel();
  model->computeLocalAABB();
  return model;
}

template <class Shape>
Answer advance(const Model& model, const Shape& shape, const Query& query) {
  const double length = glm::length(query.motion);
  fcl::DistanceRequestd request;
  request.enable_signed_distance = false;
  double time = 0.0;
  for (int i = 0; i < most_distances; ++i) {
    const Vec3 place = query.from + time * query.motion;
    fcl::Transform3d at = fcl::Transform3d::Identity();
    at.translation() = fcl::Vector3d(place.x, place.y, place.z);
    fcl::DistanceResultd result;
    const double free = fcl::distance(&shape, at, &model, fcl::Transform3d::Identity(), request, result);
    if (free < touch) return {true, time};
    time += free / length;
    if (time >= 1.0) return {};
  }
  return {true, time};
}

}  // namespace

Engine make_fcl(const Scene& scene) {
  Engine engine{.name = "FCL " FCL_VERSION, .used = "steps by fcl::distance, BVHModel<OBBRSS>, doubles"};
  const std::size_t before = allocated_bytes();
  std::shared_ptr<Model> model;
  engine.build_one = seconds([&] { model = model_of(scene); });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([model](const Query& query) {
    if (query.body.half_height == 0) return advance(*model, fcl::Sphered(query.body.radius), query);
    return advance(*model, fcl::Capsuled(query.body.radius, 2 * query.body.half_height), query);
  });
  return engine;
}

}  // namespace roam::bench
