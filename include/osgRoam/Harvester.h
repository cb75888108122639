#pragma once
/// \file
/// The collision of a paged scene, taken from the files as OpenSceneGraph's own pager reads them:
///
///     auto space = std::make_shared<roam::Patchwork>();
///     osgDB::Registry::instance()->setReadFileCallback(new osgRoam::Harvester(space));
///     viewer.setSceneData(osgDB::readRefNodeFile("Data/Tile_+000_+000/Tile_+000_+000.osgb"));
///
/// Each file is copied in the thread that read it, before anybody else sees its nodes, and becomes patches of the
/// patchwork: what stands for itself, and for each PagedLOD its coarse children, which the files that it names refine.
/// What is not there yet is unknown, and solid: the box of the bounding sphere of the PagedLOD or ProxyNode; where that
/// has no usable one, and no coarse children, the box of the file that names it. A root file has no box: what it names
/// so holds no space, and counts as failed, until it comes; then it is taken where it lies. What is under a transform
/// that is not finite is left out: triangles, and files, which count as failed. Call
/// Patchwork::update between two steps, as its header says, and once after the root has been read, before there is a
/// body: of a patchwork into which nothing has come nothing is solid.
///
/// Where a file belongs follows from the transforms above the nodes that name it: a file that is named at two places
/// comes to both when it is first read. Files that the pager drops and reads again are not taken again, and what was
/// taken stays: collision does not depend on what is on the screen.
///
/// Put it into the Registry: the pager does not pass on the osgDB::Options that a scene was read with. It sees no files
/// that osgDB answers from its object cache (osgDB::Options::CACHE_NODES): leave that hint off. LOD nodes without files
/// count with their finest level. Files that are read while another is being read (ProxyNode, pseudo loaders) are part
/// of that one.
///
/// The Registry has one ReadFileCallback: setting this one replaces an earlier one. To keep that, pass it to
/// setNextCallback; it is asked first, and its answer harvested. To be behind another, set that one and let its
/// readNode call the harvester's. Other callbacks (FindFileCallback, a pager's FileCache) are osgDB's business as
/// before.
///
/// The Registry keeps the harvester, and that its patchwork, alive until the process ends. To end it, stop the pager
/// (viewer.getDatabasePager()->cancel()), then setReadFileCallback(nullptr), or what was there before. Another scene
/// wants a new Patchwork and a new Harvester, in the same order: one takes each file once, and nothing is taken back.
///
/// What cannot be built, or is stored less exactly than Patchwork::error_limit (a triangle of 1e8 m), fails with its
/// reason and is solid; the rest of its file comes. Nothing is thrown into the pager's threads.
///
/// Everything may be called from any thread.

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
    ACCEPT_COARSE,  ///< coarse children count until what refines them is there and leaves the body room
    FINEST_ONLY     ///< what has a finer level is unknown until that is there, or is known not to come
  };

  /// `space` takes the patches. Coordinates of files are moved by `origin` (metres): where the graph that is drawn is
  /// the scene minus an origin, pass that origin. Throws roam::Error for a null `space`.
  explicit Harvester(std::shared_ptr<roam::Patchwork> space, Levels levels = ACCEPT_COARSE,
                     const osg::Vec3d& origin = osg::Vec3d());

  /// Takes a graph that is not, or not as it is, a file: from here on the files that it names are known. `place` is the
  /// product of the transforms that it will stand under. The graph must not be part of a running scene yet. Throws
  /// roam::Error for a graph that contains itself, and, when all the rest of it has come, for what could not be built.
  void add(osg::Node& graph, const osg::Matrixd& place = osg::Matrixd::identity());

  /// Whether files that nothing read or added before names are taken too, as they are; true at first. They are the
  /// scene's root files; but so is a sky or a cursor that the program reads later.
  void setTakesUnnamedFiles(bool takes);

  /// Who really reads; null, as at first, for osgDB itself.
  void setNextCallback(osgDB::ReadFileCallback* next);

  struct Stats {
    std::uint64_t files = 0;               ///< taken
    std::uint64_t expected = 0;            ///< places where a file is named and has not come
    std::uint64_t triangles = 0;           ///< copied, coarse ones included
    std::uint64_t leftOut = 0;             ///< triangles with vertices that cannot be used
    std::uint64_t failed = 0;              ///< places whose file is missing or broken or has no place
    std::vector<std::string> failedFiles;  ///< the first 100 names, in the order in which they failed
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
