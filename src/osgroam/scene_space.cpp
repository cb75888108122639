#include <algorithm>
#include <map>
#include <osg/observer_ptr>

#include "local_triangle.h"
#include "math/floating_point.h"
#include "osgRoam/BoxIntersector.h"
#include "osgRoam/SceneSpace.h"
#include "osg_triangles/mesh_of.h"
#include "scene_visitor.h"
#include "sphere_box.h"
#include "vectors.h"
#include "world/query.h"
#include "world/unknown.h"

namespace osgRoam {
namespace {

/// Numbers what queries come upon, for as long as it is there.
class Numbers {
 public:
  /// Bits of a number that are left to the triangles of a drawable: its primitives, and the halves of each.
  static constexpr unsigned bits = 33;

  /// The first of the numbers of what `what` on `path` holds.
  roam::TriangleId base(const osg::NodePath& path, osg::Node* what, const std::string& name) {
    if (first_seen_.size() >= forget_at_) forget();
    std::vector<const osg::Node*> key(path.begin(), path.end());
    key.push_back(what);
    const auto seen = first_seen_.find(key);
    // Another object may have got the place in memory of one that has gone.
    if (seen != first_seen_.end() && known_.at(seen->second).what.get() == what) return seen->second << bits;
    known_[next_] = {what, name};
    first_seen_[std::move(key)] = next_;
    return next_++ << bits;
  }

  [[nodiscard]] std::string name(roam::TriangleId triangle) const {
    const auto known = known_.find(triangle >> bits);
    return known == known_.end() ? "" : known->second.name;
  }

 private:
  struct Known {
    osg::observer_ptr<osg::Node> what;
    std::string name;
  };

  void forget() {
    for (auto seen = first_seen_.begin(); seen != first_seen_.end();) {
      if (known_.at(seen->second).what.valid()) {
        ++seen;
      } else {
        seen = first_seen_.erase(seen);
      }
    }
    for (auto known = known_.begin(); known != known_.end();) {
      known = known->second.what.valid() ? std::next(known) : known_.erase(known);
    }
    constexpr std::size_t few = 1024;
    forget_at_ = std::max(few, 2 * first_seen_.size());
  }

  std::map<std::vector<const osg::Node*>, roam::TriangleId> first_seen_;
  std::map<roam::TriangleId, Known> known_;
  roam::TriangleId next_ = 0;
  std::size_t forget_at_ = 1024;
};

constexpr std::size_t unplaced_limit = 100;

std::string name_on(const osg::NodePath& path, const osg::Drawable& drawable) {
  std::vector<std::string> names;
  for (const osg::Node* node : path) names.push_back(node->getName());
  names.push_back(drawable.getName());
  return roam::osg_triangles::innermost(names);
}

}  // namespace

struct SceneSpace::State {
  osg::ref_ptr<osg::Node> scene;
  roam::Vec3 origin{0.0};
  osg::ref_ptr<osgUtil::IntersectionVisitor::ReadCallback> read;
  bool kd_tree = true;
  double margin = 0.0;
  Numbers numbers;
  std::vector<std::string> unplaced;

  /// Sends the body, grown by `reach`, through the graph; it comes back with what it met. `from` is in its frame.
  struct Visit {
    osg::ref_ptr<BoxIntersector> box;
    SceneVisitor visitor;

    Visit(State& state, const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion, bool gather)
        : box(new BoxIntersector(body, to_osg(from), to_osg(from + motion))), visitor(box, state.read) {
      box->setBoundsMargin(state.margin);
      box->setGatherCandidates(gather);
      visitor.setUseKdTreeWhenAvailable(state.kd_tree);
      state.scene->accept(visitor);
      for (const std::string& file : visitor.unplaced()) state.note_unplaced(file);
    }
  };

  void note_unplaced(const std::string& file) {
    if (unplaced.size() < unplaced_limit && std::find(unplaced.begin(), unplaced.end(), file) == unplaced.end()) {
      unplaced.push_back(file);
    }
  }

  /// The box of all that queries can meet, in the frame of the graph, found without its spheres.
  roam::Box everything() {
    // A body that reaches everywhere.
    const Visit visit(*this, {2.0 * coordinate_limit}, roam::Vec3(0.0), roam::Vec3(0.0), true);
    roam::Box box;
    for (const auto& candidate : visit.box->getCandidates()) {
      for (const roam::Vec3& corner : candidate.triangle) box.include(corner);
    }
    for (const auto& unknown : visit.visitor.unknown()) box.include(unknown.box);
    return box;
  }

  roam::TriangleId number(const SceneVisitor::Unknown& unknown) {
    return numbers.base(unknown.path, unknown.path.back(), unknown.file);
  }

