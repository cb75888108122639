#include "roam/survey.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <utility>

#include "math/floating_point.h"
#include "math/slope.h"

namespace roam {

namespace {

constexpr double steepest = 89.0;  ///< degrees

/// The floor of a mesh, with the mesh's own vertices left where they are.
Mesh floor_of(const Survey& survey, const Mesh& mesh, TriangleId first, std::vector<TriangleId>& ids) {
  Mesh floor;
  floor.name = mesh.name;
  constexpr std::uint32_t unseen = ~0u;
  std::vector<std::uint32_t> number(mesh.vertices.size(), unseen);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!survey.is_floor(mesh.triangle(i))) continue;
    std::array<std::uint32_t, 3> corners = mesh.triangles[i];
    for (std::uint32_t& corner : corners) {
      if (number[corner] == unseen) {
        number[corner] = static_cast<std::uint32_t>(floor.vertices.size());
        floor.vertices.push_back(mesh.vertices[corner]);
      }
      corner = number[corner];
    }
    floor.triangles.push_back(corners);
    ids.push_back(first + i);
  }
  return floor;
}

}  // namespace

Survey Survey::build(std::vector<Mesh> meshes, const BuildOptions& options, double slope_degrees) {
  const DefaultFloatingPoint guard;
  if (!(slope_degrees >= 0.0 && slope_degrees <= steepest))
    throw Error(
        fmt::format("the slope limit of a survey is {:g} degrees; it must be from 0 to {:g}", slope_degrees, steepest));
  // Most of the work is the whole scene; the floors are a part of it.
  constexpr double whole_share = 0.8;
  const auto part = [&](double begin, double share) {
    BuildOptions build = options;
    if (options.progress)
      build.progress = [&, begin, share](double done) { return options.progress(begin + share * done); };
    return build;
  };
  Survey survey;
  survey.slope_degrees_ = slope_degrees;
  survey.least_upright_ = least_upright(slope_degrees);
  survey.meshes_ = std::move(meshes);
  survey.world_ = World::build(survey.meshes_, part(0.0, whole_share));  // which also checks the indices
  std::vector<Mesh> floors;
  for (const Mesh& mesh : survey.meshes_) {
    const TriangleId first = survey.first_.back();
    floors.push_back(floor_of(survey, mesh, first, survey.floor_ids_));
    survey.first_.push_back(first + mesh.triangles.size());
  }
  survey.floor_ = World::build(floors, part(whole_share, 1.0 - whole_share));
  return survey;
}

Triangle Survey::triangle(TriangleId id) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), id);
  const auto mesh = static_cast<std::size_t>(after - first_.begin()) - 1;
  return meshes_[mesh].triangle(static_cast<std::size_t>(id - first_[mesh]));
}

bool Survey::is_floor(const Triangle& triangle) const {
  const DefaultFloatingPoint guard;
  const Vec3 normal = glm::cross(triangle[1] - triangle[0], triangle[2] - triangle[0]);
  const double length = glm::length(normal);
  return length > 0.0 && std::abs(normal.z) >= least_upright_ * length;
}

}  // namespace roam
