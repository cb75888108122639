#include "roam/standing.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "math/floating_point.h"
#include "math/largest.h"
#include "roam/error.h"
#include "roam/walker.h"
#include "text/number.h"

namespace roam {
namespace {

constexpr double most_columns = 4096.0;

/// Greatest number of storeys examined per column.
constexpr int most_floors = 64;

/// Metres below a floor where the search for the next one starts.
constexpr double below_floor = 1e-3;

/// The position where a body put down on `floor` comes to stand.
std::optional<Vec3> stands_at(const Space& space, const WalkerSettings& settings, const Vec3& floor) {
  const Vec3 centre = floor + Vec3(0.0, 0.0, 0.5 * settings.height);
  if (largest(centre) > coordinate_limit) return std::nullopt;
  Walker walker(space, settings, Mode::fly, centre);
  if (walker.held() || walker.set_mode(Mode::walk).met_unknown) return std::nullopt;
  if (!walker.stance().firm() || walker.crouched()) return std::nullopt;
  return walker.position();
}

}  // namespace

std::vector<Vec3> standing(std::span<const Vec3> feet, const WalkerSettings& settings) {
  const DefaultFloatingPoint guard;
  std::vector<Vec3> centres(feet.begin(), feet.end());
  for (Vec3& place : centres) place.z += 0.5 * settings.height;
  return centres;
}

std::optional<Vec3> place_to_stand(const Space& space, const WalkerSettings& settings, const Vec3& near,
                                   double within) {
  const DefaultFloatingPoint guard;
  check(settings);
  if (!std::isfinite(near.x + near.y + near.z)) throw Error("the place to stand near to is not a finite point");
  if (!(within > 0.0 && within <= Space::reach_limit)) {
    throw Error("a place to stand is looked for within " + number_text(within) +
                " m; it must be more than 0 and at most " + number_text(Space::reach_limit) + " m");
  }
  // Evenly over the disc by the golden angle, from the middle outwards.
  const double parts = within / settings.radius, turn = std::numbers::pi * (3.0 - std::sqrt(5.0));
  const int columns = static_cast<int>(std::clamp(4.0 * parts * parts, 1.0, most_columns));
  std::optional<Vec3> best;
  double best_distance = within;
  for (int i = 0; i < columns; ++i) {
    const double aside = within * std::sqrt(static_cast<double>(i) / columns);
    if (best && aside - settings.radius > best_distance) break;
    const Vec3 middle = near + aside * Vec3(std::cos(i * turn), std::sin(i * turn), 0.0);
    const double end = middle.z - within - settings.height;
    Vec3 top = middle + Vec3(0.0, 0.0, within);
    for (int floor = 0; floor < most_floors && top.z > end; ++floor) {
      const FirstImpact hit = space.first_impact({0.0, 0.0}, top, {0.0, 0.0, end - top.z});
      if (!hit.hit) break;
      const Vec3 at(top.x, top.y, top.z + hit.time * (end - top.z));
      top.z = at.z - below_floor;
      const std::optional<Vec3> place = hit.unknown ? std::nullopt : stands_at(space, settings, at);
      if (!place || glm::length(*place - near) > best_distance) continue;
      best = place;
      best_distance = glm::length(*place - near);
    }
  }
  return best;
}

}  // namespace roam
