// Sweeps of a sphere through a scene graph whose door turns. The intersector builds no index: each visit sees the graph
// as it is at that moment.
#include <osgRoam/BoxIntersector.h>

#include <cstdio>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgUtil/IntersectionVisitor>

namespace {

/// An upright door leaf, 1 m wide and 2 m high, hinged at the origin.
osg::ref_ptr<osg::Geometry> leaf() {
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, z] : {std::pair{0, 0}, {1, 0}, {1, 2}, {0, 2}}) corners->push_back(osg::Vec3(x, 0, z));
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(corners);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  geometry->setName("leaf");
  return geometry;
}

}  // namespace

int main() {
  osg::ref_ptr<osg::MatrixTransform> hinge = new osg::MatrixTransform;
  hinge->addChild(leaf());

  for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
    hinge->setMatrix(osg::Matrixd::rotate(osg::DegreesToRadians(degrees), osg::Vec3d(0, 0, 1)));
    osg::ref_ptr<osgRoam::BoxIntersector> box =
        new osgRoam::BoxIntersector({.radius = 0.2}, osg::Vec3d(0.6, -2, 1), osg::Vec3d(0.6, 2, 1));
    osgUtil::IntersectionVisitor visitor(box);
    hinge->accept(visitor);
    if (!box->containsIntersections()) {
      std::printf("door open %.0f degrees: passes\n", degrees);
      continue;
    }
    const auto hit = box->getFirstIntersection();
    std::printf("door open %.0f degrees: stops at y = %.3f m, before the %s of \"%s\"\n", degrees,
                -2.0 + 4.0 * hit.time, roam::to_string(hit.feature), hit.drawable->getName().c_str());
  }
  return 0;
}
