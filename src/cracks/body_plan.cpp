#include <algorithm>
#include <cmath>

#include "cracks/floor_plan.h"
#include "math/nested_ball.h"

namespace roam::cracks {

namespace {

/// The radius of the ball that stands on `bottom` and just touches `point`.
double ball_to(const Vec3& bottom, const Vec3& point) {
  const Vec3 d = point - bottom;
  return nested_ball(d.x * d.x + d.y * d.y, d.z);
}

std::vector<Contact> contacts_of(const World& world, const Body& body, const Vec3& place, double reach) {
  std::vector<Contact> contacts(32);
  std::size_t count = 0;
  while ((count = world.contacts(body, place, Vec3(0.0), reach, contacts)) == contacts.size())
    contacts.resize(4 * contacts.size());
  contacts.resize(count);
  return contacts;
}

}  // namespace

BodyPlan::BodyPlan(const Survey& survey, const FloorPlan& floor, double knee)
    : survey_(&survey), floor_(&floor), knee_(knee) {}

NearPlace BodyPlan::nearest_wall(const Vec3& place, double reach) const {
  // The balls are nested: each one in contact gives a smaller one. This converges like Newton's method for square
  // roots.
  constexpr int most_balls = 50;
  constexpr double settled = 1e-9;
  const Vec3 bottom = place + Vec3(0.0, 0.0, knee_);
  NearPlace wall{reach, place};
  for (int i = 0; i < most_balls; ++i) {
    const Vec3 centre = bottom + Vec3(0.0, 0.0, wall.distance);
    const Clearance near = survey_->world().clearance({0.0, 0.0}, centre, wall.distance);
    if (!near.found) break;
    const double ball = ball_to(bottom, near.point);
    wall.point = near.point;
    if (ball >= wall.distance - settled) break;
    wall.distance = ball;
  }
  return wall;
}

NearPlace BodyPlan::nearest(const Vec3& place, double reach) const {
  const NearPlace floor = floor_->nearest(place, reach);
  const NearPlace wall = nearest_wall(place, floor.distance);
  return wall.distance < floor.distance ? wall : floor;
}

void BodyPlan::touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const {
  floor_->touching(place, reach, slack, near);
  const NearPlace wall = nearest_wall(place, std::min(near.front().distance + slack, reach));
  if (wall.point != place) {
    near.push_back(wall);
    const Vec3 bottom = place + Vec3(0.0, 0.0, knee_);
    const Vec3 centre = bottom + Vec3(0.0, 0.0, wall.distance);
    for (const Contact& contact : contacts_of(survey_->world(), {wall.distance, 0.0}, centre, slack)) {
      const double ball = ball_to(bottom, contact.point);
      if (ball < reach) near.push_back({ball, contact.point});
    }
  }
  sort_near(near);
  const double least = near.front().distance;
  std::erase_if(near, [&](const NearPlace& n) { return n.distance > least + slack; });
}

}  // namespace roam::cracks
