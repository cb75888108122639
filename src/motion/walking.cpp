#include "motion/walking.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motion/flight.h"
#include "motion/stride.h"

namespace roam::motion {
namespace {

/// Strides in one step, at most; a step of minutes ends early instead of running on. 10 s of flight are 300.
constexpr int stride_limit = 4096;

bool below_everything(const Move& move) { return move.place.z + 0.5 * move.height < move.world.bounds().lower.z; }

}  // namespace

void jump(Move& move, Stance& stance) {
  const double lift = move.settings.gravity * move.settings.jump_height;
  if (!stance.grounded || !(lift > 0.0)) return;
  stance.rise_speed = std::sqrt(2.0 * lift);
  stance.grounded = stance.firm = false;
  move.note(EventKind::jumped);
}

Ending walk(Move& move, Stance& stance, const Vec3& velocity, double dt, const LastStand& last) {
  const double end = move.time + dt;
  double left = dt;
  for (int count = 0; left > 0.0; ++count) {
    if (count >= stride_limit || !move.has_room()) return Ending::throttled;
    const double begin = move.time;
    const double seconds =
        std::min(left, stance.grounded ? stride_seconds(move, velocity) : flight_seconds(move, stance, velocity));
    const bool whole = seconds == left;
    const bool fits =
        stance.grounded ? stride(move, stance, velocity, seconds) : fly_on(move, stance, velocity, seconds);
    if (!fits) return Ending::embedded;
    left = whole && move.time >= begin + seconds ? 0.0 : std::max(0.0, end - move.time);
    if (stance.firm) {
      last.place = move.place;
      last.height = move.height;
    } else if (!stance.grounded && below_everything(move)) {
      return Ending::bottomless;
    }
  }
  move.time = end;
  return Ending::done;
}

}  // namespace roam::motion
