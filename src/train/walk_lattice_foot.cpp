#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "train/walk_lattice_place.h"

namespace roam::training {
namespace {

/// Metres. The foot is this large a ball: small enough not to ride on what a body passes by, large enough to bridge
/// the treads of stairs. A body of radius r rests higher on a slope by r (1 / cos - 1), which the knee makes good for.
constexpr double foot_radius = 0.3;
/// The least ball that is tried beside walls and posts.
constexpr double least_foot = 0.01;
/// Metres: what touches while starting, or rises above the step, by less than this does not count.
constexpr double touch = 1e-3;
/// A contact as upright as this is no rim: the foot stands on it.
constexpr double firm_cosine = 0.9;
/// Triangles of the floor that are looked at round a crack, nearest first.
constexpr std::size_t rims_looked_at = 64;

/// The largest ball whose lowest point is fixed and that has a point outside itself which lies `aside` and `above`.
double ball_beside(double aside, double above) { return (aside * aside + above * above) / (2.0 * above); }

double aside(const Vec3& p, double x, double y) { return std::hypot(p.x - x, p.y - y); }

/// The point of the floor nearest to `place` whose height is within a step of it and that is nearer than `reach`.
std::optional<Vec3> rim_near(const Survey& survey, const Measure& measure, const Vec3& place, double reach) {
  std::array<Contact, rims_looked_at> rims;
  const std::size_t count = survey.floor().contacts({0.0, 0.0}, place, Vec3(0.0), reach, rims);
  for (std::size_t i = 0; i < count; ++i) {
    if (std::abs(rims[i].point.z - place.z) <= measure.step) return rims[i].point;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vec3> floor_below(const Survey& survey, const Measure& measure, double x, double y, double level) {
  const double start = level + measure.step + 2.0 * touch;
  const double reach = 2.0 * measure.step + 4.0 * touch;
  double radius = foot_radius;
  while (radius >= least_foot) {
    const Vec3 centre(x, y, start + radius);
    const Impact s = survey.floor().sweep({radius, 0.0}, centre, Vec3(0.0, 0.0, -reach));
    if (!s.hit) return std::nullopt;
    const double beside = aside(s.point, x, y);
    if (s.distance < 0.0) {  // starts in something above the knee
      const double above = s.point.z - start;
      if (!(above > 0.0)) return std::nullopt;
      radius = std::min(0.7 * radius, 0.95 * ball_beside(beside, above));
      continue;
    }
    if (s.point.z > level + measure.step + touch) {  // a ledge that is too high to step on: stay clear of it
      radius = std::min(0.7 * radius, 0.95 * beside);
      continue;
    }
    const double lowest = start - s.time * reach;
    if (s.feature == Feature::face || s.normal.z >= firm_cosine) return Vec3(x, y, lowest);
    // On a rim: of a kerb, with floor below it, or of a crack, into which the ball has sunk.
    const double down = s.point.z + touch + least_foot - (lowest - touch - measure.step);
    const Impact below =
        survey.floor().sweep({least_foot, 0.0}, {x, y, s.point.z + touch + 2.0 * least_foot}, Vec3(0.0, 0.0, -down));
    return Vec3(x, y, below.hit ? lowest : s.point.z);
  }
  return std::nullopt;
}

std::optional<Vec3> carried_over(const Survey& survey, const Measure& measure, double x, double y, double level) {
  // Carried is what no free disc of `widest` holds. The disc that is tried touches the nearest rim and lies beyond.
  const double radius = measure.widest;
  const Vec3 place(x, y, level);
  const std::optional<Vec3> rim = rim_near(survey, measure, place, radius);
  if (!rim) return std::nullopt;
  const double beside = aside(*rim, x, y);
  if (beside > 0.0) {
    const Vec3 away = Vec3(x - rim->x, y - rim->y, 0.0) / beside;
    constexpr double inside = 0.99;  // or the rim itself would be found
    if (!rim_near(survey, measure, place + away * (radius - beside), inside * radius)) return std::nullopt;
  }
  return Vec3(x, y, rim->z);
}

}  // namespace roam::training
