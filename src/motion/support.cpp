#include "motion/support.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "math/floating_point.h"
#include "math/slope.h"
#include "motion/ground.h"
#include "motion/state.h"

namespace roam::walking {
namespace {

/// Metres. Floor this near to the axis, seen from above, counts as under it. A ray can slip through where triangles
/// meet without a common edge, and storage moves both by up to half a millimetre.
constexpr double under_axis = 2e-3;

/// A support disc smaller than the body counts as large as the body. Otherwise a crack could be too narrow for the disc
/// to fall in and too wide for the body to be carried by its rims.
double disc_radius(const WalkerSettings& settings) { return std::max(settings.support_radius, settings.radius); }

/// Storage moves the floor under the axis and the floor around, and tilts the plane between them. The band is wider by
/// that much, so that floor that carries stays in it.
double stored_band(double skin) { return carrying_band + 2.0 * skin; }

SupportDisc disc_of(const WalkerSettings& settings, double skin, double height) {
  const double band = stored_band(skin), knee = std::max(settings.step + 2.0 * skin, band);
  return {disc_radius(settings), settings.slope_degrees, std::min(knee, 0.5 * height), band};
}

/// Height of the centre of a body at `place` that is a skin above the plane.
double centre_over(const Move& m, const FloorPlane& plane, const Vec3& place) {
  const double r = m.settings.radius;
  return plane.level(place) + (r + m.skin) / plane.normal.z + 0.5 * m.height - r;
}

/// The nearest floor beside the axis, as a level plane.
struct Beside {
  bool found = false;
  bool unknown = false;  ///< the nearest floor is unknown space, so it gives no plane
  FloorPlane plane;
  ObjectId object = no_object;
};

/// Searched within the support disc, between two heights.
Beside plane_beside(const Move& m, const Vec3& axis, double lower, double upper) {
  const Vec3 middle(axis.x, axis.y, 0.5 * (lower + upper));
  Floor floor;
  floor.slope_degrees = m.settings.slope_degrees;
  floor.band = 0.5 * (upper - lower);
  floor.point = middle;
  const Clearance near = m.space.floor_clearance({0.0, floor.band}, middle, disc_radius(m.settings), floor);
  return {near.found, near.unknown, {near.point, Vec3(0.0, 0.0, 1.0)}, near.object};
}

/// Whether there is floor under the axis after all.
bool has_floor(const Space& space, double slope_degrees, double band, const FloorPlane& plane, const Vec3& place) {
  const Vec3 middle(place.x, place.y, plane.level(place));
  const Floor floor{slope_degrees, band, plane.point, plane.normal};
  return space.floor_clearance({0.0, band}, middle, under_axis, floor).found;
}

/// carrying() with the last result kept in the gait.
bool carries(const Move& m, Gait& gait, const FloorPlane& plane, const Vec3& place) {
  const Size size{m.settings.radius, m.settings.support_radius};
  const std::optional<std::uint64_t> revision = m.space.facts().revision;
  DiscResult result{place, m.height, size, plane, revision.value_or(0)};
  if (!gait.disc_result.lasts || !gait.disc_result.same_input(result)) {
    result.carrying = carrying(m.space, m.settings, m.skin, m.height, plane, place, gait.disc);
    result.lasts = revision.has_value();
    gait.disc_result = result;
  }
  return gait.disc_result.carrying != Carrying::no;
}

/// Stands on the plane that carries. The plane is remembered if it is that of a floor.
void stand_on_disc(Move& m, Gait& gait, const FloorPlane& plane, bool is_floor) {
  if (gait.footing != Footing::disc) m.note(EventKind::bridged);
  stand_on(m, gait,
           {plane.normal, plane.level(m.place), true, false, gait.disc_result.carrying == Carrying::unknown,
            gait.floor_object});
  gait.footing = Footing::disc;
  gait.floor_seen = is_floor;
  gait.floor = plane;
}

}  // namespace

Carrying carrying(const Space& space, const WalkerSettings& settings, double skin, double height,
                  const FloorPlane& plane, const Vec3& place, DiscFound& last) {
  const SupportDisc disc = disc_of(settings, skin, height);
  if (has_floor(space, disc.slope_degrees, disc.band, plane, place)) return Carrying::no;
  return find_disc(space, plane, disc, place, last);
}

bool has_disc(const Move& move) { return move.settings.support_radius > 0.0; }

bool see_floor(const Move& m, Gait& gait, double reach, double horizontal) {
  const double r = m.settings.radius;
  // On a slope the lowest point of a round body is this much higher over the floor below its axis.
  const double lifted = (r + m.skin) * (1.0 / std::max(gait.ground.z, m.slope_cosine) - 1.0);
  const Vec3 from(m.place.x, m.place.y, m.feet() + r);
  const Impact s = m.space.ray(from, Vec3(0.0, 0.0, -(r + reach + lifted)));
  if (!s.hit || s.normal.z < m.slope_cosine - cosine_rounding) return false;
  if (s.unknown) {
    // It carries like floor, but the floor that it hides may be at another height.
    forget_other_storeys(m, gait);
    return true;
  }
  gait.floor.point = s.point;
  gait.floor_object = s.object;
  if (s.feature == Feature::face || !gait.floor_seen) {
    // A single observation contains the roughness of the floor, so it is weighted by the distance covered.
    const double part = gait.floor_seen ? horizontal / (horizontal + r) : 1.0;
    gait.floor.normal = glm::normalize(gait.floor.normal + part * (s.normal - gait.floor.normal));
  }
  gait.floor_seen = true;
  return true;
}

bool carry(Move& m, Gait& gait, double drop, double reach) {
  FloorPlane plane = gait.floor;
  bool is_floor = true;
  if (!gait.floor_seen) {
    const Beside beside = plane_beside(m, m.place, m.feet() - carrying_band, m.feet() + carrying_band);
    if (!beside.found) return false;
    plane = beside.plane;
    gait.floor_object = beside.object;
    is_floor = !beside.unknown;
    if (beside.unknown) {
      // A body placed beside the unknown waits at its height until that is known, unless there is ground to stand on.
      if (std::isfinite(drop)) return false;
      plane.point = Vec3(m.place.x, m.place.y, m.feet() - m.skin);
    }
  }
  const double lift = centre_over(m, plane, m.place) - m.place.z, rest = rest_part * 2.0 * m.skin;
  // The body's own ground is not lower, or the plane belongs to another storey.
  if (-drop >= lift - rest || lift < -reach || lift > m.settings.step + m.settings.radius) return false;
  if (!carries(m, gait, plane, m.place)) return false;
  if (std::abs(lift) > rest) m.advance(Vec3(0.0, 0.0, lift), 0.0);
  stand_on_disc(m, gait, plane, is_floor);
  return true;
}

std::optional<double> carried_after(const Move& m, Gait& gait, const Vec3& motion) {
  if (!(motion.z < 0.0)) return std::nullopt;
  const auto crossing = [&](const FloorPlane& plane) -> std::optional<double> {
    const double rest = rest_part * 2.0 * m.skin;
    const double before = m.place.z - centre_over(m, plane, m.place) - rest;
    const double after = m.place.z + motion.z - centre_over(m, plane, m.place + motion) - rest;
    if (!(before > 0.0) || after > 0.0) return std::nullopt;
    return before / (before - after);
  };
  if (gait.floor_seen) {
    const FloorPlane plane = gait.floor;
    if (const std::optional<double> part = crossing(plane)) {
      return carries(m, gait, plane, m.place + motion * *part) ? part : std::nullopt;
    }
  }
  const Beside beside = plane_beside(m, m.place + motion, m.feet() + motion.z - 2.0 * m.skin, m.feet());
  if (!beside.found || beside.unknown) return std::nullopt;
  const std::optional<double> part = crossing(beside.plane);
  if (!part || !carries(m, gait, beside.plane, m.place + motion * *part)) return std::nullopt;
  gait.floor = beside.plane;
  gait.floor_seen = true;
  return part;
}

void land_on_disc(Move& m, Gait& gait) { stand_on_disc(m, gait, gait.floor, true); }

void forget_other_storeys(const Move& m, Gait& gait) {
  if (!gait.level || std::abs(*gait.level - gait.floor.level(m.place)) > carrying_band) gait.floor_seen = false;
}

}  // namespace roam::walking

namespace roam {

Carrying carrying(const Walker& walker, double support_radius) {
  const DefaultFloatingPoint guard;
  if (!walker.state().floor()) return Carrying::no;
  WalkerSettings settings = walker.settings();
  settings.support_radius = support_radius;
  walking::DiscFound none;
  return walking::carrying(walker.space(), settings, walker.skin(), walker.body().height(), *walker.state().floor(),
                           walker.position(), none);
}

}  // namespace roam
