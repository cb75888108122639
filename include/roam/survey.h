#pragma once
/// \file
/// A scene made ready to be asked where a person gets through: everything in it, and its floors alone.
///
///     const roam::Survey survey = roam::Survey::build(roam::import_scene("dam.ply").meshes);
///     const roam::Passage way = roam::widest_way(survey, entrance, grotto, {.height = 1.8});
///
/// passage.h says how wide the way from one place to another is, train.h which sizes of a body serve a whole scene.
///
/// *Floor* is a triangle whose plane is at most the slope limit from level, whichever side is up: stairs, slabs, ramps,
/// and ceilings too, which nobody comes to stand on from below.
///
/// A survey does not change once it is built; all members are const and safe to call from any number of threads.
/// Library target roam::ways.

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/world.h"

namespace roam {

struct SurveyOptions {
  double slope_degrees = 45.0;                ///< in [0, 89]: what is at most so steep is floor
  int threads = 0;                            ///< as BuildOptions::threads
  bool lossless = false;                      ///< as BuildOptions::lossless
  std::function<bool(double)> progress = {};  ///< as BuildOptions::progress
};

class Survey {
 public:
  /// Indexes `meshes`, which it keeps. Memory: the meshes, about 11 bytes a triangle, and about 20 a triangle of floor.
  /// Throws what World::build throws.
  [[nodiscard]] static Survey build(std::vector<Mesh> meshes, const SurveyOptions& options = {});

  /// Every triangle.
  [[nodiscard]] const World& world() const { return world_; }
  /// The floors alone. Its triangle ids are not those of world(): see floor_triangle.
  [[nodiscard]] const World& floor() const { return floor_; }
  [[nodiscard]] double slope_degrees() const { return slope_degrees_; }

  /// The triangles as they were passed; ids are those of world(), in [0, triangles()).
  [[nodiscard]] std::uint64_t triangles() const { return first_.back(); }
  [[nodiscard]] Triangle triangle(TriangleId id) const;
  /// The ids in world() of all triangles that are floor, ascending. An id f of floor() is floor_triangles()[f] here.
  [[nodiscard]] std::span<const TriangleId> floor_triangles() const { return floor_ids_; }
  [[nodiscard]] bool is_floor(const Triangle& triangle) const;

  [[nodiscard]] std::span<const Mesh> meshes() const { return meshes_; }

 private:
  Survey() = default;

  std::vector<Mesh> meshes_;
  std::vector<TriangleId> first_{0};  ///< of each mesh, and the number of all
  std::vector<TriangleId> floor_ids_;
  double slope_degrees_ = 0.0;
  double least_upright_ = 0.0;  ///< |z| of a floor's unit normal
  World world_;
  World floor_;
};

}  // namespace roam
