#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motion/carrying.h"
#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

/// Metres. Floor is found by a ball of this radius: small enough not to ride on obstacles that the body passes, large
/// enough to bridge the treads of stairs. A body of radius r rests higher on a slope by r (1 / cos - 1); the knee
/// allows for that.
constexpr double ball_radius = 0.3;
/// Metres. The least ball that is tried beside walls and posts.
constexpr double least_ball = 0.01;
/// Metres. Contacts at the start, and rises above the step, do not count below this.
constexpr double touch = 1e-3;
/// Metres. Floor that touches the ball this near to the axis, seen from above, counts as under the axis. Gaps hardly
/// wider than that, as between the bars of a grate, carry every body.
constexpr double under_axis = 0.02;

/// Share of the radius of the largest support disc. A disc this large decides whether the body falls through a gap.
/// Discs that barely fit would need a search of all rims around, repeated by every walker sent over the gap.
constexpr double sure_share = 0.998;

/// On floor no steeper than this, the ball touches almost under its axis.
constexpr double gentle_cosine = 0.9;

/// The largest ball with a fixed lowest point that does not contain a point `aside` from its axis and `above` its
/// lowest point.
double ball_beside(double aside, double above) { return (aside * aside + above * above) / (2.0 * above); }

double aside(const Vec3& p, double x, double y) { return std::hypot(p.x - x, p.y - y); }

/// The floor straight below, no higher than `from` and no lower than a step below `level`.
std::optional<double> floor_under_axis(const Survey& survey, const Measure& measure, double x, double y, double from,
                                       double level) {
  const double start = from + touch + 2.0 * least_ball;
  const double down = start - least_ball - (level - touch - measure.step);
  const Impact below = survey.floor().sweep({least_ball, 0.0}, {x, y, start}, Vec3(0.0, 0.0, -down));
  if (!below.hit) return std::nullopt;
  return below.point.z;
}

/// The floor nearest to an axis, seen from above, among floors of about the same height.
Clearance floor_beside(const Survey& survey, const Vec3& axis, double reach) {
  Floor floor;
  floor.slope_degrees = survey.slope_degrees();
  floor.band = carrying_band;
  floor.point = axis;
  return survey.floor().floor_clearance({0.0, carrying_band}, axis, reach, floor);
}

/// Tests one level disc of the largest support disc, on the far side of the axis from `floor` and just clear of it.
/// True if the disc holds the axis, is free of floor, and sees its middle from the axis. carrying() finds the same with
/// more work.
bool is_free_beyond(const Survey& survey, const Vec3& axis, const Vec3& floor, double radius, double knee) {
  constexpr double sight = 0.01;  // m, radius of the sphere that looks for walls
  constexpr double apart = 0.01;  // m; the rims of most drops are not quite straight
  const double beside = aside(floor, axis.x, axis.y);
  if (!(beside > apart && beside < radius)) return false;
  const Vec3 away = Vec3(axis.x - floor.x, axis.y - floor.y, 0.0) * ((radius + apart - beside) / beside);
  return !floor_beside(survey, axis + away, radius).found &&
         !survey.world().first_impact({sight, 0.0}, axis + Vec3(0.0, 0.0, knee), away).hit;
}

/// Whether the gap under an axis, at the level of a rim, is an open drop, which carries no support disc. This is the
/// walker's own rule, applied to the largest support disc.
bool is_open_drop(const Survey& survey, const Measure& measure, const Vec3& rim, double x, double y, KnownGaps* gaps) {
  const double radius = sure_share * measure.support_max, knee = std::max(measure.step, carrying_band) + touch;
  const Vec3 axis(x, y, rim.z);
  // In most drops the disc beyond the rim is free. Else the disc beyond the nearest floor is tried, which may be a
  // little higher or lower: beside a gallery's wall that floor is the gutter, and the axis is inside the rock.
  if (is_free_beyond(survey, axis, rim, radius, knee)) return true;
  const Clearance nearest = floor_beside(survey, axis, radius);
  if (nearest.found && is_free_beyond(survey, axis, nearest.point, radius, knee)) return true;
  const auto look = [&](const Vec3& over) {
    return carrying(survey.world(), {over}, {radius, survey.slope_degrees(), knee}, over) == Carrying::no;
  };
  return gaps != nullptr ? gaps->is_open(axis, look) : look(axis);
}

}  // namespace

std::optional<FloorPlace> floor_below(const Survey& survey, const Measure& measure, double x, double y, double level,
                                      KnownGaps* gaps) {
  const double start = level + measure.step + 2.0 * touch;
  const double reach = 2.0 * measure.step + 4.0 * touch;
  double radius = ball_radius;
  while (radius >= least_ball) {
    const Vec3 centre(x, y, start + radius);
    const Impact s = survey.floor().sweep({radius, 0.0}, centre, Vec3(0.0, 0.0, -reach));
    if (!s.hit) return std::nullopt;
    const double beside = aside(s.point, x, y);
    if (s.distance < 0.0) {  // starts inside an obstacle above the knee
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
    const bool is_gentle = s.feature == Feature::face && s.normal.z >= gentle_cosine;
    if (beside <= under_axis || is_gentle) return FloorPlace{Vec3(x, y, lowest), lowest, false};
    // The ball touches a slope or a rim. A kerb has floor below its rim; into a gap the ball has sunk.
    if (const auto below = floor_under_axis(survey, measure, x, y, s.point.z, lowest))
      return FloorPlace{Vec3(x, y, lowest), *below, false};
    if (is_open_drop(survey, measure, s.point, x, y, gaps)) return std::nullopt;
    return FloorPlace{Vec3(x, y, s.point.z), s.point.z, true};
  }
  return std::nullopt;
}

std::optional<FloorPlace> place_over_gap(const Survey& survey, const Measure& measure, double x, double y, double level,
                                         KnownGaps* gaps) {
  const Clearance rim = floor_beside(survey, {x, y, level}, measure.support_max);
  if (!rim.found || is_open_drop(survey, measure, rim.point, x, y, gaps)) return std::nullopt;
  return FloorPlace{Vec3(x, y, rim.point.z), rim.point.z, true};
}

double level_at(const Survey& survey, const Measure& measure, const Vec3& place) {
  return floor_under_axis(survey, measure, place.x, place.y, place.z, place.z).value_or(place.z);
}

}  // namespace roam::ways
