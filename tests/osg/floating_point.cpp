// Bodies moved through a scene graph, in every floating-point environment of a host.

#include <gtest/gtest.h>

#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <vector>

#include "clutter.h"
#include "osgRoam/BoxIntersector.h"
#include "same_bits.h"

namespace {

using same_bits::Bits;
using same_bits::expect_same;

TEST(FloatingPoint, IntersectionsWithASceneGraph) {
  clutter::Random random(3);
  const roam::Mesh mesh = clutter::make(random, {.count = 300});
  osg::ref_ptr<osg::Vec3dArray> corners = new osg::Vec3dArray;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    for (const roam::Vec3& v : mesh.triangle(i)) corners->push_back({v.x, v.y, v.z});
  }
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(corners);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_TRIANGLES, 0, static_cast<int>(corners->size())));
  osg::ref_ptr<osg::MatrixTransform> turned =
      new osg::MatrixTransform(osg::Matrixd::rotate(0.3, 0.1, 0.7, 0.2) * osg::Matrixd::translate(0.1, 0.2, 0.3));
  turned->addChild(geometry);
  struct Query {
    roam::Body body;
    osg::Vec3d from, to;
  };
  std::vector<Query> queries;
  for (int i = 0; i < 60; ++i) {
    const roam::Body body{random.between(0.0, 0.5), random.between(0.0, 0.5)};
    const roam::Vec3 from = random.in_box(5.0), to = from + random.in_box(3.0);
    queries.push_back({body, {from.x, from.y, from.z}, {to.x, to.y, to.z}});
  }
  const double margin = osgRoam::boundsMargin(*turned);
  expect_same([&](Bits& bits) {
    for (const Query& q : queries) {
      const osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector(q.body, q.from, q.to);
      box->setBoundsMargin(margin);
      osgUtil::IntersectionVisitor visitor(box);
      turned->accept(visitor);
      const auto first = box->getFirstIntersection();
      bits(first.time);
      bits(first.distance);
    }
  });
}

}  // namespace
