#pragma once
/// \file
/// Survey of a scene: a world of all its triangles, and one of its floors, for passage.h, probe.h and train.h.
///
///     const roam::Survey survey = roam::Survey::build(roam::import_scene("dam.ply").meshes);
///     const roam::Passage way = roam::widest_way(survey, entrance, grotto, {.height = 1.8});
///
/// A triangle is floor if its plane is at most the slope limit from level, whichever side is up. So ceilings are floor,
/// too.
///
/// A survey is immutable; its members may be called from any threads. Target roam::ways.

#include <cstdint>
#include <span>
#include <vector>

#include "roam/mesh.h"
#include "roam/world.h"

namespace roam {

class Survey {
 public:
  /// Indexes `meshes` and keeps them. Takes 11 to 25 bytes a triangle and 20 a triangle of floor besides the meshes.
  /// `slope_degrees`, in [0, 89], is the slope limit of floor. Throws as World::build does.
  [[nodiscard]] static Survey build(std::vector<Mesh> meshes, const BuildOptions& options = {},
                                    double slope_degrees = 45.0);

  /// Every triangle.
  [[nodiscard]] const World& world() const { return world_; }
  /// The floors alone. Its triangle f is triangle floor_triangles()[f] of world().
  [[nodiscard]] const World& floor() const { return floor_; }
  [[nodiscard]] double slope_degrees() const { return slope_degrees_; }

  /// The triangles as passed, with the ids of world(), in [0, triangles()).
  [[nodiscard]] std::uint64_t triangles() const { return first_.back(); }
  [[nodiscard]] Triangle triangle(TriangleId id) const;
  /// Ids in world() of all floor triangles, ascending.
  [[nodiscard]] std::span<const TriangleId> floor_triangles() const { return floor_ids_; }
  [[nodiscard]] bool is_floor(const Triangle& triangle) const;

  [[nodiscard]] std::span<const Mesh> meshes() const { return meshes_; }

 private:
  Survey() = default;

  std::vector<Mesh> meshes_;
  std::vector<TriangleId> first_{0};  ///< of each mesh; last the number of all
  std::vector<TriangleId> floor_ids_;
  double slope_degrees_ = 0.0;
  double least_upright_ = 0.0;  ///< |z| of a floor's unit normal
  World world_;
  World floor_;
};

}  // namespace roam
