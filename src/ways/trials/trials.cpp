#include "ways/trials/trials.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "math/boxes.h"
#include "math/step_limit.h"

namespace roam::ways {

namespace {

/// s. A walking body checks for ground every half radius by itself, so long time steps lose nothing.
constexpr double trial_dt = 1.0 / 30.0;
/// Steps between two calls of `goes_on`.
constexpr std::uint64_t steps_between_checks = 256;
/// m. If the walker was put this far from the start, it did not fit there.
constexpr double put_aside = 0.05;
/// m. How much lower than the planned way a body may stand on uneven floor.
constexpr double uneven = 0.02;

/// A body's centre over a foot. Lifted by part of a step if there is room, to clear the floor's bumps.
Vec3 start_over(const Survey& survey, const Body& body, const Vec3& foot, double step) {
  constexpr std::array parts{1.0, 0.5, 0.25, 0.1, 0.03, 0.01};
  for (const double part : parts) {
    const Vec3 centre = foot + Vec3(0.0, 0.0, 0.5 * body.height() + part * step);
    if (!survey.world().clearance(body, centre, 0.0).found) return centre;
  }
  return foot + Vec3(0.0, 0.0, 0.5 * body.height());
}

bool was_put_aside(const RouteResult& result, const Vec3& start) {
  const Vec3 by = result.end - start;
  return std::hypot(by.x, by.y) > put_aside && result.steps == 0;
}

/// The way's height where a body stopped on its way to `next`.
double level_at(std::span<const Vec3> way, std::size_t next, const Vec3& place) {
  if (next == 0 || next >= way.size()) return way.back().z;
  const Vec3 from = way[next - 1], along = way[next] - from;
  const double length = std::hypot(along.x, along.y);
  if (!(length > 0.0)) return std::min(from.z, way[next].z);
  const double at = ((place.x - from.x) * along.x + (place.y - from.y) * along.y) / (length * length);
  return from.z + std::clamp(at, 0.0, 1.0) * along.z;
}

/// The steps that free motion along a way takes, plus two seconds. A step ends at each place of the way.
double free_steps(std::span<const Vec3> way, double speed) {
  constexpr double more = 2.0;  // s
  double steps = more / trial_dt;
  for (std::size_t i = 1; i < way.size(); ++i) steps += 1.0 + glm::distance(way[i - 1], way[i]) / (speed * trial_dt);
  return steps;
}

}  // namespace

double largest_radius(const BodyKind& kind) {
  return kind.mode == Mode::walk && kind.height > 0.0 ? 0.5 * (kind.height - kind.step) : Space::reach_limit / 4.0;
}

WalkerSettings settings_of(const BodyKind& kind, double radius, double support_radius) {
  WalkerSettings settings = WalkerSettings::sphere(radius);
  if (kind.mode == Mode::walk && kind.height > 0.0) {
    settings.height = kind.height;
    settings.eye = kind.height;
  }
  settings.step = std::min(kind.step, step_limit(settings.height));
  settings.slope_degrees = kind.slope_degrees;
  settings.crouch_height = settings.height;
  settings.clearance_reach = 0.0;
  settings.speed = kind.speed;
  settings.support_radius = support_radius;
  return settings;
}

bool has_sunk(std::span<const Vec3> way, const RouteResult& result, const Vec3& end, double step) {
  const bool may_have_sunk = result.outcome == Outcome::blocked || result.outcome == Outcome::reached;
  return may_have_sunk && level_at(way, result.waypoints, end) - end.z > step + uneven;
}

Trial try_way(const Survey& survey, const BodyKind& kind, double radius, double support_radius,
              std::span<const Vec3> way, const std::function<bool()>& goes_on, double patience) {
  Trial trial{.radius = radius, .support_radius = support_radius};
  const WalkerSettings settings = settings_of(kind, radius, support_radius);
  const Body body = Body::capsule(settings.radius, settings.height);
  std::vector<Vec3> centres(way.begin(), way.end());
  if (kind.mode == Mode::walk) {
    for (Vec3& place : centres) place.z += 0.5 * settings.height;
    centres.front() = start_over(survey, body, way.front(), settings.step);
  }
  // A flying way may lead above or beside the scene.
  const double beyond = kind.mode == Mode::fly ? glm::length(box_around(centres).size()) : 0.0;
  const Box scene = survey.world().bounds().grown(beyond);
  Walker walker(survey.world(), settings, kind.mode, centres.front());
  Route route(walker, centres, {.speed = kind.speed, .dt = trial_dt, .scene = scene});
  const RouteResult& result = route.result();
  const bool fits = !was_put_aside(result, centres.front());
  const double most_steps = patience * free_steps(way, kind.speed);
  bool ended = false;
  while (fits && !route.done() && !ended && static_cast<double>(result.steps) < most_steps) {
    route.advance();
    ended = goes_on && result.steps % steps_between_checks == 0 && !goes_on();
  }
  trial.outcome = !fits || ended ? Outcome::held : route.done() ? result.outcome : Outcome::blocked;
  trial.at = result.end;
  const Vec3 feet = result.end - Vec3(0.0, 0.0, 0.5 * settings.height);
  if (kind.mode == Mode::walk && fits && !ended && has_sunk(way, result, feet, settings.step))
    trial.outcome = Outcome::fell;
  return trial;
}

}  // namespace roam::ways
