#include "store/pager/tracked_body.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "roam/pager.h"

namespace roam::paging {
namespace {

/// Metres per second. A body at rest may begin to run.
constexpr double least_pace = 4.0;

/// Metres, and seconds at the present speed: items nearer than their sum are not evicted.
constexpr double held_distance = 0.25, held_seconds = 0.1;

/// Changes of position and velocity below these need no new plan: metres, and metres per second.
constexpr double same_place = 0.25, same_velocity = 1.0;

}  // namespace

TrackedBody::TrackedBody(const Body& body, const Vec3& place, const Vec3& velocity)
    : body_(body),
      place_(place),
      velocity_(velocity),
      speed_(glm::length(velocity)),
      pace_(std::max(least_pace, speed_)) {}

Vec3 TrackedBody::way_to(const Box& box) const {
  Vec3 way;
  for (int k = 0; k < 3; ++k) {
    const double tall = k == 2 ? body_.half_height : 0.0;
    way[k] = std::max(box.lower[k] - tall - place_[k], 0.0) + std::min(box.upper[k] + tall - place_[k], 0.0);
  }
  return way;
}

double TrackedBody::gap(const Box& box) const {
  return std::max(0.0, glm::length(way_to(box)) - body_.radius - Pager::margin);
}

double TrackedBody::time_to(const Box& box) const {
  const Vec3 way = way_to(box);
  const double length = glm::length(way), distance = length - body_.radius - Pager::margin;
  if (!(distance > 0.0)) return 0.0;
  const double turn = speed_ > 0.0 ? 1.0 - glm::dot(way, velocity_) / (length * speed_) : 0.0;
  return distance / pace_ * (1.0 + turn);
}

bool TrackedBody::holds(const Box& box) const { return gap(box) <= held_distance + held_seconds * speed_; }

bool TrackedBody::like(const TrackedBody& other) const {
  return body_.radius == other.body_.radius && glm::length(place_ - other.place_) < same_place &&
         glm::length(velocity_ - other.velocity_) < same_velocity;
}

}  // namespace roam::paging
