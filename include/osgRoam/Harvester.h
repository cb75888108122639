#pragma once
/// \file
/// Harvester: collision of a paged scene, copied from the files as OpenSceneGraph's pager reads them.
///
///     auto space = std::make_shared<roam::Patchwork>();
///     osgDB::Registry::instance()->setReadFileCallback(new osgRoam::Harvester(space));
///     viewer.setSceneData(osgDB::readRefNodeFile("Data/Tile_+000_+000/Tile_+000_+000.osgb"));
///
/// Each file becomes patches of the patchwork in the thread that read it. Call Patchwork::update between two steps, and
/// once after the root file was read, before there is a body.
///
/// Patches: the coarse children of a PagedLOD are a patch, refined by the files that it names. A file that has not come
/// is unknown, hence solid: in the box of the bounding sphere of its PagedLOD or ProxyNode, or else in the box of the
/// file that names it. Each file is placed by the transforms above the nodes that name it; named twice, it is placed
/// twice. A file is taken once, and stays when the pager drops it. LOD nodes without files count with their finest
/// level.
///
/// Failures: a file whose transform is not finite, a world that cannot be built, or one with an error beyond
/// Patchwork::error_limit counts as failed and is solid. Nothing is thrown into the pager's threads.
///
/// Registry: it has one ReadFileCallback, which this replaces; chain another by setNextCallback. The pager does not use
/// the callbacks of osgDB::Options. Leave out the hint CACHE_NODES: cached files are not seen. To end the harvester,
/// call viewer.getDatabasePager()->cancel(), then setReadFileCallback(nullptr). Use a new one, and a new Patchwork, for
/// another scene.
///
/// Thread-safe.

#include <cstdint>
#include <memory>
#include <osg/Matrixd>
#include <osg/Node>
#include <osg/Vec3d>
#include <osgDB/Callbacks>
#include <string>
#include <vector>

#include "roam/patchwork.h"

namespace osgRoam {

class Harvester : public osgDB::ReadFileCallback {
 public:
  enum Levels {
    ACCEPT_COARSE,  ///< coarse children are in use until finer ones have come and leave the body room
    FINEST_ONLY     ///< coarse children are unknown until finer ones have come or failed
  };

  /// `origin` (metres) is added to coordinates: for a graph that is the scene minus an origin. Throws roam::Error if
  /// `space` is null.
  explicit Harvester(std::shared_ptr<roam::Patchwork> space, Levels levels = ACCEPT_COARSE,
                     const osg::Vec3d& origin = osg::Vec3d());

  /// Takes a graph that is not read from a file, and the files that it names. `place` is the product of the transforms
  /// above it. The graph must not be in a running scene yet. Throws roam::Error if it contains itself, or, after taking
  /// the rest, if a part could not be built.
  void add(osg::Node& graph, const osg::Matrixd& place = osg::Matrixd::identity());

  /// Whether to take files that no other file names: root files, but also a sky or a cursor. Default: true.
  void setTakesUnnamedFiles(bool takes);

  /// The callback that reads; null: osgDB itself.
  void setNextCallback(osgDB::ReadFileCallback* next);

  struct Stats {
    std::uint64_t files = 0;               ///< taken
    std::uint64_t expected = 0;            ///< named and not yet come, once per place
    std::uint64_t triangles = 0;           ///< copied, with coarse ones
    std::uint64_t leftOut = 0;             ///< triangles with unusable vertices
    std::uint64_t failed = 0;              ///< once per place
    std::vector<std::string> failedFiles;  ///< the first 100
  };
  Stats getStats() const;

  osgDB::ReaderWriter::ReadResult readNode(const std::string& file, const osgDB::Options* options) override;

 protected:
  ~Harvester() override;

 private:
  struct State;
  std::unique_ptr<State> _state;
};

}  // namespace osgRoam
