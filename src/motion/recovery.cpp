#include "motion/recovery.h"

#include <algorithm>
#include <glm/geometric.hpp>

#include "motion/move.h"

namespace roam::walking {
namespace {

/// Part of the centre's certified distance from everything that is the sphere's radius: the sphere must start free.
constexpr double inner_part = 0.9;

/// Greatest number of pushes out of the deepest contact. A box-like niche needs about one per wall, an acute corner a
/// few dozen.
constexpr int push_limit = 48;

/// Greatest number of positions in a march; a march across a solid as thick as the body's height takes about ten.
constexpr int march_limit = 256;

double gap(const Space& space, const Body& body, const Vec3& place, double reach) {
  return space.clearance(body, place, reach).distance;
}

std::optional<Vec3> push_out(const Space& space, const Body& body, const Vec3& place, double limit, double skin) {
  Vec3 at = place;
  for (int push = 0; push < push_limit; ++push) {
    const Clearance c = space.clearance(body, at, skin);
    if (!c.found || c.distance >= 0.5 * skin) return at;
    at += c.normal * (skin - c.distance);
    if (!(glm::length(at - place) <= limit)) return std::nullopt;
  }
  return std::nullopt;
}

/// The first free position along `direction`. A gap grows at most as fast as the body moves. So a body that overlaps by
/// `depth` is not free before it has moved that far. Along a slot the gap hardly grows: so the last half of the
/// positions divides the rest of the way.
std::optional<Vec3> march(const Space& space, const Body& body, const Vec3& place, const Vec3& direction, double limit,
                          double skin) {
  double gone = 0.0;
  for (int count = 0; count < march_limit && gone <= limit; ++count) {
    const Vec3 at = place + direction * gone;
    const double g = gap(space, body, at, skin);
    if (g >= 0.5 * skin) return at;
    const double part = count < march_limit / 2 ? 0.0 : (limit - gone) / (march_limit - count);
    gone += std::max({skin - g, skin, part});
  }
  return std::nullopt;
}

}  // namespace

bool above_ground(const Space& space, const Body& body, const Vec3& place) {
  const Box bounds = space.bounds();
  const double down = bounds.empty() ? longest_way : std::min(place.z - bounds.lower.z, longest_way);
  return down > 0.0 && space.first_impact(body, place, {0.0, 0.0, -down}).hit;
}

std::optional<Vec3> nearest_free(const Space& space, const Body& body, const Vec3& place, double limit, double skin,
                                 Way way, Below below) {
  const double inner = inner_part * gap(space, {0.0, 0.0}, place, body.radius + body.half_height);
  if (way == Way::checked && !(inner > 0.0)) return std::nullopt;
  std::optional<Vec3> best;
  double best_length = limit;
  const auto consider = [&](const std::optional<Vec3>& at) {
    if (!at) return;
    const double length = glm::length(*at - place);
    if (length > best_length || (best && length == best_length)) return;
    if (way == Way::checked && space.first_impact({inner, 0.0}, place, *at - place).hit) return;
    if (below == Below::ground && !above_ground(space, body, *at)) return;
    best = at;
    best_length = length;
  };
  consider(push_out(space, body, place, limit, skin));
  for (int x = -1; x <= 1; ++x) {
    for (int y = -1; y <= 1; ++y) {
      for (int z = -1; z <= 1; ++z) {
        if (x == 0 && y == 0 && z == 0) continue;
        const Vec3 direction = glm::normalize(Vec3(x, y, z));
        consider(march(space, body, place, direction, best_length, skin));
      }
    }
  }
  return best;
}

}  // namespace roam::walking
