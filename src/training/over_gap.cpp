#include "training/over_gap.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "cracks/floor_plan.h"
#include "motion/carrying.h"
#include "training/crossings.h"
#include "training/interval.h"

namespace roam::training {
namespace {

/// m along a way between two samples of the floor.
constexpr double look_every = 0.02;
/// m: where a body begins, floor must extend this far beyond its radius.
constexpr double around = 0.1;
/// m of the way on both sides of a gap that is crossed back.
constexpr double run_up = 1.5;
/// The largest cosine between the directions to two opposite rims.
constexpr double opposite = -0.7;
/// The least cosine between the directions to rims of one side.
constexpr double same_side = 0.9;

double radians(double degrees) { return degrees * (std::numbers::pi / 180.0); }

double length_of(std::span<const Vec3> way) {
  double length = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) length += glm::distance(way[i - 1], way[i]);
  return length;
}

/// z of the floor at a place, at most a step above or below.
std::optional<double> level_at(const Survey& survey, const Vec3& place, double step) {
  const Vec3 above = place + Vec3(0.0, 0.0, step);
  const FirstImpact floor = survey.floor().first_impact({0.0, 0.0}, above, Vec3(0.0, 0.0, -2.0 * step));
  return floor.hit ? std::optional(above.z - 2.0 * step * floor.time) : std::nullopt;
}

}  // namespace

Vec3 place_on(std::span<const Vec3> way, double along) {
  for (std::size_t i = 1; i < way.size(); ++i) {
    const double length = glm::distance(way[i - 1], way[i]);
    if (along <= length && length > 0.0) return way[i - 1] + (std::max(along, 0.0) / length) * (way[i] - way[i - 1]);
    along -= length;
  }
  return way.back();
}

double carried_from(double half, double rise, double slope_degrees) {
  const double level = carried_share * half;
  if (std::abs(rise) <= level_rims) return level;
  const double chord = std::hypot(half, 0.5 * rise), tilt = std::atan2(std::abs(rise), 2.0 * half);
  const double upright = 0.5 * std::numbers::pi;
  const double steepest = std::max(radians(rim_slope_degrees) - tilt, std::min(upright, radians(slope_degrees) + tilt));
  // The same margin as over level rims.
  return std::max(level, carried_share * rim_sine * chord / std::sin(steepest));
}

double rise_of(const Survey& survey, const Crack& crack, double step) {
  double rise = 0.0;
  const std::vector<cracks::TouchedFloor> touched =
      touched_floor(cracks::FloorPlan(survey, step), {crack.point, crack.radius});
  // Floor may also lie under a kerb on the rim: the highest floor counts, because a body touches that.
  const auto level = [&](const cracks::TouchedFloor& rim) {
    double highest = rim.near.point.z;
    for (const cracks::TouchedFloor& other : touched)
      if (glm::dot(rim.way, other.way) > same_side) highest = std::max(highest, other.near.point.z);
    return highest;
  };
  for (std::size_t i = 0; i < touched.size(); ++i) {
    for (std::size_t k = i + 1; k < touched.size(); ++k) {
      if (glm::dot(touched[i].way, touched[k].way) < opposite)
        rise = std::max(rise, std::abs(level(touched[i]) - level(touched[k])));
    }
  }
  return rise;
}

std::optional<GapOnWay> gap_on(const Survey& survey, std::span<const Vec3> way, double at, double half, double step) {
  const double end = length_of(way), last = std::min(end, at + 6.0 * half);
  std::optional<double> before;
  std::optional<GapOnWay> gap;
  for (double along = std::max(0.0, at - half); along <= last; along += look_every) {
    const std::optional<double> here = level_at(survey, place_on(way, along), step);
    if (!here && before && !gap) gap = GapOnWay{along - look_every, along, 0.0, *before};
    if (here && gap && along - gap->from < 0.5 * half) gap.reset();  // a narrower gap before it
    if (here && gap) {
      gap->to = along;
      gap->beyond = end - along;
      gap->rise = *here - gap->rise;
      return gap;
    }
    if (here) before = here;
  }
  return std::nullopt;
}

std::vector<Vec3> back_over(const Survey& survey, std::span<const Vec3> way, const GapOnWay& gap, double radius,
                            double step) {
  const double room = radius + around;
  if (gap.rise >= -level_rims || gap.from < room || gap.beyond < room) return {};
  std::vector<Vec3> part = stretch(way, 0.5 * (gap.from + gap.to), 0.5 * (gap.to - gap.from) + std::max(room, run_up));
  // Ways cut across steps, but a body must not begin inside or above the floor.
  for (Vec3* end : {&part.front(), &part.back()}) {
    const std::optional<double> level = level_at(survey, *end, step);
    if (!level) return {};
    end->z = *level;
  }
  std::reverse(part.begin(), part.end());
  return part;
}

}  // namespace roam::training
