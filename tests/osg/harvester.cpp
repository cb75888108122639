// Collision from the files that a pager reads: what is unknown, what replaces what, and where things belong.

#include <osg/ProxyNode>
#include <thread>

#include "paged_files.h"
#include "roam/error.h"

namespace {

using osgRoam::Harvester;
using paged_files::group;
using paged_files::slab;
using paged_files::tile;
using roam::Vec3;
using OsgHarvester = paged_files::PagedFiles;

TEST_F(OsgHarvester, RefinesLevelByLevel) {
  write("root.osgt", *group({slab(30, 0, "always"), tile(0, slab(0, 1, "coarse"), "one.osgt")}));
  write("one.osgt", *group({tile(0, slab(0, 2, "medium"), "two.osgt")}));
  write("two.osgt", *slab(0, 3, "fine"));
  start();
  EXPECT_EQ(below(0), "nothing");
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(30), "always 0");
  EXPECT_EQ(below(0), "coarse 1");
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "medium 2");
  ASSERT_TRUE(read("two.osgt"));
  EXPECT_EQ(below(0), "fine 3");
  EXPECT_EQ(harvester_->getStats().files, 3u);
  EXPECT_EQ(harvester_->getStats().expected, 0u);
  EXPECT_EQ(harvester_->getStats().triangles, 8u);
  EXPECT_EQ(space_->stats().triangles, 4u);
}

TEST_F(OsgHarvester, KeepsTheCoarseLevelAroundABodyThatHasNoRoomInTheFinerOne) {
  write("root.osgt", *tile(0, slab(0, 1, "coarse"), "one.osgt"));
  write("one.osgt", *slab(0, 3, "fine"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  ASSERT_TRUE(read("one.osgt"));
  const roam::Body body{.radius = 0.5};
  space_->update(body, {0, 0, 2.9});
  EXPECT_FALSE(space_->sweep(body, {0, 0, 2.9}, Vec3(0.0)).hit);
  EXPECT_EQ(space_->stats().waiting, 1u);
  space_->update(body, {0, 0, 4.0});
  EXPECT_EQ(below(0), "fine 3");
}

TEST_F(OsgHarvester, TakesForSolidWhatHasNotComeAndHasNoCoarserLevel) {
  write("root.osgt", *group({tile(0, nullptr, "one.osgt"), tile(30, slab(30, 1, "coarse"), "other.osgt")}));
  write("one.osgt", *slab(0, 3, "fine"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(0), "? 8");
  EXPECT_EQ(harvester_->getStats().expected, 2u);
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "fine 3");
}

TEST_F(OsgHarvester, WaitsForTheFinestLevelWhereThatIsWished) {
  write("root.osgt", *group({tile(0, slab(0, 1, "coarse"), "one.osgt"), tile(30, slab(30, 1, "coarse"), "gone.osgt")}));
  write("one.osgt", *group({tile(0, slab(0, 2, "medium"), "two.osgt")}));
  write("two.osgt", *slab(0, 3, "fine"));
  start(Harvester::FINEST_ONLY);
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(0), "? 8");
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "? 8");
  ASSERT_TRUE(read("two.osgt"));
  EXPECT_EQ(below(0), "fine 3");
  // What is known not to come gives way to what there is.
  EXPECT_EQ(below(30), "? 8");
  EXPECT_FALSE(read("gone.osgt"));
  EXPECT_EQ(below(30), "coarse 1");
}

