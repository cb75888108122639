// osgUtil::PolytopeIntersector with the box of the swept body, one geode for each object of the scene, as a file would
// bring them. It gives no time of impact: it is asked whether any triangle is in the box, and stops at the first one,
// its fastest setting. Its false hits are the box's corners.

#include <osg/Geode>
#include <osg/Geometry>
#include <osg/KdTree>
#include <osg/Version>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/PolytopeIntersector>

#include "engine.h"
#include "memory.h"

namespace roam::bench {
namespace {

osg::ref_ptr<osg::Geode> to_geode(const Mesh& mesh) {
  osg::ref_ptr<osg::Vec3Array> vertices = new osg::Vec3Array;
  vertices->reserve(mesh.vertices.size());
  for (const Vec3& v : mesh.vertices) vertices->push_back(osg::Vec3(osg::Vec3d(v.x, v.y, v.z)));
  osg::ref_ptr<osg::DrawElementsUInt> indices = new osg::DrawElementsUInt(GL_TRIANGLES);
  indices->reserve(3 * mesh.triangles.size());
  for (const auto& triangle : mesh.triangles) indices->insert(indices->end(), triangle.begin(), triangle.end());
  osg::ref_ptr<osg::Geometry> geometry = new osg::Geometry;
  geometry->setVertexArray(vertices);
  geometry->addPrimitiveSet(indices);
  osg::ref_ptr<osg::Geode> geode = new osg::Geode;
  geode->addDrawable(geometry);
  return geode;
}

osg::Polytope box_of(const Query& query) {
  osg::Polytope polytope;
  for (int k = 0; k < 3; ++k) {
    const double grown = query.body.radius + (k == 2 ? query.body.half_height : 0.0);
    const double a = query.from[k];
    const double b = query.from[k] + query.motion[k];
    osg::Vec3d axis;
    axis[k] = 1;
    polytope.add(osg::Plane(axis, grown - std::min(a, b)));
    polytope.add(osg::Plane(-axis, grown + std::max(a, b)));
  }
  return polytope;
}

}  // namespace

Engine make_polytope(const Scene& scene, bool with_kd_tree) {
  Engine engine{.name = std::string("OSG ") + osgGetVersion() + (with_kd_tree ? " polytope, KdTree" : " polytope"),
                .used = "PolytopeIntersector, one geode an object",
                .says_when = false};
  const std::size_t before = allocated_bytes();
  osg::ref_ptr<osg::Group> group = new osg::Group;
  engine.build_one = seconds([&] {
    for (const Mesh& mesh : scene.meshes) group->addChild(to_geode(mesh));
    if (with_kd_tree) {
      osg::ref_ptr<osg::KdTreeBuilder> builder = new osg::KdTreeBuilder;
      group->accept(*builder);
    }
    group->getBound();  // computed on first use, which should not be a query's
  });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([group](const Query& query) {
    osg::ref_ptr<osgUtil::PolytopeIntersector> intersector =
        new osgUtil::PolytopeIntersector(osgUtil::Intersector::MODEL, box_of(query));
    intersector->setPrimitiveMask(osgUtil::PolytopeIntersector::TRIANGLE_PRIMITIVES);
    intersector->setIntersectionLimit(osgUtil::Intersector::LIMIT_ONE);
    osgUtil::IntersectionVisitor visitor(intersector);
    group->accept(visitor);
    return Answer{intersector->containsIntersections(), 0.0};
  });
  return engine;
}

}  // namespace roam::bench
