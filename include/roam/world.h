#pragma once
/// \file
/// A world of triangles that bodies are swept through. Walkers keep its address: do not move a World under one.
///
/// Build one from meshes, then ask it anything from any number of threads:
///
///     const roam::World world = roam::World::build(meshes);
///     const roam::Impact s = world.sweep({.radius = 0.3}, from, motion);
///     if (s.hit) std::cout << world.object_name(s.triangle) << " at " << s.time << "\n";
///
/// What space.h promises holds at any distance from the origin up to 6.4e6 m and for triangles from 0.1 mm to 10 km in
/// one world; where that says 2 mm, a lossless world keeps 1e-5 m. The same input gives the same bits on every machine,
/// instruction set, thread count and run. Nothing in a world is unknown. Queries never lock and never allocate.

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/space.h"

namespace roam {

/// What a build may be told. The defaults suit everybody.
struct BuildOptions {
  int threads = 0;  ///< worker threads, at most one per core; 0: one per core. Does not change a bit of the result.
  /// Answer hits within 1e-5 m instead of 2 mm, for 8 to 10 more bytes a triangle. Triangles wider than 16 km lose some
  /// of it: WorldStats::largest_error_m says.
  bool lossless = false;
  /// Called now and then with the fraction done, in [0, 1], from any one thread at a time. Returning false cancels:
  /// build throws roam::Cancelled.
  std::function<bool(double)> progress = {};
};

/// What a world holds and what it costs.
struct WorldStats {
  std::uint64_t triangles = 0;
  std::uint64_t objects = 0;
  std::uint64_t tiles = 0;
  std::uint64_t bytes = 0;       ///< resident, everything included: geometry, hierarchy, triangle ids
  double largest_error_m = 0.0;  ///< the farthest that any stored vertex lies from where the caller put it
};

/// The tiles and the tree over them.
struct WorldData;

/// Triangles in memory. A space whose every triangle is known from the start, and which tells more about it.
class World final : public Space {
 public:
  /// An empty world: everything is free. A world that was moved from may only be assigned to or destroyed.
  World();
  ~World() override;
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Indexes the triangles of `meshes`. The meshes are not kept. Throws roam::Error for a vertex that is not finite
  /// or beyond coordinate_limit and for an index out of range, naming mesh and triangle.
  [[nodiscard]] static World build(std::span<const Mesh> meshes, const BuildOptions& options = {});

  /// No two worlds of a process that were built have the same revision, so that one which another is assigned to is
  /// known to have changed. The number itself means nothing.
  [[nodiscard]] SpaceFacts facts() const override;
  [[nodiscard]] Object object(TriangleId triangle) const override;

  [[nodiscard]] const WorldStats& stats() const;

 protected:
  [[nodiscard]] FirstImpact ask_first(const Query& query, Vicinity* vicinity) const override;
  void ask_near(const Query& query, Collector& collector, Vicinity* vicinity) const override;

 private:
  friend class Patchwork;  // these ask many worlds as one
  friend class Instances;

  std::unique_ptr<const WorldData> data_;
};

}  // namespace roam
