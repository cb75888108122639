#include "motion/walking.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "motion/flight.h"
#include "motion/stride.h"

namespace roam::walking {
namespace {

/// Greatest number of strides in one step; a step of minutes ends early instead of running on. 10 s of flight take 300.
constexpr int stride_limit = 4096;

/// Whether it falls for ever.
bool below_everything(const Move& move) {
  return move.settings.gravity > 0.0 && move.place.z + 0.5 * move.height < move.space.bounds().lower.z;
}

bool at_same_place(const Whereabouts& a, const Whereabouts& b) { return a.place == b.place && a.height == b.height; }

}  // namespace

void jump(Move& move, Gait& gait) {
  const double lift = move.settings.gravity * move.settings.jump_height;
  if (!gait.grounded() || !(lift > 0.0)) return;
  gait.rise_speed = std::sqrt(2.0 * lift);
  gait.leave_ground();
  move.note(EventKind::jumped);
}

Ending walk(Move& move, Gait& gait, const Vec3& velocity, double dt, Refuge& last, const Sizes& sizes) {
  const double end = move.time + dt;
  double left = dt, careful = 0.0;  // seconds; `careful`: time left for fine strides
  for (int count = 0; left > 0.0; ++count) {
    adapt(move, gait, sizes);
    if (count >= stride_limit || !move.has_room()) return Ending::throttled;
    const double longest = stride_seconds(move, velocity), finest = fine_stride_seconds(move, velocity);
    const double begin = move.time;
    const bool striding = gait.grounded();
    // Velocity taken along from moving ground, unless move_instances() has already moved the body by it.
    const Vec3 drift = striding || gait.moved_along ? Vec3(0.0) : gait.ground_velocity;
    const bool drifts = drift != Vec3(0.0);
    const Vec3 in_the_air = drifts ? velocity + Vec3(drift.x, drift.y, 0.0) : velocity;
    if (drifts) gait.rise_speed += drift.z;
    const double most = !striding ? flight_seconds(move, gait, in_the_air) : (careful > 0.0 ? finest : longest);
    const double seconds = std::min(left, most);
    const bool whole = seconds == left;
    if (striding) {
      const bool retractable = seconds > finest;
      std::optional<Move::Mark> mark;
      if (retractable) mark = move.mark();
      const Gait before = gait;
      const Whereabouts was = move;
      if (!stride(move, gait, velocity, seconds)) return Ending::embedded;
      if (retractable && !gait.grounded()) {
        move.undo(*mark);
        gait = before;
        careful = seconds;
        continue;
      }
      careful -= seconds;
      // The obstacle that stops it here would stop it again.
      if (move.report.blocked && gait.grounded() && at_same_place(move, was)) break;
    } else {
      const bool flown = fly_on(move, gait, in_the_air, seconds);
      if (drifts && !gait.grounded()) gait.rise_speed -= drift.z;
      if (!flown) return Ending::embedded;
    }
    left = whole && move.time >= begin + seconds ? 0.0 : std::max(0.0, end - move.time);
    if (gait.footing == Footing::ground && gait.ground_velocity == Vec3(0.0)) {
      last = {move.place, move.height, {move.settings.radius, move.settings.support_radius}};
    } else if (!gait.grounded() && below_everything(move)) {
      return Ending::bottomless;
    }
  }
  move.time = end;
  return Ending::done;
}

}  // namespace roam::walking
