#pragma once
/// \file
/// All triangles of all meshes, in one numbering.

#include <cstdint>
#include <span>
#include <vector>

#include "roam/mesh.h"

namespace roam::index {

/// A view of the meshes that a world is built from. Triangle i is triangle i - first()[m] of the mesh m that holds it.
class Soup {
 public:
  /// Throws roam::Error if an index is out of range, if a vertex is not finite or beyond coordinate_limit, or if there
  /// are more than 2^32 - 1 triangles.
  explicit Soup(std::span<const Mesh> meshes);

  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(first_.back()); }
  [[nodiscard]] const Box& bounds() const { return bounds_; }
  /// The number of the first triangle of each mesh, followed by the number of all triangles.
  [[nodiscard]] const std::vector<std::uint64_t>& first() const { return first_; }

  /// Calls f(position in ids, triangle) for each of the ids, which must be ascending.
  template <class F>
  void for_each(std::span<const std::uint32_t> ids, F&& f) const {
    std::size_t m = 0;
    for (std::size_t i = 0; i < ids.size(); ++i) {
      if (first_[m + 1] <= ids[i]) m = mesh_of(ids[i]);
      f(i, meshes_[m].triangle(static_cast<std::size_t>(ids[i] - first_[m])));
    }
  }

  /// The mesh that holds a triangle.
  [[nodiscard]] std::size_t mesh_of(std::uint64_t triangle) const;

  [[nodiscard]] std::span<const Mesh> meshes() const { return meshes_; }

 private:
  std::span<const Mesh> meshes_;
  std::vector<std::uint64_t> first_{0};
  Box bounds_;
};

}  // namespace roam::index
