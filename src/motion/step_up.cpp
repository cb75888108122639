// A step up: stairs, kerbs, and the rims of floors.
#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "motion/ground.h"
#include "motion/planes.h"

namespace roam::walking {

std::optional<double> step_up(Move& move, Gait& gait, const Vec3& motion, double seconds) {
  const double length = glm::length(motion), step = move.settings.step, skin = move.skin;
  if (!gait.firm() || !(step > 0.0) || !(length > 0.0)) return std::nullopt;
  // From a skin above the old ground to a skin above the edge of a kerb of full height.
  const Vec3 up(0.0, 0.0, step + 3.0 * skin);
  // At least far enough for a body that touches a kerb as high as its radius to reach where the rim carries it.
  const double least = move.settings.radius * (1.0 - rim_sine) + 4.0 * skin;
  const Vec3 ahead = at_least(motion, least);
  Move trial = move;
  const Advance raised = trial.probe(up);
  Vec3 rise = up * raised.fraction;
  // Under a ceiling that falls, it rises less, by what the ceiling falls over the way ahead.
  const Vec3& ceiling = raised.contact.normal;
  if (raised.touched && ceiling.z < 0.0) rise.z -= std::max(0.0, glm::dot(ahead, ceiling) / ceiling.z);
  if (raised.embedded || !(rise.z > 2.0 * skin)) return std::nullopt;
  trial.place += rise;
  const Advance forward = trial.probe(ahead);
  const Vec3 onward = ahead * forward.fraction;
  if (!(glm::length(onward) > skin)) return std::nullopt;
  trial.place += onward;
  const double reach = rise.z + step;
  const Impact landing = trial.sweep(Vec3(0.0, 0.0, -reach));
  if (!landing.hit || landing.distance < 0.0) return std::nullopt;
  const std::optional<Ground> ground = footing(trial, gait, landing);
  if (!ground || ground->level > *gait.level + step + 2.0 * skin) return std::nullopt;
  // It is neither over the obstacle nor higher than before, or still on the slope on which it stood: that is no step,
  // and repeating it would only creep on.
  const double higher = ground->level - *gait.level, slope = -glm::dot(gait.ground, onward) / gait.ground.z;
  const bool same_slope = !ground->edge && glm::dot(ground->normal, gait.ground) > 1.0 - parallel_tolerance &&
                          std::abs(higher - slope) <= 2.0 * skin;
  if (forward.touched && (!(higher > 2.0 * skin) || same_slope)) return std::nullopt;
  const double drop = std::max(0.0, landing.time * reach - skin / landing.normal.z);

  move.time += seconds * std::min(1.0, glm::length(onward) / length);
  move.go(rise);
  move.go(onward);
  move.go(Vec3(0.0, 0.0, -drop));
  move.note(EventKind::stepped_up);
  stand_on(move, gait, *ground);
  return glm::length(onward) / length;
}

}  // namespace roam::walking
