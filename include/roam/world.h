#pragma once
/// \file
/// A world of triangles that bodies are swept through.
///
/// Build one from meshes, then ask it anything from any number of threads:
///
///     const roam::World world = roam::World::build(meshes);
///     const roam::WorldSweep s = world.sweep({.radius = 0.3}, from, motion);
///     if (s.hit) std::cout << world.object_name(s.triangle) << " at " << s.time << "\n";
///
/// What is promised, with `radius` and triangles as the caller passed them and distances measured in exact arithmetic:
///   - over [0, time] of a sweep the body's axis is at least radius - 1e-6 m from every triangle, unless it starts
///     nearer: then it is a hit at time 0;
///   - a hit is only answered when, at `time`, a triangle is within radius + 2 mm of the axis (1e-5 m in a lossless
///     world). So a body that starts less than that from a wall may be answered a hit at time 0, whichever way it
///     moves: keep a body that is to move on at least 2 * largest_error_m from what it touches, as Walker does;
///   - the same input gives the same bits on every machine, instruction set, thread count and run.
/// This holds at any distance from the origin up to 6.4e6 m and for triangles from 0.1 mm to 10 km in one world.
///
/// Queries are const, never allocate, never lock, and may run at the same time. They throw roam::Error for
/// non-finite input and for bodies or distances beyond World::reach_limit.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"
#include "roam/sweep.h"

namespace roam {

/// The running number of a triangle over all meshes, in the order in which they were passed to World::build.
using TriangleId = std::uint64_t;
/// The running number of a mesh, in the order in which they were passed to World::build.
using ObjectId = std::uint32_t;

/// The first impact of a sweep with any triangle of a world. See SweepResult for the other members, with these
/// differences: `distance` of a miss is 0 (the way is free; World::clearance says by how much); and because a world
/// stores to within largest_error_m, a hit at time 0 may be of a body that is up to 2 mm clear. `point` lies on the
/// triangle as stored. The normal of a ray is that of the face, or of the nearest edge or corner.
struct WorldSweep : SweepResult {
  TriangleId triangle = 0;  ///< of a hit: the triangle that is touched first
};

/// A triangle near a body. See Proximity for the other members.
struct Contact : Proximity {
  TriangleId triangle = 0;
};

/// How far a body's surface is from everything. See Proximity for the other members; they are set when `found`.
struct Clearance : Proximity {
  bool found = false;  ///< a triangle lies within the reach that was asked for; else distance is that reach
  TriangleId triangle = 0;
};

/// What a build may be told. The defaults suit everybody.
struct BuildOptions {
  int threads = 0;  ///< worker threads, at most one per core; 0: one per core. Does not change a bit of the result.
  /// Answer hits within 1e-5 m instead of 2 mm, for 8 to 10 more bytes a triangle. Triangles wider than 16 km lose some
  /// of it: WorldStats::largest_error_m says.
  bool lossless = false;
  /// Called now and then with the fraction done, in [0, 1], from any one thread at a time. Returning false cancels:
  /// build throws roam::Cancelled.
  std::function<bool(double)> progress;
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

class World {
 public:
  /// Largest radius, half height and contact or clearance reach of a query, in metres.
  static constexpr double reach_limit = 1000.0;
  /// Largest absolute coordinate of a vertex, in metres.
  static constexpr double coordinate_limit = 1e9;

  /// An empty world: everything is free. A world that was moved from may only be assigned to or destroyed.
  World();
  ~World();
  World(World&&) noexcept;
  World& operator=(World&&) noexcept;

  /// Indexes the triangles of `meshes`. The meshes are not kept. Throws roam::Error for a vertex that is not finite
  /// or beyond coordinate_limit and for an index out of range, naming mesh and triangle.
  [[nodiscard]] static World build(std::span<const Mesh> meshes, const BuildOptions& options = {});

  /// First impact of `body`, its centre moved from `from` by `motion` (metres, up to 1e6 m).
  [[nodiscard]] WorldSweep sweep(const Body& body, const Vec3& from, const Vec3& motion) const;

  /// The triangles that come within `reach` (m) of the body's surface somewhere along the motion (zero motion: at
  /// the place). Each contact is measured where the body comes closest on its way. Writes at most contacts.size() of
  /// them, nearest first (ties by triangle id), and returns how many it wrote: fewer than contacts.size() means all.
  /// Costs n log n for n contacts; n^2 for motions over 64 m.
  std::size_t contacts(const Body& body, const Vec3& from, const Vec3& motion, double reach,
                       std::span<Contact> contacts) const;

  /// The triangle that `body` comes nearest to on its way along `motion` (zero motion: at the place), looking no
  /// farther than `reach` (m) from its surface. `distance` is a certified lower bound of the gap to every triangle
  /// over the whole way, at most 2 mm less than the true one (1e-5 m in a lossless world).
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& from, const Vec3& motion, double reach) const;
  /// The same for a body at rest.
  [[nodiscard]] Clearance clearance(const Body& body, const Vec3& place, double reach) const {
    return clearance(body, place, Vec3(0.0), reach);
  }

  /// First triangle that the ray from + t * motion, t in [0, 1], meets: the sweep of a point, which slips through no
  /// crack between triangles that share an edge.
  [[nodiscard]] WorldSweep ray(const Vec3& from, const Vec3& motion) const { return sweep({0.0, 0.0}, from, motion); }

  /// The box of all triangles; empty for an empty world.
  [[nodiscard]] const Box& bounds() const;
  [[nodiscard]] const WorldStats& stats() const;

  /// The object that a triangle belongs to. `triangle` must come from this world.
  [[nodiscard]] ObjectId object(TriangleId triangle) const;
  /// The name of the object that a triangle belongs to, as passed to build.
  [[nodiscard]] const std::string& object_name(TriangleId triangle) const;

 private:
  std::unique_ptr<const WorldData> data_;
};

}  // namespace roam
