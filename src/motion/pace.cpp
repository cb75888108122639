#include "motion/pace.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "motion/state.h"

namespace roam::walking {
namespace {

/// Metres covered in `seconds`: uniform change from one speed to another in `change` seconds, then constant speed.
double gone(double from, double to, double change, double seconds) {
  const double changing = std::min(change, seconds);
  const double reached = change > 0.0 ? from + (to - from) * (changing / change) : to;
  return 0.5 * (from + reached) * changing + reached * (seconds - changing);
}

double rate(double from, double to, const WalkerInput& limits) {
  return to < from ? limits.braking : limits.acceleration;
}

double change_seconds(double from, double to, const WalkerInput& limits) {
  return std::abs(to - from) / rate(from, to, limits);
}

/// Seconds to cover `way` metres: uniform change from one speed to another in `change` seconds, then constant speed.
double seconds_until(double way, double from, double to, double change) {
  const double changing = 0.5 * (from + to) * change;
  if (way >= changing) return to > 0.0 ? change + (way - changing) / to : change;
  const double growth = (to - from) / change;
  return 2.0 * way / (from + std::sqrt(std::max(0.0, from * from + 2.0 * growth * way)));
}

}  // namespace

Vec3 Pace::velocity(double after) const {
  if (after < braking) return from + (slowest - from) * (after / braking);
  after -= braking;
  return after < gaining ? slowest + (to - slowest) * (after / gaining) : to;
}

Vec3 Pace::mean(double over) const {
  const double slower = std::min(braking, over), faster = std::min(gaining, over - slower);
  const Vec3 between = velocity(slower);
  return ((0.5 * slower) * (from + between) + (0.5 * faster) * (between + velocity(slower + faster)) +
          (over - slower - faster) * to) /
         over;
}

Pace change(const Vec3& from, const WalkerInput& wish) {
  const Vec3 by = wish.velocity - from;
  const double whole = glm::length(by);
  if (!(whole > 0.0)) return {from, from, from};
  const double slower = std::clamp(-glm::dot(from, by) / (whole * whole), 0.0, 1.0);
  return {from, from + by * slower, wish.velocity, slower * whole / wish.braking,
          (1.0 - slower) * whole / wish.acceleration};
}

Approach approach(double speed, double most, double goal, double until_rest, double seconds,
                  const WalkerInput& limits) {
  const auto way = [&](double to) { return gone(speed, to, change_seconds(speed, to, limits), seconds); };
  double slow = std::max(0.0, speed - limits.braking * seconds);
  double fast = std::max(slow, std::min(most, speed + limits.acceleration * seconds));
  const auto can_stop = [&](double to) { return way(to) + 0.5 * to * to / limits.braking <= until_rest; };
  if (can_stop(fast)) {
    slow = fast;
  } else if (can_stop(slow)) {
    // Until the speed is as exact as a double; it is very small if the step is very long.
    for (double middle = 0.5 * (slow + fast); slow < middle && middle < fast; middle = 0.5 * (slow + fast)) {
      (can_stop(middle) ? slow : fast) = middle;
    }
  }
  Approach step{slow, seconds, way(slow)};
  const double change = change_seconds(speed, slow, limits);
  if (step.way > goal || (!(slow > 0.0) && change < seconds)) {
    step.seconds = std::min(seconds, seconds_until(goal, speed, slow, change));
    step.way = std::min(step.way, goal);
  }
  return step;
}

}  // namespace roam::walking

namespace roam {

Vec3 Walker::State::moved() const {
  Vec3 way(0.0), at = report_.from;
  for (const Segment& c : report_.segments) {
    if (!c.teleport) way += c.position - at;
    at = c.position;
  }
  return way;
}

Vec3 Walker::State::velocity() const { return report_.elapsed > 0.0 ? moved() / report_.elapsed + riding_ : Vec3(0.0); }

Vec3 Walker::State::pace() const {
  if (held() || report_.put_back) return Vec3(0.0);
  Vec3 pace = in_the_end_;
  Vec3 moved = report_.elapsed > 0.0 ? this->moved() / report_.elapsed : Vec3(0.0);
  if (mode_ == Mode::walk) pace.z = moved.z = 0.0;
  if (!report_.blocked && !report_.has(EventKind::slid) && !report_.has(EventKind::slowed)) return pace;
  const double speed = glm::length(moved), most = glm::length(wished_);
  if (!(speed > 0.0 && most > 0.0)) return Vec3(0.0);
  // Along the slide, and no larger part of it than the body made of its way.
  const Vec3 along = moved / speed;
  return along * std::clamp(glm::dot(pace, along), 0.0, glm::length(pace) * std::min(1.0, speed / most));
}

}  // namespace roam
