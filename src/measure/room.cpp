#include "measure/room.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace roam::measure {
namespace {

constexpr double side_reach = 12.0;  ///< radii

double slimmed(const Body& body) { return std::min(slimmer, 0.25 * body.radius); }

/// A sweep may end 2 mm before the contact; the body can go on by the certified gap at least.
double travelled(const Impact& hit, double far) { return hit.time * far + std::max(0.0, hit.distance); }

}  // namespace

Room::Room(const Space& space, const WalkerSettings& settings, Mode mode, double least_reach)
    : space_(space),
      settings_(settings),
      mode_(mode),
      reach_(std::min(std::max(side_reach * settings.radius, least_reach), Space::reach_limit - settings.radius)),
      slope_cosine_(std::cos(glm::radians(settings.slope_degrees))) {}

Free Room::beside(const Body& body, const Vec3& centre, const Vec3& side) const {
  const double less = slimmed(body);
  Body slim = body;
  slim.radius -= less;
  Vec3 place = centre;
  if (mode_ == Mode::walk) {
    // The legs are lifted over what is stepped onto; a body that is hardly taller than wide is lifted as a whole.
    const double low = std::min(settings_.step, 2.0 * body.half_height);
    slim.half_height -= 0.5 * low;
    place.z += 0.5 * low;
    const double rest = settings_.step - low;
    if (rest > 0.0) {
      const FirstImpact up = space_.first_impact(slim, place, {0.0, 0.0, rest});
      place.z += up.hit ? up.time * rest : rest;
    }
  }
  const double far = reach_ + less;
  const Impact hit = space_.sweep(slim, place, far * side);
  // Ground that rises gently to the side is no wall.
  const bool is_ground = mode_ == Mode::walk && hit.normal.z > slope_cosine_;
  if (!hit.hit || is_ground) return {reach_, false, no_triangle};
  return {std::clamp(travelled(hit, far) - less, 0.0, reach_), !hit.unknown, hit.triangle};
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