TEST_F(OsgHarvester, PutsAFileWhereverItIsNamed) {
  osg::ref_ptr<osg::MatrixTransform> twice = new osg::MatrixTransform(osg::Matrixd::translate(100, 0, 10));
  const auto one = tile(0, slab(0, 1, "coarse"), "one.osgt");
  twice->addChild(one);
  osg::ref_ptr<osg::MatrixTransform> turned =
      new osg::MatrixTransform(osg::Matrixd::rotate(0.5 * M_PI, osg::Vec3d(0, 0, 1)) * osg::Matrixd::scale(2, 2, 2));
  turned->addChild(tile(30, slab(30, 1, "coarse"), "one.osgt"));
  write("root.osgt", *group({one, twice, turned}));
  osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(30, 0, 0));
  moved->addChild(slab(0, 3, "fine"));
  write("one.osgt", *group({moved, slab(0, 4, "finer")}));
  start(Harvester::ACCEPT_COARSE, {1000, 0, 0});
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(1000), "coarse 1");
  EXPECT_EQ(below(1100), "coarse 11");
  EXPECT_EQ(below(1000, 60), "coarse 2");
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(1012), "nothing");
  EXPECT_EQ(below(1030), "fine 3");
  EXPECT_EQ(below(1100), "finer 14");
  EXPECT_EQ(below(1130), "fine 13");
  EXPECT_EQ(below(1000), "finer 8");  // of the turned one, above the other
  EXPECT_EQ(below(1000, 60), "fine 6");
  EXPECT_EQ(harvester_->getStats().files, 4u);
}

TEST_F(OsgHarvester, TakesNothingTwice) {
  write("root.osgt", *tile(0, slab(0, 1, "coarse"), "one.osgt"));
  write("one.osgt", *slab(0, 3, "fine"));
  start();
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(read("root.osgt"));
    ASSERT_TRUE(read("one.osgt"));
    EXPECT_EQ(below(0), "fine 3");
  }
  EXPECT_EQ(harvester_->getStats().files, 2u);
}

TEST_F(OsgHarvester, TakesGraphsThatAreNoFiles) {
  write("one.osgt", *slab(0, 3, "fine"));
  write("sky.osgt", *slab(0, 9, "sky"));
  start();
  harvester_->setTakesUnnamedFiles(false);
  const auto lod = tile(0, slab(0, 1, "coarse"), "one.osgt");
  lod->setDatabasePath(folder_.path().string());
  harvester_->add(*group({lod, slab(30, 0, "made")}), osg::Matrixd::translate(0, 0, 2));
  EXPECT_EQ(below(0), "coarse 3");
  EXPECT_EQ(below(30), "made 2");
  ASSERT_TRUE(read("sky.osgt"));
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "fine 5");
}

