#pragma once
/// \file
/// Data that Harvester copies from one file: triangles, and the positions of other files.

#include <cstdint>
#include <osg/ProxyNode>
#include <string>
#include <vector>

#include "osg_triangles/graph_walk.h"
#include "osg_triangles/level_of_detail.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace osgRoam {

/// A PagedLOD or ProxyNode that names files which have not been read.
struct NamedFiles {
  osg::Matrixd to_scene;  ///< from the frame of the files
  roam::Box box;          ///< of the bounding sphere and of `coarse`, in the scene; empty if neither has bounds
  /// The geometry without the files: the finest level in this file.
  std::vector<roam::Mesh> coarse;
  /// The files of each finer level, coarse ones first. The last level is the finest and has all its files. Between them
  /// are only levels of a single file, which a finer level can replace.
  std::vector<std::vector<std::string>> levels;
  /// Geometry of this file in the finest level.
  std::vector<roam::Mesh> finest;
};

struct Harvest {
  std::vector<roam::Mesh> meshes;  ///< geometry that stays, whatever files are read
  std::vector<NamedFiles> named;
  std::vector<std::string> loaded;   ///< files that are named, but whose nodes are already in the graph
  std::vector<std::string> nowhere;  ///< files that are named below a transform that is not finite
  std::uint64_t triangles = 0, left_out = 0;
};

/// Copies the triangles of a graph. `place` is the product of the transforms above it. Triangles without a name get
/// `name`.
[[nodiscard]] Harvest harvest(osg::Node& graph, const osg::Matrixd& place, const std::string& name);

[[nodiscard]] roam::Box box_of(const std::vector<roam::Mesh>& meshes);

}  // namespace osgRoam
