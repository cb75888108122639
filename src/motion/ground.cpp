#include "motion/ground.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "math/slope.h"
#include "motion/planes.h"
#include "motion/support.h"

namespace roam::walking {
namespace {

/// Metres. A rim is judged by a ball of radius rim_ball, lowered rim_inset behind the rim. That is far enough not to
/// lie on the rim itself. It is near enough to find the top of a thin wall and the nosing of a stair.
constexpr double rim_ball = 0.004;
constexpr double rim_inset = 0.012;

/// Greatest number of contacts examined under one body. Only dense noise has more; there the nearest decide.
constexpr std::size_t contacts_looked_at = 24;

/// On level ground the body finds it within this many skins; where the ground bends, a part of the stride is added.
constexpr double near_skins = 4.0;
constexpr double near_part = 0.125;

double slope_tangent(const Move& m) {
  return std::sqrt(std::max(0.0, 1.0 - m.slope_cosine * m.slope_cosine)) / m.slope_cosine;
}

/// Whether the floor behind the rim at `point` can be walked on. `normal` points from the rim to the body.
bool floor_behind(const Move& m, const Vec3& point, const Vec3& normal) {
  const Vec3 outward(normal.x, normal.y, 0.0);
  const Vec3 inside = point - outward * (rim_inset / glm::length(outward));
  const double rise = rim_inset * slope_tangent(m) + rim_ball + 2.0 * m.skin;
  const Vec3 above = inside + Vec3(0.0, 0.0, rise + rim_ball);
  const Impact s = m.space.sweep({rim_ball, 0.0}, above, Vec3(0.0, 0.0, -2.0 * rise));
  return s.hit && s.distance >= 0.0 && s.normal.z >= m.slope_cosine - cosine_rounding;
}

std::optional<Ground> footing_on(const Move& m, const Gait& gait, const Contact& contact) {
  const double up = contact.normal.z;
  if (up < rim_cosine) return std::nullopt;
  const bool gentle = up >= m.slope_cosine - cosine_rounding;
  if (contact.feature == Feature::face) {
    return gentle
               ? std::optional<Ground>({contact.normal, contact.point.z, true, false, contact.unknown, contact.object})
               : std::nullopt;
  }
  if (gait.grounded() && contact.point.z > *gait.level + m.settings.step + 2.0 * m.skin) {
    return std::nullopt;
  }
  if (!gentle && !floor_behind(m, contact.point, contact.normal)) return std::nullopt;
  return Ground{contact.normal, contact.point.z, gentle, true, contact.unknown, contact.object};
}

Contact as_contact(const Impact& s) {
  return {{s.point, s.normal, s.feature, s.distance}, s.triangle, s.object, s.unknown};
}

/// Whether planes carry together: gravity along them leads down at less than the slope limit. On a slope of angle a it
/// leads down by sin(a)^2 of its length.
bool carried_by(const Move& m, const PlaneSet& planes) {
  const Vec3 down = along_planes(Vec3(0.0, 0.0, -1.0), planes);
  return -down.z <= 1.0 - m.slope_cosine * m.slope_cosine + cosine_rounding;
}

/// Metres down to where the body is a skin from the plane that it meets after `to_ground` metres. A plane too steep to
/// carry lifts the body at most as far as a carrying rim; a plane that faces down does not lift it.
double to_skin(const Move& m, const Impact& met, double to_ground) {
  return met.normal.z > 0.0 ? std::max(to_ground - m.skin / met.normal.z, -m.skin / rim_cosine) : 0.0;
}

/// The first impact on the way down by `reach`, with its time in metres. Usually the ground is just below. So a short
/// query comes first: it has few candidates, and a long one could not tell which of them comes first.
struct Below {
  Impact impact;
  double drop = 0.0;
};
Below look_below(const Move& m, double horizontal, double reach) {
  const double nearly = std::min(reach, near_skins * m.skin + near_part * horizontal);
  Impact s = m.sweep(Vec3(0.0, 0.0, -nearly));
  if (s.hit || !(nearly < reach)) return {s, s.time * nearly};
  s = m.sweep(Vec3(0.0, 0.0, -reach));
  return {s, s.time * reach};
}

}  // namespace

std::optional<Ground> footing(const Move& move, const Gait& gait, const Impact& contact) {
  return footing_on(move, gait, as_contact(contact));
}

std::optional<Ground> footing_here(const Move& move, const Gait& gait) {
  std::array<Contact, contacts_looked_at> contacts;
  const std::size_t found =
      move.space.contacts(move.body(), move.place, Vec3(0.0), (1.0 + 2.0 * rest_part) * move.skin, contacts);
  PlaneSet planes;
  std::optional<Ground> best;
  double highest = move.feet();
  bool unknown = false;
  ObjectId object = no_object;
  for (std::size_t i = 0; i < std::min(found, contacts.size()); ++i) {
    const Contact& c = contacts[i];
    if (!(c.normal.z > 0.0)) continue;
    const std::optional<Ground> f = footing_on(move, gait, c);
    if (f && (!best || f->normal.z > best->normal.z)) best = f;
    planes.add(c.normal);
    unknown |= c.unknown;
    highest = std::max(highest, c.point.z);
    if (object == no_object) object = c.object;  // the nearest contact
  }
  if (best) return best;
  if (planes.size() > 1 && carried_by(move, planes)) {
    return Ground{Vec3(0.0, 0.0, 1.0), highest, false, false, unknown, object};
  }
  return std::nullopt;
}

void stand_on(Move& move, Gait& gait, const Ground& ground) {
  const bool fall_noted = gait.footing == Footing::falling || !gait.level;
  if (!fall_noted && ground.level < *gait.level - (move.settings.radius + move.settings.step))
    move.note(EventKind::fell);
  gait.ground = ground.normal;
  gait.level = ground.level;
  gait.rise_speed = 0.0;
  gait.footing = ground.firm ? Footing::ground : Footing::rim;
  gait.unknown = ground.unknown;
  if (gait.object == ground.object) return;
  gait.object = ground.object;
  gait.ground_velocity = Vec3(0.0);
}

namespace {

/// Steps off a rim that has become too steep to stand on, onto ground at most a step below it: outwards until the body
/// is clear of the rim, and down.
bool step_off(Move& move, Gait& gait, const Impact& rim) {
  const Vec3 flat(rim.normal.x, rim.normal.y, 0.0);
  const double radius = move.settings.radius, lateral = glm::length(flat);
  if (rim.feature == Feature::face || !(lateral > 0.0)) return false;
  Move trial = move;
  const Vec3 outward = flat * ((radius * (1.0 - lateral) + 2.0 * move.skin) / lateral);
  const Advance off = trial.probe(outward);
  if (off.embedded) return false;
  trial.place += outward * off.fraction;
  const double reach = move.feet() - (*gait.level - move.settings.step) + 3.0 * move.skin;
  if (!(reach > 0.0)) return false;
  const Impact landing = trial.sweep(Vec3(0.0, 0.0, -reach));
  if (!landing.hit || landing.distance < 0.0) return false;
  const std::optional<Ground> ground = footing(trial, gait, landing);
  if (!ground) return false;
  move.go(outward * off.fraction);
  move.go(Vec3(0.0, 0.0, -std::max(0.0, landing.time * reach - move.skin / landing.normal.z)));
  move.note(EventKind::stepped_down);
  stand_on(move, gait, *ground);
  return true;
}

}  // namespace

void keep_ground(Move& move, Gait& gait, double horizontal) {
  const double slope_drop = horizontal * slope_tangent(move);
  // On a rim the body has sunk below the level on which it stands.
  const double sunk = gait.footing == Footing::rim ? std::max(0.0, *gait.level - move.feet()) : 0.0;
  const double reach = std::max(0.0, move.settings.step - sunk) + slope_drop + 3.0 * move.skin;
  const bool look_for_disc = has_disc(move) && !see_floor(move, gait, reach, horizontal);
  const Vec3 down(0.0, 0.0, -1.0);
  const auto [s, to_ground] = look_below(move, horizontal, reach);
  std::optional<Ground> ground;
  if (s.hit) ground = footing(move, gait, s);
  if (s.hit && !ground) {
    // The first impact is too steep, but ground that carries may be just behind it.
    Move lowered = move;
    lowered.place.z -= std::max(0.0, to_skin(move, s, to_ground));
    ground = footing_here(lowered, gait);
  }
  if (look_for_disc) {
    const double drop = ground ? to_skin(move, s, to_ground) : std::numeric_limits<double>::infinity();
    if (carry(move, gait, drop, reach)) return;
  }
  if (!ground) {
    if (gait.grounded() && s.hit && step_off(move, gait, s)) return;
    if (gait.grounded()) move.note(EventKind::airborne);
    gait.leave_ground();
    return;
  }
  move.known.nearest = to_ground + hit_tolerance;
  const double drop = to_skin(move, s, to_ground);
  const double rest = rest_part * 2.0 * move.skin;
  if (std::abs(drop) * s.normal.z > rest) {
    if (drop > 0.0) {
      move.go(down * drop);
      move.known.nearest = to_ground - drop + hit_tolerance;
    } else {
      move.advance(down * drop, 0.0);
    }
  }
  const double usual = slope_drop + 3.0 * move.skin;
  if (gait.grounded() && ground->edge && ground->level > *gait.level + usual) move.note(EventKind::stepped_up);
  if (gait.grounded() && drop > usual) move.note(EventKind::stepped_down);
  stand_on(move, gait, *ground);
}

}  // namespace roam::walking
