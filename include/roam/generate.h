#pragma once
/// \file
/// Scenes made to measure: the paper's dam gallery, a terrain, a city; from 10 thousand to a thousand million triangles.
///
///     const auto gallery = roam::generate::gallery({.triangles = 500'000, .seed = 1});
///     roam::generate::write_scene(gallery, "gallery.ply");           // streamed: memory stays bounded
///     const auto meshes = roam::generate::collect(gallery);          // or all at once, for World::build
///
/// A scene is described when it is asked for and made when it is streamed: the numbers of triangles, vertices and
/// objects and the box are exact or safe before the first vertex exists, whatever the size.
///
/// The same options give the same bits on every machine, compiler, run and thread: only + - * / and sqrt of doubles
/// are used, which IEEE 754 rounds in one way, and noise is a hash of the seed and of integers.
///
/// Coordinates are doubles in metres, up is +z. Triangles are wound counter-clockwise seen from the open air: from
/// inside a gallery, from outside a building. Meshes that touch share their border vertices bit by bit, so that the
/// surface has no cracks; docs/proofs.md, "The made gallery", lists what is closed, what is open, what is from the
/// paper and what is our choice.
///
/// Options out of range throw roam::Error. All functions are safe to call from any thread. Library target
/// roam::generate.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace roam::generate {

/// Fewest and most triangles that may be asked for. What is made differs from what is asked by 3 % at most.
inline constexpr std::uint64_t least_triangles = 10'000;
inline constexpr std::uint64_t most_triangles = 1'000'000'000;
/// Largest number of triangles in one mesh that a scene hands out.
inline constexpr std::uint64_t piece_triangles = 65'536;
/// Largest absolute value of each coordinate of an origin, in metres.
inline constexpr double origin_limit = 1e7;

/// Takes the meshes of a scene, one after the other, in an order that never changes. The mesh is only valid during
/// the call. Exceptions pass through.
using Sink = std::function<void(const Mesh&)>;
/// Called now and then with the number of triangles done so far. Returning false cancels: roam::Cancelled is thrown.
using Progress = std::function<bool(std::uint64_t triangles)>;

/// A scene that is known but not made. Cheap to copy.
class Scene {
 public:
  /// Exactly as many as stream() hands out and write_scene() writes.
  [[nodiscard]] std::uint64_t triangles() const;
  [[nodiscard]] std::uint64_t vertices() const;
  /// Number of meshes. Each has a name of its own.
  [[nodiscard]] std::uint64_t objects() const;
  /// A box that holds every vertex; it may be larger than need be.
  [[nodiscard]] const Box& bounds() const;

  /// Makes the scene mesh by mesh, at most `piece_triangles` triangles and a few MB of memory at a time.
  /// Every vertex of a mesh is used by one of its triangles.
  void stream(const Sink& sink, const Progress& progress = {}) const;

  struct Plan;  ///< how it is made
  explicit Scene(std::shared_ptr<const Plan> plan);

 private:
  std::shared_ptr<const Plan> plan_;
};

/// Makes the whole scene at once: about 30 bytes of memory a triangle.
[[nodiscard]] std::vector<Mesh> collect(const Scene& scene, const Progress& progress = {});

/// Writes the scene to `path`, in the format of its extension (in either case):
///   .ply  binary little endian, double x y z, uint indices; nothing is lost but the names, which PLY cannot hold
///   .obj  each mesh a group `o NAME`; the fewest digits that read back as the same double
///   .stl  binary; floats. Refused when a coordinate would move by more than 1 mm (beyond 32,768 m). No names.
/// The file is written beside `path` under a temporary name and renamed when it is complete: a file of that name
/// is either whole or as it was before. On any error (no space, cancelled) the temporary file is removed.
/// Throws roam::Error for an unknown extension and when the file cannot be written.
void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress = {});

// ------------------------------------------------------------------------------------------------ the dam gallery

/// A straight way of a body's centre, in metres.
struct Path {
  const char* name;
  Vec3 from, to;
};

/// Table 1 of the paper. A body that flies with radius <= 0.55 m, or walks with radius 0.3 m and height 1.8 m, has
/// a clear way along 1 and 2. The third crosses the split. Add GalleryOptions::origin.
inline const std::array<Path, 3> gallery_paths{{
    {"straight", {-13739.0, 253.0, 182.0}, {-12504.0, 1566.0, 182.0}},
    {"corner", {-12504.0, 1566.0, 182.0}, {-12228.0, 1927.0, 182.0}},
    {"split", {-12528.0, 1549.0, 97.0}, {-12521.0, 1544.0, 96.0}},
}};

/// Measures of the gallery in metres that others rely on.
inline constexpr double gallery_floor_below_path = 0.95;  ///< the floor lies so far below all three paths
inline constexpr double gallery_split_width = 1.25;       ///< between the walls of the split, along path 3, level
inline constexpr double gallery_split_depth = 14.0;
inline constexpr double gallery_door_width = 0.75;  ///< of the grottos
inline constexpr double gallery_door_height = 1.8;

/// The dam gallery of Table 1. Objects: `upper_gallery/start`, `upper_gallery/end`, `upper_gallery/segment_012`,
/// `upper_gallery/corner_arm`, `upper_gallery/corner_gate_left` and `_right`, `drain_17`, `grotto_03/door`,
/// `grotto_03/room`, `grotto_03/instrument`, `lower_gallery/start`, `lower_gallery/end`, `lower_gallery/tube`,
/// `lower_gallery/split`, `lower_gallery/drainage_grotto_0/door` and `/room`, `dam`, `terrain`; where an object needs
/// more than one mesh the second is called `NAME/2`, and so on.
struct GalleryOptions {
  std::uint64_t triangles = 500'000;  ///< about this many; 500 k gives cells of 0.35 m, 5 M of 0.11 m
  std::uint64_t seed = 1;             ///< of the roughness and of what stands in the grottos
  Vec3 origin{0.0};                   ///< added to all coordinates, m; 0 keeps Table 1's
};
[[nodiscard]] Scene gallery(const GalleryOptions& options);

// ------------------------------------------------------------------------------------------------ terrain and city

/// A square heightfield with ridges, valleys and steep scarps. Objects: `terrain/ROW_COLUMN`.
struct TerrainOptions {
  std::uint64_t triangles = 1'000'000;
  std::uint64_t seed = 1;
  Vec3 origin{0.0};     ///< of the square's lower left corner, at height 0 of the relief, m
  double size = 700.0;  ///< side of the square, m, 10 to 100,000; 1 M triangles on 700 m are cells of 1 m
};
[[nodiscard]] Scene terrain(const TerrainOptions& options);

/// Blocks of buildings between streets with kerbs: doors into rooms, passages through buildings, window recesses,
/// bays that overhang the street, bridges across it. Objects: `street/ROW_COLUMN`, `block_ROW_COLUMN/building_N`,
/// `block_ROW_COLUMN/building_N/interior`, `bridge_ROW_COLUMN`. More triangles make more blocks, up to 1600, then finer
/// ones; below some 100 k the buildings have no windows.
struct CityOptions {
  std::uint64_t triangles = 1'000'000;
  std::uint64_t seed = 1;
  Vec3 origin{0.0};  ///< of the city's lower left corner at street level, m
};
[[nodiscard]] Scene city(const CityOptions& options);

}  // namespace roam::generate
