#pragma once
/// \file
/// Files of a paged scene that a test writes and reads through a harvester.

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <osg/PagedLOD>
#include <osgDB/ReadFile>
#include <osgDB/Registry>
#include <osgDB/WriteFile>
#include <string>
#include <utility>
#include <vector>

#include "import_files.h"
#include "osgRoam/Harvester.h"
#include "osg_graphs.h"

namespace paged_files {

using osgRoam::Harvester;
using roam::Vec3;
using roam::test::TemporaryFolder;

/// Files of one test, read by name through the harvester.
class PagedFiles : public testing::Test {
 protected:
  void TearDown() override { osgDB::Registry::instance()->setReadFileCallback(nullptr); }

  void start(Harvester::Levels levels = Harvester::ACCEPT_COARSE, const osg::Vec3d& origin = osg::Vec3d()) {
    harvester_ = new Harvester(space_, levels, origin);
    osgDB::Registry::instance()->setReadFileCallback(harvester_);
  }

  [[nodiscard]] std::string path(const std::string& name) const { return (folder_.path() / name).string(); }

  void write(const std::string& name, osg::Node& node) { ASSERT_TRUE(osgDB::writeNodeFile(node, path(name))); }

  /// Reads a file as a pager does.
  bool read(const std::string& name) { return osgDB::readRefNodeFile(path(name)) != nullptr; }

  /// The surface that a ball meets when it falls from 50 m, with its height: "coarse 1", "? 8", "nothing".
  std::string below(double x, double y = 0.0) {
    space_->update({.radius = 0.25}, {1e6, 1e6, 1e6});
    const Vec3 from{x, y, 50.0}, motion{0.0, 0.0, -100.0};
    const roam::Impact down = space_->sweep({.radius = 0.25}, from, motion);
    if (!down.hit) return "nothing";
    const std::string height = std::to_string(std::lround(from.z + down.time * motion.z - 0.25));
    return (down.unknown ? "?" : space_->object_name(down.triangle)) + " " + height;
  }

  TemporaryFolder folder_;
  std::shared_ptr<roam::Patchwork> space_ = std::make_shared<roam::Patchwork>();
  osg::ref_ptr<Harvester> harvester_;
};

/// A floor of 10 m.
inline osg::ref_ptr<osg::Geometry> slab(double x, double z, const std::string& name) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  for (const auto& [dx, dy] : {std::pair{-5, -5}, {5, -5}, {5, 5}, {-5, 5}}) {
    vertices->push_back(osg::Vec3(static_cast<float>(x + dx), static_cast<float>(dy), static_cast<float>(z)));
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  geometry->setName(name);
  return geometry;
}

/// A tile that a file refines. Its sphere reaches up to 8 m.
inline osg::ref_ptr<osg::PagedLOD> tile(double x, const osg::ref_ptr<osg::Node>& coarse, const std::string& file) {
  osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
  lod->setCenterMode(osg::LOD::USER_DEFINED_CENTER);
  lod->setCenter(osg::Vec3(static_cast<float>(x), 0, 0));
  lod->setRadius(8.0f);
  lod->setRangeMode(osg::LOD::PIXEL_SIZE_ON_SCREEN);
  unsigned next = 0;
  if (coarse.valid()) {
    lod->addChild(coarse, 0.0f, 500.0f);
    ++next;
  }
  lod->setFileName(next, file);
  lod->setRange(next, 500.0f, 1e9f);
  return lod;
}

inline osg::ref_ptr<osg::Group> group(const std::vector<osg::ref_ptr<osg::Node>>& children) {
  osg::ref_ptr<osg::Group> all = new osg::Group;
  for (const auto& child : children) all->addChild(child);
  return all;
}

}  // namespace paged_files
