#include <algorithm>
#include <cmath>
#include <limits>

#include "train/walk_lattice_place.h"

namespace roam::training {
namespace {

/// Metres. A body is asked for with its radius less this, so that what it just touches does not count.
constexpr double slack = 2e-5;
/// Metres. Each answer that is not free takes at least this off.
constexpr double least_cut = 1e-5;
/// Queries of one search, at most: most end after three.
constexpr std::size_t most_cuts = 48;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// The largest radius of a capsule between two fixed heights that leaves a point outside, which lies `aside` of the
/// axis, `above` the bottom and `below` the top.
double capsule_limit(double aside, double above, double below) {
  const double end = std::min(above, below);
  if (!(end > 0.0)) return unlimited;
  return aside <= end ? aside : (aside * aside + end * end) / (2.0 * end);
}

std::optional<Stand> capsule_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                                double least) {
  const Vec3 centre = centre_of(measure, place, {});
  double radius = largest;
  for (std::size_t i = 0; i < most_cuts && radius >= least; ++i) {
    // Nested bodies: what one that is too large touches bounds all that are free.
    const Clearance c = survey.world().clearance(body_of(measure, radius - slack), centre, 0.0);
    if (!c.found) return Stand{radius, 0.0};
    const double limit = capsule_limit(std::hypot(c.point.x - centre.x, c.point.y - centre.y),
                                       c.point.z - (place.z + measure.step), place.z + measure.height - c.point.z);
    radius = std::min(limit, radius - std::max(least_cut, -c.distance));
  }
  return std::nullopt;
}

/// The largest sphere at one lift, and from where it is held: the upward part of the unit vector from what it touches.
struct Held {
  double radius = 0.0, upward = 0.0;
};

/// Spheres with one lowest point are nested. Ends as soon as the radius is less than `least`.
Held sphere_lifted(const Survey& survey, const Measure& measure, const Vec3& place, double lift, double largest,
                   double least) {
  Held held{largest, 0.0};
  const double lowest = place.z + lift;
  for (std::size_t i = 0; i < most_cuts && held.radius >= least; ++i) {
    const Vec3 centre(place.x, place.y, lowest + held.radius);
    const Clearance c = survey.world().clearance(body_of(measure, held.radius - slack), centre, 0.0);
    if (!c.found) return held;
    const double aside = std::hypot(c.point.x - place.x, c.point.y - place.y), above = c.point.z - lowest;
    const double limit = above > 0.0 ? (aside * aside + above * above) / (2.0 * above) : unlimited;
    held.radius = std::min(limit, held.radius - std::max(least_cut, -c.distance));
    held.upward = (lowest + held.radius - c.point.z) / std::max(held.radius, least_cut);
  }
  if (held.radius >= least) held.radius = 0.0;
  return held;
}

/// A sphere is lifted away from what holds it from below and lowered from what holds it from above.
std::optional<Stand> sphere_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                               double least) {
  constexpr double level = 0.01;      // an upward part as small: walls, from which no lift leads away
  constexpr double fine_lift = 2e-5;  // m
  std::optional<Stand> best;
  double low = 0.0, high = measure.step;
  for (;;) {
    const double lift = 0.5 * (low + high);
    const double wanted = best ? best->radius + least_cut : least;
    const Held held = sphere_lifted(survey, measure, place, lift, largest, wanted);
    if (held.radius >= wanted) best = Stand{held.radius, lift};
    if (held.radius >= largest || std::abs(held.upward) < level || high - low < fine_lift) return best;
    (held.upward > 0.0 ? low : high) = lift;
  }
}

}  // namespace

double largest_radius(const Measure& measure) {
  if (measure.mode == Mode::fly || measure.height == 0.0) return measure.widest;
  return std::min(measure.widest, 0.5 * (measure.height - measure.step));
}

Body body_of(const Measure& measure, double radius) {
  if (measure.mode == Mode::fly || measure.height == 0.0) return {radius, 0.0};
  return {radius, std::max(0.0, 0.5 * (measure.height - measure.step) - radius)};
}

Vec3 centre_of(const Measure& measure, const Vec3& place, const Stand& stand) {
  if (measure.mode == Mode::fly) return place;
  if (measure.height == 0.0) return place + Vec3(0.0, 0.0, stand.lift + stand.radius);
  return place + Vec3(0.0, 0.0, 0.5 * (measure.height + measure.step));
}

std::optional<Stand> stand_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                              double least) {
  return measure.height == 0.0 ? sphere_at(survey, measure, place, largest, least)
                               : capsule_at(survey, measure, place, largest, least);
}

}  // namespace roam::training