TEST_F(OsgHarvester, WaitsForAllFilesOfALevel) {
  osg::ref_ptr<osg::PagedLOD> lod = tile(0, slab(0, 1, "coarse"), "one.osgt");
  lod->setFileName(2, "two.osgt");
  lod->setRange(2, 500.0f, 1e9f);
  write("root.osgt", *lod);
  write("one.osgt", *slab(-5, 3, "left"));
  write("two.osgt", *slab(5, 4, "right"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(-3), "coarse 1");
  ASSERT_TRUE(read("two.osgt"));
  EXPECT_EQ(below(-3), "left 3");
  EXPECT_EQ(below(3), "right 4");
}

TEST_F(OsgHarvester, GoesThroughLevelsOfOneNodeInTurn) {
  osg::ref_ptr<osg::PagedLOD> lod = tile(0, slab(0, 1, "coarse"), "one.osgt");
  lod->setRange(1, 500.0f, 1000.0f);
  lod->setFileName(2, "two.osgt");
  lod->setRange(2, 1000.0f, 1e9f);
  write("root.osgt", *lod);
  write("one.osgt", *slab(0, 3, "medium"));
  write("two.osgt", *slab(0, 4, "fine"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(0), "medium 3");
  ASSERT_TRUE(read("two.osgt"));
  EXPECT_EQ(below(0), "fine 4");
}

TEST_F(OsgHarvester, KeepsWhatFinerFilesAddTo) {
  osg::ref_ptr<osg::PagedLOD> lod = tile(0, slab(0, 1, "ground"), "one.osgt");
  lod->setRange(0, 0.0f, 1e9f);
  write("root.osgt", *lod);
  write("one.osgt", *slab(5, 3, "house"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(-3), "? 8");  // a house may be anywhere in it
  ASSERT_TRUE(read("one.osgt"));
  EXPECT_EQ(below(-3), "ground 1");
  EXPECT_EQ(below(3), "house 3");
}

TEST_F(OsgHarvester, TakesProxies) {
  osg::ref_ptr<osg::ProxyNode> proxy = new osg::ProxyNode;
  proxy->setFileName(0, "one.osgt");
  proxy->setLoadingExternalReferenceMode(osg::ProxyNode::DEFER_LOADING_TO_DATABASE_PAGER);
  proxy->setCenterMode(osg::ProxyNode::USER_DEFINED_CENTER);
  proxy->setRadius(8.0f);
  write("root.osgt", *group({proxy}));
  write("one.osgt", *slab(0, 3, "fine"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(0), "? 8");
  // A pager looks for it where its options say: proxies do not say where they were read.
  osg::ref_ptr<osgDB::Options> options = new osgDB::Options;
  options->setDatabasePath(folder_.path().string());
  ASSERT_NE(osgDB::readRefNodeFile("one.osgt", options), nullptr);
  EXPECT_EQ(below(0), "fine 3");
}

TEST_F(OsgHarvester, TakesWhatIsReadWhileAFileIsReadAsPartOfIt) {
  osg::ref_ptr<osg::ProxyNode> proxy = new osg::ProxyNode;
  proxy->setFileName(0, path("one.osgt"));
  proxy->setLoadingExternalReferenceMode(osg::ProxyNode::LOAD_IMMEDIATELY);
  osg::ref_ptr<osg::MatrixTransform> moved = new osg::MatrixTransform(osg::Matrixd::translate(0, 0, 7));
  moved->addChild(proxy);
  write("root.osgt", *group({moved}));
  write("one.osgt", *slab(0, 3, "inner"));
  start();
  ASSERT_TRUE(read("root.osgt"));
  EXPECT_EQ(below(0), "inner 10");
  EXPECT_EQ(harvester_->getStats().files, 1u);
}

TEST_F(OsgHarvester, EndsWhereFilesNameThemselves) {
  write("root.osgt", *tile(0, slab(0, 1, "coarse"), "one.osgt"));
  write("one.osgt", *group({tile(0, slab(0, 2, "medium"), "root.osgt"), tile(30, slab(30, 2, "self"), "one.osgt")}));
  start();
  ASSERT_TRUE(read("root.osgt"));
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(read("one.osgt"));
    ASSERT_TRUE(read("root.osgt"));
  }
  EXPECT_EQ(harvester_->getStats().files, 2u);
  EXPECT_EQ(below(0), "medium 2");
  EXPECT_EQ(below(30), "self 2");
}

TEST_F(OsgHarvester, TakesFilesFromManyThreads) {
  constexpr int tiles = 40;
  osg::ref_ptr<osg::Group> root = new osg::Group;
  for (int i = 0; i < tiles; ++i) {
    const std::string name = "tile" + std::to_string(i) + ".osgt";
    root->addChild(tile(20.0 * i, i % 2 == 0 ? slab(20.0 * i, 1, "coarse") : nullptr, name));
    if (i % 5 != 4) write(name, *slab(20.0 * i, 3, "fine"));
  }
  write("root.osgt", *root);
  start();
  ASSERT_TRUE(read("root.osgt"));
  std::vector<std::thread> readers;
  for (int r = 0; r < 4; ++r) {
    readers.emplace_back([&, r] {
      for (int i = 0; i < 2 * tiles; ++i) read("tile" + std::to_string((i * 7 + r * 11) % tiles) + ".osgt");
    });
  }
  for (int i = 0; i < 50; ++i) {
    below(20.0 * (i % tiles));
    static_cast<void>(harvester_->getStats());
  }
  for (std::thread& reader : readers) reader.join();
  for (int i = 0; i < tiles; ++i) {
    EXPECT_EQ(below(20.0 * i), i % 5 != 4 ? "fine 3" : i % 2 == 0 ? "coarse 1" : "? 8") << i;
  }
  EXPECT_EQ(harvester_->getStats().files, 1u + 32u);
  EXPECT_EQ(harvester_->getStats().failed, 8u);
}

TEST_F(OsgHarvester, RefusesToHarvestIntoNothing) {
  EXPECT_THROW(osg::ref_ptr<Harvester>(new Harvester(nullptr)), roam::Error);
}

}  // namespace
