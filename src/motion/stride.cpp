#include "motion/stride.h"

#include <algorithm>
#include <glm/geometric.hpp>
#include <limits>
#include <optional>

#include "motion/crouch.h"
#include "motion/ground.h"
#include "motion/planes.h"
#include "motion/slide.h"

namespace roam::walking {
namespace {

/// The horizontal `v` with the rise over all `grounds` together: the steepest decides.
Vec3 over_grounds(const Vec3& v, const PlaneSet& grounds) {
  double rise = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < grounds.size(); ++i) {
    rise = std::max(rise, -(grounds[i].x * v.x + grounds[i].y * v.y) / grounds[i].z);
  }
  return {v.x, v.y, grounds.size() > 0 ? rise : 0.0};
}

/// To a walker a steep plane is a vertical wall. A ceiling, or an overhang met while rising, has no side to slide along
/// and blocks the motion straight.
Vec3 as_wall(const Vec3& normal, const Vec3& v) {
  const Vec3 flat(normal.x, normal.y, 0.0);
  const double length = glm::length(flat);
  if (length > standstill_part && glm::dot(flat, v) < 0.0) return flat / length;
  return -v / glm::length(v);
}

}  // namespace

double stride_seconds(const Move& move, const Vec3& velocity) {
  const double speed = glm::length(velocity);
  return speed > 0.0 ? 0.5 * move.settings.radius / speed : std::numeric_limits<double>::infinity();
}

double fine_stride_seconds(const Move& move, const Vec3& velocity) { return stride_seconds(move, velocity) / 6.0; }

bool stride(Move& move, Gait& gait, const Vec3& velocity, double seconds) {
  const double start = move.time, wish = glm::length(velocity);
  const Vec3 origin = move.place;
  const bool was_carried = gait.footing == Footing::disc;
  PlaneSet walls, grounds;
  grounds.add(gait.ground);
  Vec3 v = velocity;
  double left = seconds;
  std::optional<Vec3> in_vain;  // the motion that led nowhere from the present position
  for (int contact = 0; contact < slide_limit && left > 0.0 && wish > 0.0; ++contact) {
    if (!move.has_room()) {
      seconds -= left;
      break;
    }
    const Vec3 before = move.place;
    const Vec3 motion = over_grounds(v, grounds) * left;
    if (motion == in_vain) {
      if (move.place == origin) move.block(move.report.contacts.back().point);
      break;
    }
    const bool looks = !move.known.touching;  // otherwise a second try may find free what the first did not
    const Advance a = move.advance(motion, left);
    left -= a.fraction * left;
    if (!a.touched) break;
    if (a.embedded) return false;
    move.touch(a.contact, a.gap);
    move.ease_off(a);
    if (glm::length(move.place - before) > move.skin) {
      walls.clear();
      grounds.clear();
    }
    in_vain = looks && move.place == before ? std::optional(motion) : std::nullopt;
    const Vec3& normal = a.contact.normal;
    const double apart = normal.x * v.x + normal.y * v.y;
    // A motion along a slope leads into the ground where it bends down: there it continues level.
    const bool underfoot = normal.z > 0.0 && apart >= -parallel_tolerance * wish;
    if (underfoot || footing(move, gait, a.contact)) {
      grounds.add(underfoot && apart < 0.0 ? normal - v * (apart / glm::dot(v, v)) : normal);
      continue;
    }
    const Vec3 rest = v * left;
    if (crouch_under(move, a.contact, over_grounds(rest, grounds))) {
      in_vain.reset();  // of the tall body
      continue;
    }
    if (const std::optional<double> made = step_up(move, gait, rest, left)) {
      left = std::max(0.0, left - *made * left);
      walls.clear();
      grounds.clear();
      grounds.add(gait.ground);
      v = velocity;
      continue;
    }
    walls.add(as_wall(normal, v));
    v = along_planes(velocity, walls);
    if (glm::length(v) <= standstill_part * wish) {
      move.block(a.contact.point);
      break;
    }
    if (!move.report.has(EventKind::slid)) move.note(EventKind::slid, a.contact.point);
  }
  const Vec3 gone = move.place - origin;
  keep_ground(move, gait, glm::length(Vec3(gone.x, gone.y, 0.0)));
  // A body that rolls off a rim goes on down at its present slope, at most as steep as a rim that carries. Thrown off
  // level it would cross cracks that it does not bridge. A body that loses its support disc has no rim below to guide
  // it. Without gravity it floats on level.
  if (!gait.grounded() && seconds > 0.0 && move.settings.gravity > 0.0) {
    const double steepest = -wish * rim_tangent;
    const double down = was_carried ? steepest : std::max((move.place.z - origin.z) / seconds, steepest);
    gait.rise_speed = std::min(0.0, down);
  }
  move.time = start + seconds;
  return true;
}

}  // namespace roam::walking
