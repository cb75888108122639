#include "motion/support.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motion/free_disc.h"
#include "motion/ground.h"

namespace roam::walking {
namespace {

/// Rounding of a unit normal's z, so that a ramp exactly at the slope limit is floor.
constexpr double cosine_rounding = 1e-9;

/// Metres. Floor that is this near to the axis, seen from above, is under it: a ray can slip through where triangles
/// meet without sharing an edge, and storing moves both by up to half a millimetre.
constexpr double under_axis = 2e-3;

FloorPlane plane_of(const Stance& stance) { return {stance.floor_point, stance.floor_normal}; }

/// A foot that is smaller than the body is as large as the body, or a crack could be too narrow for the one to fall in
/// and too wide for the other to be carried by its rims.
double foot_radius(const Move& m) { return std::max(m.settings.support_radius, m.settings.radius); }

Foot foot_of(const Move& m) {
  const double knee = std::max(m.settings.step, carrying_band) + 2.0 * m.skin;
  return {foot_radius(m), m.settings.slope_degrees, std::min(knee, 0.5 * m.height)};
}

/// How high the centre is of a body that touches the plane, but for its skin, at a place.
double centre_over(const Move& m, const FloorPlane& plane, const Vec3& place) {
  const double r = m.settings.radius;
  return plane.level(place) + (r + m.skin) / plane.normal.z + 0.5 * m.height - r;
}

/// The nearest floor beside the axis within `radius`, between two heights: a level plane through it.
std::optional<FloorPlane> plane_beside(const Move& m, const Vec3& axis, double lower, double upper, double radius) {
  const Vec3 middle(axis.x, axis.y, 0.5 * (lower + upper));
  Floor floor;
  floor.slope_degrees = m.settings.slope_degrees;
  floor.band = 0.5 * (upper - lower);
  floor.point = middle;
  const Clearance near = m.space.floor_clearance({0.0, floor.band}, middle, radius, floor);
  if (!near.found) return std::nullopt;
  return FloorPlane{near.point, Vec3(0.0, 0.0, 1.0)};
}

/// Whether there is floor under the axis after all.
bool has_floor(const Move& m, const FloorPlane& plane, const Vec3& place) {
  const Vec3 middle(place.x, place.y, plane.level(place));
  const Floor floor{m.settings.slope_degrees, carrying_band, plane.point, plane.normal};
  return m.space.floor_clearance({0.0, carrying_band}, middle, under_axis, floor).found;
}

/// Whether the foot carries the body over the plane at `place`.
bool carries(const Move& m, const FloorPlane& plane, const Vec3& place) {
  return !has_floor(m, plane, place) && !free_disc(m.space, plane, foot_of(m), place);
}

void stand_on_foot(Move& m, Stance& stance, const FloorPlane& plane) {
  if (!stance.carried) m.note(EventKind::carried);
  stand_on(m, stance, {plane.normal, plane.level(m.place), true, false, false});
  stance.carried = stance.floor_seen = true;
  stance.floor_point = plane.point;
  stance.floor_normal = plane.normal;
}

}  // namespace

bool has_foot(const Move& move) { return move.settings.support_radius > 0.0; }

bool see_floor(const Move& m, Stance& stance, double reach, double horizontal) {
  const double r = m.settings.radius;
  // A round body on a slope is that much higher over the axis than where it touches.
  const double lifted = (r + m.skin) * (1.0 / std::max(stance.ground.z, m.slope_cosine) - 1.0);
  const Vec3 from(m.place.x, m.place.y, m.feet() + r);
  const Impact s = m.space.ray(from, Vec3(0.0, 0.0, -(r + reach + lifted)));
  if (!s.hit || s.normal.z < m.slope_cosine - cosine_rounding) return false;
  stance.floor_point = s.point;
  if (s.feature == Feature::face || !stance.floor_seen) {
    // What is seen at once has the roughness of the floor in it: it counts the more the longer it lasts.
    const double part = stance.floor_seen ? horizontal / (horizontal + r) : 1.0;
    stance.floor_normal = glm::normalize(stance.floor_normal + part * (s.normal - stance.floor_normal));
  }
  stance.floor_seen = true;
  return true;
}

bool carry(Move& m, Stance& stance, double drop, double reach) {
  FloorPlane plane = plane_of(stance);
  if (!stance.floor_seen) {
    const auto beside = plane_beside(m, m.place, m.feet() - carrying_band, m.feet() + carrying_band, foot_radius(m));
    if (!beside) return false;
    plane = *beside;
  }
  const double lift = centre_over(m, plane, m.place) - m.place.z, rest = rest_part * 2.0 * m.skin;
  // What it stands on is no lower; or the plane is of another storey.
  if (-drop >= lift - rest || lift < -reach || lift > m.settings.step + m.settings.radius) return false;
  if (!carries(m, plane, m.place)) return false;
  if (std::abs(lift) > rest) m.advance(Vec3(0.0, 0.0, lift), 0.0);
  stand_on_foot(m, stance, plane);
  return true;
}

std::optional<double> carried_after(const Move& m, Stance& stance, const Vec3& motion) {
  if (!(motion.z < 0.0)) return std::nullopt;
  const auto crossing = [&](const FloorPlane& plane) -> std::optional<double> {
    const double rest = rest_part * 2.0 * m.skin;
    const double before = m.place.z - centre_over(m, plane, m.place) - rest;
    const double after = m.place.z + motion.z - centre_over(m, plane, m.place + motion) - rest;
    if (!(before > 0.0) || after > 0.0) return std::nullopt;
    return before / (before - after);
  };
  if (stance.floor_seen) {
    const FloorPlane plane = plane_of(stance);
    if (const std::optional<double> part = crossing(plane)) {
      return carries(m, plane, m.place + motion * *part) ? part : std::nullopt;
    }
  }
  const std::optional<FloorPlane> plane =
      plane_beside(m, m.place + motion, m.feet() + motion.z - 2.0 * m.skin, m.feet(), foot_radius(m));
  if (!plane) return std::nullopt;
  const std::optional<double> part = crossing(*plane);
  if (!part || !carries(m, *plane, m.place + motion * *part)) return std::nullopt;
  stance.floor_point = plane->point;
  stance.floor_normal = plane->normal;
  stance.floor_seen = true;
  return part;
}

void land_on_foot(Move& m, Stance& stance) { stand_on_foot(m, stance, plane_of(stance)); }

void forget_other_storeys(const Move& m, Stance& stance) {
  if (std::abs(stance.level - plane_of(stance).level(m.place)) > carrying_band) stance.floor_seen = false;
}

}  // namespace roam::walking
