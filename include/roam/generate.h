#pragma once
/// \file
/// Generated scenes: the paper's dam gallery, terrain and city. Library target roam::generate.
///
///     const auto gallery = roam::generate::gallery({.triangles = 500'000, .seed = 1});
///     roam::generate::write_scene(gallery, "gallery.ply");           // streamed: memory stays bounded
///     const auto meshes = roam::generate::collect(gallery);          // or all at once, for World::build()
///
/// Counts and bounds of a scene are known before it is made. The same options give the same bits on every machine,
/// compiler, run and thread. Lengths are metres. Triangles are counter-clockwise seen from the open air: inside a
/// gallery, outside a building. Meshes that touch share border vertices bit by bit, so the surface has no cracks;
/// docs/proofs.md, "The made gallery", lists openings. All functions are thread-safe. Options out of range throw
/// roam::Error.

#include <array>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace roam::generate {

inline constexpr std::uint64_t least_triangles = 10'000;  ///< of a request; a scene meets its request within 3 %
inline constexpr std::uint64_t most_triangles = 1'000'000'000;
inline constexpr std::uint64_t piece_triangles = 65'536;  ///< largest number in one mesh of a scene
inline constexpr double origin_limit = 1e7;               ///< largest absolute coordinate of an origin

/// Receives the meshes of a scene in a fixed order, each valid only during the call. Exceptions pass through.
using Sink = std::function<void(const Mesh&)>;
using Progress = std::function<bool(std::uint64_t triangles)>;  ///< triangles done; on false, throws roam::Cancelled

/// A description of a scene, from which it is made. Cheap to copy.
class Scene {
 public:
  [[nodiscard]] std::uint64_t triangles() const;  ///< exact, like the next two
  [[nodiscard]] std::uint64_t vertices() const;
  [[nodiscard]] std::uint64_t objects() const;  ///< number of meshes, each with a name of its own
  [[nodiscard]] const Box& bounds() const;      ///< contains every vertex; may be larger than necessary
  /// Makes the scene mesh by mesh, in a few MB of memory. Every vertex of a mesh is used by one of its triangles.
  void stream(const Sink& sink, const Progress& progress = {}) const;
  struct Plan;  ///< how it is made
  explicit Scene(std::shared_ptr<const Plan> plan);

 private:
  std::shared_ptr<const Plan> plan_;
};

[[nodiscard]] std::vector<Mesh> collect(const Scene& scene, const Progress& progress = {});  ///< ~30 bytes a triangle

/// Writes the scene to `path`, in the format of its extension (either case):
///   .ply  binary little endian, double x y z, uint indices; loses only the names
///   .obj  each mesh a group `o NAME`; the fewest digits that read back as the same double
///   .stl  binary floats, without names; refused for bounds beyond 32,768 m, where floats are off by more than 1 mm
/// Throws roam::Error for another extension and if writing fails. Then, or if cancelled, `path` is as it was before.
void write_scene(const Scene& scene, const std::filesystem::path& path, const Progress& progress = {});
/// Whether write_scene() knows the extension.
[[nodiscard]] bool has_scene_extension(const std::filesystem::path& path);

/// A straight path of a body's centre.
struct Path {
  const char* name;
  Vec3 from, to;
};

/// Table 1 of the paper; add GalleryOptions::origin. The first two are clear for a body that flies with radius <= 0.55
/// or walks with radius 0.3 and height 1.8. The third crosses the split.
inline const std::array<Path, 3> gallery_paths{{
    {"straight", {-13739.0, 253.0, 182.0}, {-12504.0, 1566.0, 182.0}},
    {"corner", {-12504.0, 1566.0, 182.0}, {-12228.0, 1927.0, 182.0}},
    {"split", {-12528.0, 1549.0, 97.0}, {-12521.0, 1544.0, 96.0}},
}};
inline constexpr double gallery_floor_below_path = 0.95;  ///< from all three paths down to the floor
inline constexpr double gallery_split_width = 1.25;       ///< between the walls of the split, along path 3, level
inline constexpr double gallery_split_depth = 14.0;
inline constexpr double gallery_door_width = 0.75;  ///< of the grottos
inline constexpr double gallery_door_height = 1.8;

/// The dam gallery of Table 1. Objects: `dam`, `terrain`, `drain_17`, `grotto_03/{door,room,instrument}`,
/// `upper_gallery/{start,end,segment_012,corner_arm,corner_gate_left,corner_gate_right}` and
/// `lower_gallery/{start,end,tube,split,drainage_grotto_0/{door,room}}`. Further meshes of one are called `NAME/2` etc.
struct GalleryOptions {
  std::uint64_t triangles = 500'000;  ///< 500 k gives cells of 0.35 m, 5 M of 0.11 m
  std::uint64_t seed = 1;             ///< of the roughness and of the objects in the grottos
  Vec3 origin{0.0};                   ///< added to all coordinates; 0 keeps those of Table 1
};
[[nodiscard]] Scene gallery(const GalleryOptions& options);

/// A square heightfield with ridges, valleys and steep scarps. Objects: `terrain/ROW_COLUMN`.
struct TerrainOptions {
  std::uint64_t triangles = 1'000'000;
  std::uint64_t seed = 1;
  Vec3 origin{0.0};     ///< of the lower left corner, at height 0 of the relief
  double size = 700.0;  ///< side of the square, [10, 100,000]; 1 M triangles on 700 m are cells of 1 m
};
[[nodiscard]] Scene terrain(const TerrainOptions& options);

/// Blocks of buildings with doors, rooms, passages, windows and bays, between streets with kerbs and bridges. Objects:
/// `street/ROW_COLUMN`, `bridge_ROW_COLUMN`, `block_ROW_COLUMN/building_N` and `block_ROW_COLUMN/building_N/interior`.
/// More triangles make more blocks, up to 1600, then finer ones. Below some 100 k there are no windows.
struct CityOptions {
  std::uint64_t triangles = 1'000'000;
  std::uint64_t seed = 1;
  Vec3 origin{0.0};  ///< of the lower left corner at street level
};
[[nodiscard]] Scene city(const CityOptions& options);

}  // namespace roam::generate
