#pragma once
/// \file
/// A world: an index over triangles in memory, for collision queries.
///
///     const roam::World world = roam::World::build(meshes);
///     const roam::Impact s = world.sweep({.radius = 0.3}, from, motion);
///     if (s.hit) std::cout << world.object_name(s.triangle) << " at " << s.time << "\n";
///
/// The promises of space.h are tested up to 6.4e6 m from the origin, and with triangles from 0.1 mm to 10 km in one
/// world; in a lossless world they hold with 1e-5 m instead of 2 mm. The same input gives the same bits on every
/// machine, instruction set, thread count and run. Queries never lock. Nothing is unknown. Do not move a World that a
/// Walker uses.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "roam/mesh.h"
#include "roam/space.h"

namespace roam {

struct BuildOptions {
  int threads = 0;        ///< >= 0; at most one per core; 0: one per core
  bool lossless = false;  ///< 1e-5 m instead of 2 mm, except triangles over 16 km; up to 9 more bytes a triangle
  /// Called with the fraction done, in [0, 1], by one thread at a time. Return false to make build() throw Cancelled.
  std::function<bool(double)> progress = {};
};

struct WorldStats {
  std::uint64_t triangles = 0;
  std::uint64_t objects = 0;
  std::uint64_t tiles = 0;
  std::uint64_t bytes = 0;     ///< resident: geometry, hierarchy and triangle numbers, without names
  double largest_error = 0.0;  ///< m: largest distance of a stored vertex from the caller's
};

struct WorldData;

class World final : public Space {
 public:
  /// An empty world: everything is free. A moved-from world may only be assigned to or destroyed.
  World();
  ~World() override;
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Indexes the triangles of `meshes`, which are not kept. Throws roam::Error for an option or index out of range, a
  /// used vertex not finite or beyond coordinate_limit, naming mesh and triangle, and for 2^32 triangles or more.
  [[nodiscard]] static World build(std::span<const Mesh> meshes, const BuildOptions& options = {});
  [[nodiscard]] SpaceFacts facts() const override;  ///< no two worlds of a process have the same revision
  [[nodiscard]] Object object(TriangleId triangle) const override;
  [[nodiscard]] const WorldStats& stats() const;

 protected:
  [[nodiscard]] FirstImpact find_first(const Query& query, Vicinity* vicinity) const override;
  void find_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  friend class Patchwork;  // these query many worlds as one
  friend class Instances;

  std::unique_ptr<const WorldData> data_;
};

}  // namespace roam
