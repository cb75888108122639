#include "index/soup.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "math/largest.h"
#include "roam/error.h"
#include "text/printable.h"

namespace roam::index {
namespace {

std::string title(std::span<const Mesh> meshes, std::size_t m) {
  return "mesh " + std::to_string(m) + (meshes[m].name.empty() ? "" : " (\"" + printable(meshes[m].name) + "\")");
}

}  // namespace

Soup::Soup(std::span<const Mesh> meshes) : meshes_(meshes) {
  first_.reserve(meshes.size() + 1);
  for (std::size_t m = 0; m < meshes.size(); ++m) {
    const Mesh& mesh = meshes[m];
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      for (const std::uint32_t v : mesh.triangles[i]) {
        if (v >= mesh.vertices.size()) {
          throw Error("cannot build a world: triangle " + std::to_string(i) + " of " + title(meshes, m) +
                      " uses vertex " + std::to_string(v) + ", but the mesh has " +
                      std::to_string(mesh.vertices.size()) + " vertices");
        }
        const Vec3& p = mesh.vertices[v];
        if (!(largest(p) <= coordinate_limit) || std::isnan(p.x) || std::isnan(p.y) || std::isnan(p.z)) {
          throw Error("cannot build a world: vertex " + std::to_string(v) + " of " + title(meshes, m) +
                      " is not finite or farther than 1e9 m from the origin; leave out triangle " + std::to_string(i) +
                      ", or check the unit of the data");
        }
        bounds_.include(p);
      }
    }
    first_.push_back(first_.back() + mesh.triangles.size());
  }
  if (first_.back() > std::numeric_limits<std::uint32_t>::max()) {
    throw Error("cannot build a world of " + std::to_string(first_.back()) +
                " triangles: one world in memory holds at most 4294967295; split the scene");
  }
}

std::size_t Soup::mesh_of(std::uint64_t triangle) const {
  return static_cast<std::size_t>(std::upper_bound(first_.begin(), first_.end(), triangle) - first_.begin()) - 1;
}

}  // namespace roam::index
