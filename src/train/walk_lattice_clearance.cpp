#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "train/walk_lattice_place.h"

namespace roam::training {
namespace {

/// Metres. A body is asked for with its radius less this, so that what it just touches does not count.
constexpr double slack = 5e-5;
/// Metres. Each answer that is not free takes at least this off.
constexpr double least_cut = 2e-5;
/// Points that a search keeps: each query adds one, most end after three.
constexpr std::size_t most_cuts = 48;

constexpr double unlimited = std::numeric_limits<double>::infinity();

/// A point that a body must not contain: how far beside its axis, and how high above the place.
struct Cut {
  double aside = 0.0, height = 0.0;
};

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
    // Nested bodies: what one that is too large touches bounds all that are free, and fewer than ten queries are left.
    const Clearance c = survey.world().clearance(body_of(measure, radius - slack), centre, 0.0);
    if (!c.found) return Stand{radius, 0.0};
    const double limit = capsule_limit(std::hypot(c.point.x - centre.x, c.point.y - centre.y),
                                       c.point.z - (place.z + measure.step), place.z + measure.height - c.point.z);
    radius = std::min(limit, radius - std::max(least_cut, -c.distance));
  }
  return std::nullopt;
}

/// The middle of the widest range of lifts in [0, step] at which a sphere contains none of the points; none: there is
/// no such range.
std::optional<double> free_lift(std::span<const Cut> cuts, double step, double radius) {
  std::array<std::pair<double, double>, most_cuts> taken;
  std::size_t count = 0;
  for (const Cut& c : cuts) {
    if (c.aside >= radius) continue;
    const double half = std::sqrt(radius * radius - c.aside * c.aside);
    taken[count++] = {c.height - radius - half, c.height - radius + half};
  }
  std::sort(taken.begin(), taken.begin() + static_cast<std::ptrdiff_t>(count));
  std::optional<double> best;
  double widest = -1.0, begin = 0.0;
  const auto offer = [&](double end) {
    if (end - begin > widest && end >= begin) {
      widest = end - begin;
      best = 0.5 * (begin + end);
    }
  };
  for (std::size_t i = 0; i < count; ++i) {
    offer(std::min(taken[i].first, step));
    begin = std::max(begin, taken[i].second);
  }
  offer(step);
  return best;
}

/// The largest sphere that some lift keeps off all points.
Stand largest_free(std::span<const Cut> cuts, double step, double largest) {
  if (const auto lift = free_lift(cuts, step, largest)) return {largest, *lift};
  // A sphere that is free stays so when it shrinks onto its lowest point.
  double free = 0.0, taken = largest;
  while (taken - free > 1e-7) {
    const double middle = 0.5 * (free + taken);
    (free_lift(cuts, step, middle) ? free : taken) = middle;
  }
  return {free, free_lift(cuts, step, free).value_or(0.0)};
}

std::optional<Stand> sphere_at(const Survey& survey, const Measure& measure, const Vec3& place, double largest,
                               double least) {
  std::array<Cut, most_cuts> cuts;
  Stand stand{largest, 0.5 * measure.step};
  for (std::size_t count = 0; count < most_cuts && stand.radius >= least;) {
    const Vec3 centre = centre_of(measure, place, stand);
    const Clearance c = survey.world().clearance(body_of(measure, stand.radius - slack), centre, 0.0);
    if (!c.found) return stand;
    cuts[count++] = {std::hypot(c.point.x - centre.x, c.point.y - centre.y), c.point.z - place.z};
    Stand next = largest_free({cuts.data(), count}, measure.step, stand.radius);
    if (next.radius > stand.radius - least_cut && next.lift == stand.lift)
      next.radius = stand.radius - std::max(least_cut, -c.distance);
    stand = next;
  }
  return std::nullopt;
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
