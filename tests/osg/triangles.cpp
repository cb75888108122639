// Which triangles of a scene graph count. tests/import/scene_graph.cpp asks the same walk about files.

#include "osgRoam/Triangles.h"

#include <gtest/gtest.h>

#include <limits>
#include <osg/Billboard>
#include <osg/PagedLOD>
#include <osg/Sequence>
#include <string>
#include <vector>

#include "osg_graphs.h"
#include "roam/error.h"

namespace {

osg::ref_ptr<osg::Geometry> triangle(const std::string& name, float x = 0.0f) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->push_back(osg::Vec3(x, 0, 0));
  vertices->push_back(osg::Vec3(0, 1, 0));
  vertices->push_back(osg::Vec3(0, 0, 1));
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, 3));
  geometry->setName(name);
  return geometry;
}

std::vector<std::string> names_of(osg::Node& node) {
  std::vector<std::string> names;
  for (const roam::Mesh& mesh : osgRoam::collectMeshes(node)) names.push_back(mesh.name);
  return names;
}

using Names = std::vector<std::string>;

TEST(OsgTriangles, AreAllThatAGraphHolds) {
  osg_graphs::Random random(41);
  for (int g = 0; g < 200; ++g) {
    const osg_graphs::Graph graph = osg_graphs::Maker(random, {.centre = {504123, 5678901, 90}}).make();
    std::vector<roam::Triangle> all;
    for (const roam::Mesh& mesh : osgRoam::collectMeshes(*graph.root)) {
      for (std::size_t i = 0; i < mesh.triangles.size(); ++i) all.push_back(mesh.triangle(i));
    }
    ASSERT_EQ(all.size(), graph.triangles.size());
    for (std::size_t i = 0; i < all.size(); ++i) {
      // Winding may differ: the centre does not.
      roam::Vec3 apart(0.0);
      for (int c = 0; c < 3; ++c) apart += all[i][c] - graph.triangles[i][c];
      ASSERT_LT(std::abs(apart.x) + std::abs(apart.y) + std::abs(apart.z), 1e-6) << g << " " << i;
    }
  }
}

TEST(OsgTriangles, AreOfTheFinestLoadedLevel) {
  osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
  lod->addChild(triangle("coarse"), 100.0f, 1000.0f);
  lod->addChild(triangle("medium"), 10.0f, 100.0f);
  lod->setFileName(2, "fine.osgb");
  lod->setRange(2, 0.0f, 10.0f);
  EXPECT_EQ(names_of(*lod), Names{"medium"});
  lod->addChild(triangle("fine"));
  EXPECT_EQ(names_of(*lod), Names{"fine"});
}

TEST(OsgTriangles, KeepWhatAMissingFileWouldHaveAddedTo) {
  osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
  lod->addChild(triangle("ground"), 0.0f, 1000.0f);
  lod->setFileName(1, "houses.osgb");
  lod->setRange(1, 0.0f, 100.0f);
  EXPECT_EQ(names_of(*lod), Names{"ground"});
}

TEST(OsgTriangles, AreOfACoarserSiblingUntilTheFinerOneIsLoaded) {
  osg::ref_ptr<osg::PagedLOD> fine = new osg::PagedLOD;
  fine->setFileName(0, "fine.osgb");
  fine->setRange(0, 0.0f, 100.0f);
  osg::ref_ptr<osg::LOD> coarse = new osg::LOD;
  coarse->addChild(triangle("floor"), 100.0f, 1e7f);
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(fine);
  scene->addChild(coarse);
  EXPECT_EQ(names_of(*scene), Names{"floor"});
  fine->addChild(triangle("fine"));
  EXPECT_EQ(names_of(*scene), Names{"fine"});
}

TEST(OsgTriangles, AreOfTheLevelThatManySiblingsContinue) {
  osg::ref_ptr<osg::LOD> fine = new osg::LOD;
  fine->addChild(triangle("fine"), 0.0f, 1.0f);
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(fine);
  // Each begins where all before it end.
  constexpr unsigned count = 60;
  for (unsigned i = 1; i < count; ++i) {
    osg::ref_ptr<osg::PagedLOD> lod = new osg::PagedLOD;
    for (unsigned j = i + 1; j <= count; ++j) {
      lod->setFileName(j - i - 1, "missing.osgb");
      lod->setRange(j - i - 1, static_cast<float>(i), static_cast<float>(j));
    }
    scene->addChild(lod);
  }
  EXPECT_EQ(names_of(*scene), Names{"fine"});
}

TEST(OsgTriangles, AreRefusedIfALevelContainsItself) {
  osg::ref_ptr<osg::Group> circle = new osg::Group;
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  for (const float nearest : {100.0f, 0.0f}) {
    osg::ref_ptr<osg::LOD> lod = new osg::LOD;
    lod->addChild(circle, nearest, nearest + 100.0f);
    scene->addChild(lod);
  }
  circle->addChild(circle);
  EXPECT_THROW(names_of(*scene), roam::Error);
  circle->removeChildren(0, 1);
}

TEST(OsgTriangles, AreMovedToTheOrigin) {
  const osg::ref_ptr<osg::Geometry> one = triangle("one", 0.25f);
  const auto meshes = osgRoam::collectMeshes(*one, osg::Vec3d(504000, 5678000, 0));
  ASSERT_EQ(meshes.size(), 1u);
  EXPECT_EQ(meshes[0].vertices[0], roam::Vec3(504000.25, 5678000.0, 0.0));
}

TEST(OsgTriangles, LeaveOutWhatCannotBeUsed) {
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  scene->addChild(triangle("good"));
  scene->addChild(triangle("not a number", std::numeric_limits<float>::quiet_NaN()));
  scene->addChild(triangle("too far", 1e30f));
  osg::ref_ptr<osg::Geometry> nowhere = triangle("leads nowhere");
  const GLuint beyond[] = {0, 1, 7};
  nowhere->setPrimitiveSet(0, new osg::DrawElementsUInt(GL_TRIANGLES, 3, beyond));
  scene->addChild(nowhere);
  EXPECT_EQ(names_of(*scene), Names{"good"});
  EXPECT_EQ(osgRoam::buildWorld(*scene).stats().triangles, 1u);
}

TEST(OsgTriangles, AreThoseOfTheScene) {
  osg::ref_ptr<osg::Billboard> billboard = new osg::Billboard;
  billboard->addDrawable(triangle("tree"));
  osg::ref_ptr<osg::Camera> display = new osg::Camera;
  display->setReferenceFrame(osg::Transform::ABSOLUTE_RF);
  display->addChild(triangle("display"));
  osg::ref_ptr<osg::Sequence> sequence = new osg::Sequence;
  sequence->addChild(triangle("first"));
  sequence->addChild(triangle("second"));
  osg::ref_ptr<osg::Group> scene = new osg::Group;
  for (osg::Node* node : {static_cast<osg::Node*>(billboard.get()), static_cast<osg::Node*>(display.get()),
                          static_cast<osg::Node*>(sequence.get())}) {
    scene->addChild(node);
  }
  EXPECT_EQ(names_of(*scene), Names{"first"});
  sequence->setValue(1);
  EXPECT_EQ(names_of(*scene), Names{"second"});
}

}  // namespace
