#include "motion/crouch.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace roam::walking {

double crouched_height(const WalkerSettings& settings) {
  return std::min(settings.height, std::max(settings.crouch_height, 2.0 * settings.radius));
}

void crouch(Move& move) {
  const double low = crouched_height(move.settings);
  if (!(low < move.height)) return;
  // The low body lies inside the tall one, and so does its motion down to the feet.
  move.resize(low, move.place - Vec3(0.0, 0.0, 0.5 * (move.height - low)));
  move.note(EventKind::crouched);
}

bool crouch_under(Move& move, const Impact& contact, const Vec3& motion) {
  const double low = crouched_height(move.settings);
  // Below its upper cap the crouched body is as wide as the standing one, so crouching would not help.
  if (!(low < move.height) || contact.point.z < move.feet() + low - move.settings.radius) return false;
  Move trial = move;
  trial.height = low;
  trial.place.z -= 0.5 * (move.height - low);
  const Advance under = trial.probe(motion);
  if (under.embedded || !(under.fraction * glm::length(motion) > move.skin)) return false;
  // A low obstacle does not block the low body. A post or a wall does, and how far either body can graze along it is
  // noise.
  const Vec3 against(-contact.normal.x, -contact.normal.y, std::max(-contact.normal.z, 0.0));
  if (trial.probe(against * (move.skin + hit_tolerance)).touched) return false;
  crouch(move);
  return true;
}

bool stand_up(Move& move) {
  const double tall = move.settings.height, missing = tall - move.height;
  if (!(missing > 0.0)) return false;
  // The volume that the low body sweeps on its way up is the tall body.
  const Advance up = move.probe(Vec3(0.0, 0.0, missing));
  if (up.fraction < 1.0) return false;
  const double certified = move.clearance_over(Vec3(0.0, 0.0, missing));
  move.go(Vec3(0.0, 0.0, 0.5 * missing));
  move.known.clearance = certified;
  move.resize(tall, move.place);
  move.note(EventKind::stood);
  return true;
}

}  // namespace roam::walking
