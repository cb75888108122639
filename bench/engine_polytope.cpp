// osgUtil::PolytopeIntersector with the box of the swept body, and one geode for each object of the scene, as in a
// file. It gives no time of impact. It only tests whether any triangle is in the box, and stops at the first one, its
// fastest setting. Its false hits lie in the box's corners.

#include <osg/KdTree>
#include <osg/Version>
#include <osgUtil/IntersectionVisitor>
#include <osgUtil/PolytopeIntersector>

#include "engine.h"
#include "memory.h"
#include "osg_scene.h"

namespace roam::bench {

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
    group->getBound();  // computed on first use, so that no query pays for it
  });
  engine.bytes = allocated_bytes() - before;
  engine.ask = timed([group](const Query& query) {
    const Vec3 reach = Vec3(query.body.radius) + Vec3(0.0, 0.0, query.body.half_height);
    osg::ref_ptr<osgUtil::PolytopeIntersector> intersector = new osgUtil::PolytopeIntersector(
        osgUtil::Intersector::MODEL, box_of_sweep(reach, query.from, query.from + query.motion));
    intersector->setPrimitiveMask(osgUtil::PolytopeIntersector::TRIANGLE_PRIMITIVES);
    intersector->setIntersectionLimit(osgUtil::Intersector::LIMIT_ONE);
    osgUtil::IntersectionVisitor visitor(intersector);
    group->accept(visitor);
    return Answer{intersector->containsIntersections(), 0.0};
  });
  return engine;
}

}  // namespace roam::bench
