// Sweeps of a sphere through a scene graph: through the still walls by an index, which is built once, and through a
// door that turns by an intersector, which builds no index: each visit sees the graph as it is at that moment.
#include <osgRoam/BoxIntersector.h>
#include <osgRoam/Triangles.h>

#include <cstdio>
#include <osg/Geometry>
#include <osg/MatrixTransform>
#include <osgUtil/IntersectionVisitor>

namespace {

/// An upright rectangle 2 m high, from x0 to x1 in the plane of that y.
osg::ref_ptr<osg::Geometry> upright(const char* name, float x0, float x1, float y) {
  osg::ref_ptr<osg::Vec3Array> corners = new osg::Vec3Array;
  for (const auto& [x, z] : {std::pair{x0, 0}, {x1, 0}, {x1, 2}, {x0, 2}}) corners->push_back(osg::Vec3(x, y, z));
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(corners);
  geometry->addPrimitiveSet(new osg::DrawArrays(GL_QUADS, 0, 4));
  geometry->setName(name);
  return geometry;
}

}  // namespace

int main() {
  osg::ref_ptr<osg::Group> house = new osg::Group;
  house->addChild(upright("left wall", -3, 0, 0));
  house->addChild(upright("right wall", 1, 4, 0));
  house->addChild(upright("back wall", -3, 4, 3));
  const roam::World walls = osgRoam::buildWorld(*house);

  // The door leaf, hinged at the origin.
  osg::ref_ptr<osg::MatrixTransform> hinge = new osg::MatrixTransform;
  hinge->addChild(upright("leaf", 0, 1, 0));
  // For graphs whose transforms turn and scale unevenly: OpenSceneGraph makes their bounding spheres too small. Here 0.
  const double margin = osgRoam::boundsMargin(*hinge);

  const roam::Body body{.radius = 0.2};
  const osg::Vec3d from(0.6, -2, 1), to(0.6, 4, 1);
  const roam::Impact wall = walls.sweep(body, {from.x(), from.y(), from.z()}, {0, to.y() - from.y(), 0});
  for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
    hinge->setMatrix(osg::Matrixd::rotate(osg::DegreesToRadians(degrees), osg::Vec3d(0, 0, 1)));
    osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector(body, from, to);
    box->setBoundsMargin(margin);
    osgUtil::IntersectionVisitor visitor(box);
    hinge->accept(visitor);

    std::printf("door open %.0f degrees: ", degrees);
    const osgRoam::BoxIntersector::Intersections& hits = box->getIntersections();  // earliest first
    if (hits.empty() || wall.time < hits.begin()->time) {
      std::printf("stops at y = %.3f m, before the %s\n", from.y() + wall.time * (to.y() - from.y()),
                  walls.object_name(wall.triangle).c_str());
    } else {
      std::printf("stops at y = %.3f m, before the %s of \"%s\"\n", from.y() + hits.begin()->time * (to.y() - from.y()),
                  roam::to_string(hits.begin()->feature), hits.begin()->drawable->getName().c_str());
    }
  }
  return 0;
}
