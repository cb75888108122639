#include "paper_ways.h"

#include <algorithm>
#include <chrono>
#include <glm/geometric.hpp>

#include "roam/generate.h"
#include "thread_clock.h"

namespace roam::bench {
namespace {

constexpr double walking_speed = 1.5;  // m/s, over the split: at 50 m/s any body flies across
constexpr double room_radius = 0.3;    // m: fits through a door of 0.75 m
constexpr double near_enough = 0.3;    // m from the end
constexpr double fallen = 2.0;         // m below the way
constexpr int window = 60;             // steps within which a body must make progress, or it is stuck
constexpr double least_progress = 0.05;

/// The distance to the end; for a walking body, seen from above.
double left(const Way& way, const Vec3& place) {
  Vec3 rest = way.to - place;
  if (way.walking) rest.z = 0.0;
  return glm::length(rest);
}

/// How far a place is below the way.
double below(const Way& way, const Vec3& place) { return std::min(way.from.z, way.to.z) - place.z; }

}  // namespace

bool arrived(const Way& way, const Vec3& place) { return left(way, place) <= near_enough; }
bool has_fallen(const Way& way, const Vec3& place) { return below(way, place) >= fallen; }

std::vector<Way> paper_ways(double radius, double split_radius) {
  const auto& paths = generate::gallery_paths;
  return {{"1 straight", paths[0].from, paths[0].to, radius},
          {"2 corner", paths[1].from, paths[1].to, radius},
          {"3 split", paths[2].from, paths[2].to, split_radius, walking_speed, true},
          {"3 split, smaller", paths[2].from, paths[2].to, radius, walking_speed, true},
          {"grotto", {-12530.66, 1538.14, 182.0}, {-12532.52, 1539.93, 182.0}, room_radius, walking_speed},
          {"grotto, adapted",
           {-12530.66, 1538.14, 182.0},
           {-12532.52, 1539.93, 182.0},
           radius,
           walking_speed,
           false,
           true}};
}

Walked walk(const Mover& mover, const Way& way, double longest) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(longest);
  const double reading = cost_of_reading();
  Walked walked;
  Vec3 place = way.from;
  walked.places.push_back(place);
  mover.place(way);
  double before = left(way, place);
  while (!arrived(way, place) && !has_fallen(way, place)) {
    walked.cut = std::chrono::steady_clock::now() >= end;
    if (walked.cut) break;
    Vec3 ahead = way.to - place;
    if (way.walking) ahead.z = 0.0;
    const double rest = glm::length(ahead);
    const Vec3 velocity = ahead * (std::min(way.speed, rest * paper_rate) / rest);
    const double begin = thread_time();
    place = mover.step(velocity);
    const double own = std::max(0.0, thread_time() - begin - reading);
    walked.nanoseconds.push_back(mover.nanoseconds ? mover.nanoseconds() : own);
    walked.radii.push_back(mover.radius ? mover.radius() : way.radius);
    walked.places.push_back(place);
    if (mover.rest) mover.rest(std::max(0.0, 1.0 / paper_rate - 1e-9 * walked.nanoseconds.back()));
    if (walked.nanoseconds.size() % window != 0) continue;
    const double progress = before - left(way, place);
    // A falling body makes no progress, but is not stuck.
    const bool falls = below(way, place) > below(way, walked.places[walked.places.size() - window]) + 0.1;
    if (progress < least_progress * way.speed * window / paper_rate && !falls) break;
    before = left(way, place);
  }
  return walked;
}

}  // namespace roam::bench
