#include "motion/flight.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "motion/ground.h"
#include "motion/planes.h"
#include "motion/slide.h"
#include "motion/support.h"
#include "motion/walking.h"

namespace roam::walking {
namespace {

/// Seconds. A chord of this duration is off the parabola by at most g t^2 / 8, 1.4 mm.
constexpr double chord_seconds = 1.0 / 30.0;

/// A fall that covers a smaller part of its way than this counts as hindered. Far below sin(45 degrees)^2.
constexpr double hindered_part = 0.05;

/// The motion along `planes`. The sideways wish must not turn into a rise, so it is first projected as if the planes
/// were vertical.
Vec3 along_slopes(const Vec3& motion, const PlaneSet& planes) {
  PlaneSet walls;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    const Vec3 flat(planes[i].x, planes[i].y, 0.0);
    const double length = glm::length(flat);
    if (length > standstill_part) walls.add(flat / length);
  }
  const Vec3 sideways = along_planes(Vec3(motion.x, motion.y, 0.0), walls);
  return along_planes(Vec3(sideways.x, sideways.y, motion.z), planes);
}

/// `speed`: downwards, m/s.
void note_landing(Move& move, double speed) {
  move.report.landing_speed = std::max(move.report.landing_speed, speed);
  move.note(EventKind::landed);
}

void land(Move& move, Gait& gait, const Ground& ground, double speed) {
  stand_on(move, gait, ground);
  note_landing(move, speed);
  if (has_disc(move)) forget_other_storeys(move, gait);
}

}  // namespace

double flight_seconds(const Move& move, const Gait& gait, const Vec3& velocity) {
  double seconds = chord_seconds;
  if (gait.rise_speed > 0.0 && move.settings.gravity > 0.0) {
    seconds = std::min(seconds, gait.rise_speed / move.settings.gravity);
  }
  // No fall is longer than a query reaches: a support disc looks for floor along all of it.
  const double fastest = std::max(terminal_speed, std::abs(gait.rise_speed));
  seconds = std::min(seconds, Space::reach_limit / fastest);
  const double speed = glm::length(velocity);
  return speed * seconds > longest_way ? longest_way / speed : seconds;
}

bool fly_on(Move& move, Gait& gait, const Vec3& velocity, double seconds) {
  const double start = move.time, gravity = move.settings.gravity;
  // A body that came off a rim faster than that keeps its speed.
  const double fastest = std::max(terminal_speed, -gait.rise_speed);
  double fall = std::max(gait.rise_speed * seconds - 0.5 * gravity * seconds * seconds, -fastest * seconds);
  double rise_speed = std::max(gait.rise_speed - gravity * seconds, -fastest);
  // The top of a jump must be met exactly, or it would be divided without end.
  if (gait.rise_speed > 0.0 && rise_speed < 1e-9) rise_speed = 0.0;
  const auto falling = [&] { return std::min(gravity * (move.time - start) - gait.rise_speed, fastest); };
  Vec3 whole(velocity.x * seconds, velocity.y * seconds, fall);
  Vec3 motion = whole;
  const double begin_z = move.place.z;
  PlaneSet planes;
  double left = 1.0;
  bool touched = false;
  for (int contact = 0; contact < slide_limit && left > 0.0; ++contact) {
    if (!move.has_room()) {
      seconds *= 1.0 - left;
      fall *= 1.0 - left;
      if (whole.z != 0.0) rise_speed = -falling();
      break;
    }
    const Vec3 before = move.place;
    double share = left;
    const std::optional<double> until_disc =
        has_disc(move) && whole.z <= 0.0 ? carried_after(move, gait, motion * left) : std::nullopt;
    if (until_disc) share *= *until_disc;
    const Advance a = move.advance(motion * share, seconds * share);
    left -= a.fraction * share;
    if (until_disc && !a.touched) {
      const double speed = falling();
      land_on_disc(move, gait);
      note_landing(move, speed);
      return true;
    }
    if (!a.touched) break;
    if (a.embedded) return false;
    touched = true;
    move.touch(a.contact, a.gap);
    move.ease_off(a);
    if (glm::length(move.place - before) > move.skin) planes.clear();
    planes.add(a.contact.normal);
    if (whole.z <= 0.0) {
      std::optional<Ground> ground = footing(move, gait, a.contact);
      if (!ground && planes.size() > 1) ground = footing_here(move, gait);
      if (ground) {
        land(move, gait, *ground, falling());
        return true;
      }
    } else if (a.contact.normal.z < 0.0) {
      whole.z = rise_speed = 0.0;
    }
    motion = along_slopes(whole, planes);
    if (glm::length(motion) <= standstill_part * glm::length(whole)) break;
  }
  move.time = start + seconds;
  // On a slope of angle a gravity acts by sin(a)^2. The speed kept here is that of a free fall and acts likewise. If
  // the way down is closed, the fall begins anew. A first fall that is lost in the rounding of z is not closed.
  if (touched && fall < 0.0 && begin_z - move.place.z < hindered_part * -fall) rise_speed = 0.0;
  gait.rise_speed = rise_speed;
  const bool falls = gait.footing == Footing::air && gait.level.has_value();
  if (falls && move.feet() < *gait.level - (move.settings.radius + move.settings.step)) {
    gait.footing = Footing::falling;
    move.note(EventKind::fell);
  }
  return true;
}

}  // namespace roam::walking
