// What the collision knows, drawn: the body, what it touches, the nearest triangles.
#include <osgUtil/IntersectionVisitor>

#include "osgRoam/BoxIntersector.h"
#include "osgroam/vectors.h"
#include "view/session.h"

namespace roam::app {
namespace {

constexpr double reach = 0.25;  // m from the body's surface: what is nearer is drawn
constexpr std::size_t most_triangles = 2000;

/// The triangles of the graph that are near the body.
std::vector<std::array<Vec3, 3>> triangles_near(osg::Node& graph, const Body& body, const Vec3& place) {
  const Body wider = Body::capsule(body.radius + reach, body.height() + 2.0 * reach);
  const osg::Vec3d at = osgRoam::to_osg(place);
  const osg::ref_ptr<osgRoam::BoxIntersector> box = new osgRoam::BoxIntersector(wider, at, at);
  box->setGatherCandidates(true);
  osgUtil::IntersectionVisitor visitor(box);
  graph.accept(visitor);
  std::vector<std::array<Vec3, 3>> near;
  for (const auto& candidate : box->getCandidates()) {
    if (proximity(body, place, candidate.triangle).distance > reach) continue;
    near.push_back(candidate.triangle);
    if (near.size() == most_triangles) break;
  }
  return near;
}

}  // namespace

void Session::update_marks() {
  graphics::Marks marks;
  if (marks_ && placed_) {
    const Walker& walker = *roamer_->walker();
    const Vec3 place = walker.position() - scene_->origin();
    marks.body = graphics::BodyMark{place, walker.settings().radius, walker.report().height, walker.held()};
    for (const Contact& contact : walker.report().contacts) {
      if (!contact.unknown) marks.contacts.push_back({contact.point - scene_->origin(), contact.normal});
    }
    marks.triangles = triangles_near(scene_->group(), walker.body(), place);
  }
  stage_->overlay().set_marks(marks);
}

}  // namespace roam::app
