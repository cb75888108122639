#include "measure/room.h"

#include <algorithm>
#include <cmath>

#include "math/slope.h"

namespace roam::measure {
namespace {

constexpr double side_reach = 12.0;  ///< radii

double slimmed(const Body& body) { return std::min(slimmer, 0.25 * body.radius); }

/// A sweep may end 2 mm before the contact; the body can go on by the certified gap at least.
double travelled(const Impact& hit, double far) { return hit.time * far + std::max(0.0, hit.distance); }

}  // namespace

Room::Room(const Space& space, const WalkerSettings& settings, Mode mode, double least_reach)
    : space_(space),
      mode_(mode),
      step_(settings.step),
      reach_(std::min(std::max(side_reach * settings.radius, least_reach), Space::reach_limit - settings.radius)),
      least_upright_(least_upright(settings.slope_degrees)) {}

Free Room::beside(const Body& body, const Vec3& centre, const Vec3& side) const {
  const double less = slimmed(body), far = reach_ + less;
  Body slim = body;
  slim.radius -= less;
  const Impact hit = space_.sweep(slim, centre, far * side);
  if (!hit.hit) return {reach_, false, no_triangle};
  const Free free{std::clamp(travelled(hit, far) - less, 0.0, reach_), !hit.unknown, hit.triangle};
  const bool may_be_stepped_onto = hit.point.z <= step_above(body, centre) || hit.normal.z >= least_upright_;
  if (mode_ != Mode::walk || !may_be_stepped_onto) return free;
  const Free over = beside_legs_lifted(body, centre, side);
  return over.distance < free.distance ? free : over;
}

Free Room::beside_legs_lifted(const Body& body, const Vec3& centre, const Vec3& side) const {
  const double less = slimmed(body), far = reach_ + less;
  Body slim = body;
  slim.radius -= less;
  // A body that is hardly taller than wide is lifted as a whole, as far as there is room.
  const double low = std::min(step_, 2.0 * body.half_height), rest = step_ - low;
  slim.half_height -= 0.5 * low;
  Vec3 place = centre;
  place.z += 0.5 * low;
  if (rest > 0.0) {
    const FirstImpact up = space_.first_impact(slim, place, {0.0, 0.0, rest});
    place.z += up.hit ? std::max(0.0, up.time * rest - slimmer) : rest;
  }
  const Impact hit = space_.sweep(slim, place, far * side);
  if (!hit.hit || is_ground(hit, side)) return {reach_, false, no_triangle};
  double free = travelled(hit, far) - less;
  if (hit.normal.z > 0.0 && hit.point.z > step_above(body, centre)) {
    // Its lower end is round there; the body that stands is wider.
    const double beyond = std::clamp(std::abs(hit.point.z - centre.z) - body.half_height, 0.0, slim.radius);
    const double standing = std::sqrt(slim.radius * slim.radius - beyond * beyond);
    free -= std::max(0.0, standing - slim.radius * std::hypot(hit.normal.x, hit.normal.y));
  }
  return {std::clamp(free, 0.0, reach_), !hit.unknown, hit.triangle};
}

double Room::step_above(const Body& body, const Vec3& centre) const { return centre.z - 0.5 * body.height() + step_; }

/// Whether it rises as gently as ground that can be walked on. An edge may also be that of a bench.
bool Room::is_ground(const Impact& hit, const Vec3& side) const {
  if (hit.normal.z < least_upright_) return false;
  if (hit.feature == Feature::face) return true;
  constexpr double before = 0.005;  // m
  const Impact below = space_.sweep({0.0, 0.0}, hit.point - before * side, {0.0, 0.0, -step_ - before});
  return below.hit && below.normal.z >= least_upright_;
}

Free Room::headroom(const Body& body, const Vec3& centre) const {
  const double less = slimmed(body), far = height_reach * body.height();
  Body slim = body;
  slim.radius -= less;
  const Impact hit = space_.sweep(slim, centre, {0.0, 0.0, far});
  if (!hit.hit) return {far, false, no_triangle};
  return {body.height() + std::max(0.0, travelled(hit, far) - less), !hit.unknown, hit.triangle};
}

std::array<TriangleId, 2> at_ends(const Space& space, const Vec3& point, const Vec3& direction, double width) {
  constexpr double near = 0.02;  // m
  std::array<TriangleId, 2> found{no_triangle, no_triangle};
  for (std::size_t i = 0; i < 2; ++i) {
    Contact nearest;
    const Vec3 end = point + (i == 0 ? -0.5 : 0.5) * width * direction;
    if (space.contacts({0.0, 0.0}, end, Vec3(0.0), near, {&nearest, 1}) > 0) found[i] = nearest.triangle;
  }
  return found;
}

bool Room::is_passage(const Body& body, const Vec3& centre, const Vec3& heading) const {
  return beside(body, centre, heading).distance >= body.radius &&
         beside(body, centre, -heading).distance >= body.radius;
}

}  // namespace roam::measure
