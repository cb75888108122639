#pragma once
/// \file
/// What Harvester copies from one file: triangles, and where other files belong.

#include <cstdint>
#include <osg/ProxyNode>
#include <string>
#include <vector>

#include "osg_triangles/graph_walk.h"
#include "osg_triangles/level_of_detail.h"
#include "roam/math.h"
#include "roam/mesh.h"

namespace osgRoam {

/// A PagedLOD or ProxyNode with files that have not been read.
struct NamedFiles {
  osg::Matrixd to_scene;  ///< from the frame of the files
  roam::Box box;          ///< of the bounding sphere and of `coarse`, in the scene; empty when neither says anything
  /// What is there without the files: the finest level that this file holds itself.
  std::vector<roam::Mesh> coarse;
  /// The files that make each finer level, coarse ones first. All of the last, finest level are there; of those between
  /// only such as are a level by themselves, which a finer one can take the place of.
  std::vector<std::vector<std::string>> levels;
  /// What this file itself adds to the finest level.
  std::vector<roam::Mesh> finest;
};

struct Harvest {
  std::vector<roam::Mesh> meshes;  ///< what stays as it is, whatever else is read
  std::vector<NamedFiles> named;
  std::vector<std::string> loaded;   ///< files that are named, but whose nodes are in the graph already
  std::vector<std::string> nowhere;  ///< files that are named under a transform that is not finite
  std::uint64_t triangles = 0, left_out = 0;
};

/// Copies all that a graph holds. `place` is the product of the transforms above it; nameless triangles are called
/// `name`.
[[nodiscard]] Harvest harvest(osg::Node& graph, const osg::Matrixd& place, const std::string& name);

[[nodiscard]] roam::Box box_of(const std::vector<roam::Mesh>& meshes);

}  // namespace osgRoam
