#include "osgroam/places.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

#include "math/slope.h"
#include "roam/standing.h"

namespace osgRoam {
namespace {

/// Growth of the distance from one shell of candidates to the next. An opening as wide as a third of its distance is
/// hardly missed, and about ten shells lead out of a mountain.
constexpr double growth = 1.25;

/// Number of directions in each shell, spread evenly on a sphere by the golden angle.
constexpr int directions = 64;

/// Number of standing candidates along each side of the space.
constexpr int columns = 15;

/// Metres: the limit of Space::sweep.
constexpr double ray_limit = 1e6;

roam::Vec3 direction(int i) {
  const double z = 1.0 - (2.0 * i + 1.0) / directions, level = std::sqrt(1.0 - z * z);
  const double turn = i * std::numbers::pi * (3.0 - std::sqrt(5.0));
  return {level * std::cos(turn), level * std::sin(turn), z};
}

}  // namespace

void place_safely(roam::Walker& walker, const roam::Vec3& centre) {
  const roam::StepReport& report = walker.place(centre);
  if (!report.held || report.met_unknown || walker.mode() == roam::Mode::ghost) return;
  const roam::Space& space = walker.space();
  const roam::WalkerSettings& s = walker.settings();
  const roam::Body body = roam::Body::capsule(s.radius, s.height);
  const roam::Box bounds = space.bounds();
  const double enough = bounds.empty() ? 0.0 : glm::length(bounds.size()) + s.height;
  for (double distance = 0.5 * s.height; distance < growth * enough; distance *= growth) {
    for (int i = 0; i < directions; ++i) {
      const roam::Vec3 candidate = centre + distance * direction(i);
      if (!space.fits(body, candidate)) continue;
      if (!walker.place(candidate).held) return;
    }
  }
  walker.place(centre);
}

std::optional<roam::Vec3> standing_place(const roam::Space& space, const roam::WalkerSettings& s) {
  const roam::Box bounds = space.bounds();
  if (bounds.empty()) return std::nullopt;
  std::vector<roam::Vec3> tops;
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      const double u = (i + 0.5) / columns, v = (j + 0.5) / columns;
      tops.emplace_back(bounds.lower.x + u * bounds.size().x, bounds.lower.y + v * bounds.size().y,
                        bounds.upper.z + 1.0);
    }
  }
  const roam::Vec3 middle = bounds.center();
  const auto off = [&](const roam::Vec3& p) { return std::hypot(p.x - middle.x, p.y - middle.y); };
  std::stable_sort(tops.begin(), tops.end(), [&](const auto& a, const auto& b) { return off(a) < off(b); });

  const double down = std::min(bounds.size().z + 2.0, ray_limit);
  const double upright = roam::least_upright(s.slope_degrees);
  for (const roam::Vec3& top : tops) {
    const roam::Impact floor = space.ray(top, {0.0, 0.0, -down});
    if (!floor.hit || floor.unknown || floor.normal.z < upright) continue;
    const roam::Vec3 over = floor.point + roam::Vec3(0.0, 0.0, 0.5 * s.height);
    if (const std::optional<roam::Vec3> centre = roam::place_to_stand(space, s, over, s.radius)) return centre;
  }
  return std::nullopt;
}

std::optional<roam::Vec3> landing_place(const roam::Space& space, const roam::WalkerSettings& s, const roam::Vec3& eye,
                                        const roam::Vec3& gaze) {
  const roam::Box bounds = space.bounds();
  if (bounds.empty()) return std::nullopt;
  const double sight = std::min(glm::distance(eye, bounds.center()) + glm::length(bounds.size()), ray_limit);
  for (const roam::Vec3& way : {roam::Vec3(0.0, 0.0, -1.0), gaze}) {
    const roam::Impact seen = space.ray(eye, sight * way);
    if (!seen.hit || seen.unknown) continue;
    const roam::Vec3 over = seen.point + roam::Vec3(0.0, 0.0, 0.5 * s.height);
    if (const std::optional<roam::Vec3> centre = roam::place_to_stand(space, s, over, s.height)) return centre;
  }
  return standing_place(space, s);
}

bool has_floor(const roam::Space& space, const roam::WalkerSettings& s, const roam::Vec3& centre) {
  constexpr double least = 2.0;  // metres
  return space.first_impact({0.0, 0.0}, centre, {0.0, 0.0, -(0.5 * s.height + std::max(s.height, least))}).hit;
}

}  // namespace osgRoam
