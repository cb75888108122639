#include "motion/crouch.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace roam::walking {
namespace {

/// Skins, ahead of a body that may be blocked. A step may be shorter than one.
constexpr double several_skins = 4.0;

}  // namespace

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
  const Vec3 ahead = at_least(motion, several_skins * move.skin);
  const Advance under = trial.probe(ahead);
  if (under.embedded || !(under.fraction * glm::length(ahead) > move.skin)) return false;
  // A low obstacle does not block the low body. A post or a wall does, and how far either body can graze along it is
  // noise.
  const Vec3 against(-contact.normal.x, -contact.normal.y, std::max(-contact.normal.z, 0.0));
  if (trial.probe(against * (move.skin + hit_tolerance)).touched) return false;
  crouch(move);
  return true;
}

void stand_up(Move& move, const Vec3& way) {
  const double tall = move.settings.height, missing = tall - move.height;
  if (!(missing > 0.0)) return;
  // The volume that the low body sweeps on its way up is the tall body.
  const Advance up = move.probe(Vec3(0.0, 0.0, missing));
  if (up.fraction < 1.0) return;
  // Where it would have to crouch again at once it stays low: by short steps it would never come under a low ceiling.
  const double length = glm::length(way);
  if (length > 0.0) {
    const Vec3 ahead = way * (several_skins * move.skin / length);
    Move trial = move;
    trial.height = tall;
    trial.place.z += 0.5 * missing;
    if (trial.probe(ahead).touched && !move.probe(ahead).touched) return;
  }
  const double certified = move.clearance_over(Vec3(0.0, 0.0, missing));
  move.go(Vec3(0.0, 0.0, 0.5 * missing));
  move.known.clearance = certified;
  move.resize(tall, move.place);
  move.note(EventKind::stood);
}

}  // namespace roam::walking