  void collect(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion, double reach,
               roam::query::Collector& collector) {
    const Visit visit(*this, {body.radius + reach, body.half_height}, from, motion, true);
    const auto& drawables = visit.box->getCandidateDrawables();
    std::vector<roam::TriangleId> base;
    base.reserve(drawables.size());
    for (const auto& d : drawables) {
      base.push_back(numbers.base(d.nodePath, d.drawable, name_on(d.nodePath, *d.drawable)));
    }
    for (const auto& candidate : visit.box->getCandidates()) {
      const auto triangle = seen_from(from, candidate.triangle);
      const auto offer = [&](const roam::certified::LocalTriangle& part) {
        roam::Contact contact;
        static_cast<roam::Proximity&>(contact) =
            motion == roam::Vec3(0.0) ? roam::certified::proximity(body, part)
                                      : roam::certified::approach(body, motion, part, 0.0, 1.0).proximity;
        contact.point += from;
        contact.triangle = base[candidate.drawable] + 2 * roam::TriangleId{candidate.primitiveIndex} + candidate.half;
        collector.offer(contact);
      };
      if (collector.floor() == nullptr) {
        offer(triangle);
      } else {
        for (const auto& part : collector.floor()->pieces(triangle)) offer(part);
      }
    }
    for (const auto& unknown : visit.visitor.unknown()) {
      if (!collector.takes_unknown(unknown.box, body.radius, 0.0)) continue;
      roam::Contact contact = roam::unknown::nearest(unknown.box, 0.0, body, from, motion);
      contact.unknown = true;
      contact.triangle += number(unknown);
      collector.offer(contact);
    }
  }
};

SceneSpace::SceneSpace(osg::Node* scene, const osg::Vec3d& origin) : _state(std::make_unique<State>()) {
  if (scene == nullptr)
    throw roam::Error("osgRoam::SceneSpace needs a scene graph; the one that it was given is null.");
  _state->scene = scene;
  _state->origin = to_roam(origin);
  _state->margin = boundsMargin(*scene);
}

SceneSpace::~SceneSpace() = default;

void SceneSpace::setReadCallback(osgUtil::IntersectionVisitor::ReadCallback* callback) { _state->read = callback; }
void SceneSpace::setUseKdTreeWhenAvailable(bool use) { _state->kd_tree = use; }
void SceneSpace::setBoundsMargin(double margin) {
  checkBoundsMargin(margin);
  _state->margin = margin;
}

roam::Impact SceneSpace::sweep(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion) const {
  const roam::DefaultFloatingPoint guard;
  roam::query::check(body, from, motion);
  const roam::Vec3 start = from - _state->origin;
  const State::Visit visit(*_state, body, start, motion, false);
  roam::Impact result;
  if (visit.box->containsIntersections()) {
    const auto hit = visit.box->getFirstIntersection();
    result.hit = true;
    result.time = hit.time;
    result.point = to_roam(hit.worldIntersectionPoint);
    result.normal = to_roam(hit.worldIntersectionNormal);
    result.feature = hit.feature;
    result.distance = hit.distance;
    result.triangle = _state->numbers.base(hit.nodePath, hit.drawable, name_on(hit.nodePath, *hit.drawable)) +
                      2 * roam::TriangleId{hit.primitiveIndex} + hit.half;
  }
  for (const auto& unknown : visit.visitor.unknown()) {
    roam::Impact border = roam::unknown::sweep(unknown.box, 0.0, body, start, motion);
    if (!border.hit) continue;
    if (result.hit && (border.time != result.time ? border.time > result.time : border.distance >= result.distance)) {
      continue;
    }
    border.unknown = true;
    border.triangle += _state->number(unknown);
    result = border;
  }
  if (result.hit) result.point += _state->origin;
  return result;
}

std::size_t SceneSpace::contacts(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion, double reach,
                                 std::span<roam::Contact> contacts) const {
  const roam::DefaultFloatingPoint guard;
  roam::query::check(body, from, motion);
  roam::query::check_reach(reach);
  if (contacts.empty()) return 0;
  roam::query::Collector collector(reach, contacts, false);
  _state->collect(body, from - _state->origin, motion, reach, collector);
  collector.sort();
  for (roam::Contact& c : contacts.first(collector.count())) c.point += _state->origin;
  return collector.count();
}

roam::Clearance SceneSpace::clearance(const roam::Body& body, const roam::Vec3& from, const roam::Vec3& motion,
                                      double reach) const {
  const roam::DefaultFloatingPoint guard;
  roam::Contact nearest;
  const std::size_t found = contacts(body, from, motion, reach, {&nearest, 1});
  return roam::query::clearance_of(found == 0 ? nullptr : &nearest, reach);
}

roam::Clearance SceneSpace::floor_clearance(const roam::Body& body, const roam::Vec3& place, double reach,
                                            const roam::Floor& floor) const {
  const roam::DefaultFloatingPoint guard;
  const roam::Vec3 seen = place - _state->origin;
  roam::Floor moved = floor;
  moved.point -= _state->origin;
  roam::Clearance result = roam::query::floor_clearance_of(
      body, seen, reach, moved, [&](const roam::Vec3& way, roam::query::Collector& collector) {
        _state->collect(body, seen, way, reach, collector);
      });
  if (result.found) result.point += _state->origin;
  return result;
}

roam::Box SceneSpace::bounds() const {
  const roam::DefaultFloatingPoint guard;
  roam::Box box = boxOf(_state->scene->getBound(), osg::Matrixd::identity());
  // One vertex that is not finite spoils the spheres of all that it is in.
  if (box.empty()) box = _state->everything();
  if (box.empty()) return box;
  return {box.lower + (_state->origin - _state->margin), box.upper + (_state->origin + _state->margin)};
}

std::vector<std::string> SceneSpace::getUnplacedFiles() const { return _state->unplaced; }

std::string SceneSpace::object_name(roam::TriangleId triangle) const { return _state->numbers.name(triangle); }

}  // namespace osgRoam
