#include "motion/slide.h"

#include <glm/geometric.hpp>

#include "motion/planes.h"

namespace roam::walking {

Ending slide(Move& move, const Vec3& velocity, double dt) {
  const double start = move.time, wish = glm::length(velocity);
  PlaneSet planes;
  Vec3 v = velocity;
  const double seconds = wish * dt > longest_way ? longest_way / wish : dt;
  double left = seconds;
  for (int contact = 0; contact < slide_limit && left > 0.0; ++contact) {
    if (!move.has_room()) {
      move.time = start + (seconds - left);
      return Ending::throttled;
    }
    const Vec3 before = move.place;
    const Advance a = move.advance(v * left, left);
    left -= a.fraction * left;
    if (!a.touched) break;
    if (a.embedded) return Ending::embedded;
    move.touch(a.contact, a.gap);
    move.ease_off(a);
    // A plane is stale once the body has moved by more than the skin; if it is still there, it is met again.
    if (glm::length(move.place - before) > move.skin) planes.clear();
    planes.add(a.contact.normal);
    v = along_planes(velocity, planes);
    if (glm::length(v) <= standstill_part * wish) {
      move.block(a.contact.point);
      break;
    }
    if (!move.report.has(EventKind::slid)) move.note(EventKind::slid, a.contact.point);
  }
  move.time = start + seconds;
  return seconds < dt ? Ending::throttled : Ending::done;
}

}  // namespace roam::walking
