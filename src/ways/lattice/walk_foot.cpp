#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "roam/support.h"
#include "ways/lattice/walk_place.h"

namespace roam::ways {
namespace {

/// Metres. The foot is this large a ball: small enough not to ride on what a body passes by, large enough to bridge
/// the treads of stairs. A body of radius r rests higher on a slope by r (1 / cos - 1), which the knee makes good for.
constexpr double foot_radius = 0.3;
/// The least ball that is tried beside walls and posts.
constexpr double least_foot = 0.01;
/// Metres: what touches while starting, or rises above the step, by less than this does not count.
constexpr double touch = 1e-3;
/// Metres. Floor that touches the foot so near to the axis, seen from above, is under it: gaps that are hardly wider,
/// as between the bars of a grate, carry everybody.
constexpr double under_axis = 0.02;

/// Of the largest foot: a gap that so large a disc fits into is taken for one that the foot falls through. Whether it
/// fits where it hardly does takes a search of all rims around, and every walker that is sent over it asks again.
constexpr double sure_share = 0.998;

/// The foot touches a floor that is hardly steeper nearly under its axis.
constexpr double gentle_cosine = 0.9;

/// The largest ball whose lowest point is fixed and that has a point outside itself which lies `aside` and `above`.
double ball_beside(double aside, double above) { return (aside * aside + above * above) / (2.0 * above); }

double aside(const Vec3& p, double x, double y) { return std::hypot(p.x - x, p.y - y); }

/// The floor straight below, no higher than `from` and no lower than a step below `level`.
std::optional<double> floor_under_axis(const Survey& survey, const Measure& measure, double x, double y, double from,
                                       double level) {
  const double start = from + touch + 2.0 * least_foot;
  const double down = start - least_foot - (level - touch - measure.step);
  const Impact below = survey.floor().sweep({least_foot, 0.0}, {x, y, start}, Vec3(0.0, 0.0, -down));
  if (!below.hit) return std::nullopt;
  return below.point.z;
}

/// The floor beside an axis nearest to it, seen from above, among what lies about as high.
Clearance floor_beside(const Survey& survey, const Vec3& axis, double reach) {
  Floor floor;
  floor.slope_degrees = survey.slope_degrees();
  floor.band = carrying_band;
  floor.point = axis;
  return survey.floor().floor_clearance({0.0, carrying_band}, axis, reach, floor);
}

/// Whether the largest foot, as a level disc that lies beyond a place of the floor as seen from there and hardly
/// farther than it touches it, holds the axis, is free of floor, and has its middle in sight: what free_disc() finds
/// too, with more work.
bool is_free_beyond(const Survey& survey, const Vec3& axis, const Vec3& floor, double radius, double knee) {
  constexpr double sight = 0.01;  // m, radius of what looks for walls
  constexpr double apart = 0.01;  // m: the rims of most drops are not quite straight
  const double beside = aside(floor, axis.x, axis.y);
  if (!(beside > apart && beside < radius)) return false;
  const Vec3 away = Vec3(axis.x - floor.x, axis.y - floor.y, 0.0) * ((radius + apart - beside) / beside);
  return !floor_beside(survey, axis + away, radius).found &&
         !survey.world().sweep({sight, 0.0}, axis + Vec3(0.0, 0.0, knee), away).hit;
}

/// Whether the gap that an axis is over at the level of a rim is an open drop: no foot is carried there. This is the
/// walker's own rule for its foot, asked with the largest.
bool is_open_drop(const Survey& survey, const Measure& measure, const Vec3& rim, double x, double y, KnownGaps* gaps) {
  const double radius = sure_share * measure.support_max, knee = std::max(measure.step, carrying_band) + touch;
  const Vec3 axis(x, y, rim.z);
  // The disc beyond the rim is free in most drops. Else beyond what is nearer, a little higher or lower: beside a
  // gallery's wall its gutter is, and the axis is in the rock.
  if (is_free_beyond(survey, axis, rim, radius, knee)) return true;
  const Clearance nearest = floor_beside(survey, axis, radius);
  if (nearest.found && is_free_beyond(survey, axis, nearest.point, radius, knee)) return true;
  const auto look = [&](const Vec3& over) {
    return free_disc(survey.world(), {over}, {radius, survey.slope_degrees(), knee}, over) == DiscRoom::free;
  };
  return gaps != nullptr ? gaps->is_open(axis, look) : look(axis);
}

}  // namespace

std::optional<Foot> floor_below(const Survey& survey, const Measure& measure, double x, double y, double level,
                                KnownGaps* gaps) {
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
    const bool is_gentle = s.feature == Feature::face && s.normal.z >= gentle_cosine;
    if (beside <= under_axis || is_gentle) return Foot{Vec3(x, y, lowest), lowest, false};
    // On a slope, or on a rim: of a kerb, with floor below it, or of a gap, into which the ball has sunk.
    if (const auto below = floor_under_axis(survey, measure, x, y, s.point.z, lowest))
      return Foot{Vec3(x, y, lowest), *below, false};
    if (is_open_drop(survey, measure, s.point, x, y, gaps)) return std::nullopt;
    return Foot{Vec3(x, y, s.point.z), s.point.z, true};
  }
  return std::nullopt;
}

std::optional<Foot> carried_over(const Survey& survey, const Measure& measure, double x, double y, double level,
                                 KnownGaps* gaps) {
  const Clearance rim = floor_beside(survey, {x, y, level}, measure.support_max);
  if (!rim.found || is_open_drop(survey, measure, rim.point, x, y, gaps)) return std::nullopt;
  return Foot{Vec3(x, y, rim.point.z), rim.point.z, true};
}

double level_at(const Survey& survey, const Measure& measure, const Vec3& place) {
  return floor_under_axis(survey, measure, place.x, place.y, place.z, place.z).value_or(place.z);
}

}  // namespace roam::ways
