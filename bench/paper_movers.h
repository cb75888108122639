#pragma once
/// \file
/// The rows of the paper's tables: programs that move a sphere, each by one engine.

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "float_mesh.h"
#include "paper_ways.h"
#include "roam/mesh.h"
#include "roam/space.h"

namespace roam::bench {

/// Added to Table 1's coordinates for engines that compute in floats. 13.7 km from the origin, floats are 1 mm apart.
inline const Vec3 paper_shift{13121.5, -909.5, -182.0};

/// The input of a row: the scene's file, a store of it, tiles for OpenSceneGraph, tiles for OGRE.
enum class Reads : std::uint8_t { file, store, osgb, ogre };

/// The scene as prepared for the rows. Inputs that no row reads do not exist, except the file.
struct PaperScene {
  std::string scene;           ///< the file for roam
  std::string store;           ///< the same as a store
  std::string tiles;           ///< a folder of files, shifted: osgb and OGRE's, one per mesh, and paged.osgb
  std::size_t tile_count = 0;  ///< 0.osgb, 0.mesh, 1.osgb, ...
  std::uint64_t memory = 0;    ///< bytes for pagers, at most
};

struct PaperRow {
  std::string name;     ///< as --rows takes it
  std::string title;    ///< of the tables
  std::string how;      ///< the engine, and the place of the scene
  std::string missing;  ///< empty, or what to install
  Reads reads = Reads::osgb;
  std::function<Mover(const PaperScene&)> load{};
};
/// `wasm`: the folder whose node_modules hold PhysX; empty: none.
[[nodiscard]] std::vector<PaperRow> paper_rows(const std::string& wasm);

/// A Walker, which walks as a person if the body is a capsule.
[[nodiscard]] Mover roam_in(std::shared_ptr<const Space> space);
[[nodiscard]] Mover roam_in_memory(const PaperScene& scene);
[[nodiscard]] Mover roam_in_store(const PaperScene& scene);
/// World::sweep instead of Walker: the work of a program that has only a sweep.
[[nodiscard]] Mover roam_sweep(const PaperScene& scene);
/// The paper's box intersector and equations, or osgUtil::PolytopeIntersector. The graph is in memory, with or without
/// KdTrees, or paged.
enum class Graph { loaded, with_kd_trees, paged };
[[nodiscard]] Mover paper_method(const PaperScene& scene, Graph graph);
[[nodiscard]] Mover polytope_method(const PaperScene& scene, Graph graph);
/// Passes the triangles of the tiles as floats, one tile after another, to an engine other than the reading one.
using TileReader = std::function<void(const PaperScene& scene, const std::function<void(FloatMesh tile)>& take)>;
/// Tiles in Bullet's btBvhTriangleMeshShape.
[[nodiscard]] Mover bullet_sweep(const PaperScene& scene, const TileReader& read);

/// TileReaders: OpenSceneGraph from osgb, and OGRE from its .mesh files. Neither keeps the tiles.
void read_tiles(const PaperScene& scene, const std::function<void(FloatMesh tile)>& take);
void read_ogre_tiles(const PaperScene& scene, const std::function<void(FloatMesh tile)>& take);

/// Writes OpenSceneGraph's files into the folder of PaperScene::tiles, mesh by mesh.
class TileWriter {
 public:
  explicit TileWriter(std::string folder);
  ~TileWriter();
  void add(const Mesh& mesh);
  /// Writes paged.osgb.
  void finish();

 private:
  struct State;
  State* state_;
};

/// Returns a function that writes each mesh as an OGRE file into that folder. One at a time in a program.
[[nodiscard]] std::function<void(const Mesh& mesh)> ogre_tile_writer(const std::string& folder);

/// The first touch of a sphere, and the direction out.
struct Touch {
  double time = 1.0;
  Vec3 normal{0.0};
};
using Sweep = std::function<std::optional<Touch>(double radius, const Vec3& from, const Vec3& motion)>;
/// Moves as a program does that has only a sweep. It moves until `skin` metres before the touch and slides along the
/// touched plane, four times at most. A walking body also falls, until it touches. `shift` is added to all places.
[[nodiscard]] Mover collide_and_slide(Sweep sweep, const Vec3& shift, double skin = 1e-3);
/// Moves as a program does that only knows whether a place is free: it goes there, or stays.
using Blocked = std::function<bool(double radius, const Vec3& from, const Vec3& motion)>;
[[nodiscard]] Mover go_or_stay(Blocked blocked, const Vec3& shift);

}  // namespace roam::bench
