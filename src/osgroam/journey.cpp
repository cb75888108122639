#include "osgroam/journey.h"

#include <cmath>
#include <glm/geometric.hpp>

namespace osgRoam {
namespace {

/// Seconds without progress after which the path counts as blocked: long enough to climb a stair jerkily.
constexpr double patience = 0.5;

/// Part of the free motion that counts as progress. Sliding along a wall at less than this does not.
constexpr double least_progress = 0.05;

/// Metres from the target, besides the skin, within which the body has arrived.
constexpr double there = 1e-3;

}  // namespace

void Journey::begin(const roam::Walker& walker, const roam::Vec3& point, const roam::Vec3& normal) {
  const roam::Body body = walker.body();
  // The extent of the upright body along the normal, so that it stops beside the surface.
  const double away = body.radius + body.half_height * std::abs(normal.z) + 2.0 * walker.skin();
  target_ = point + normal * away;
  under_way_ = true;
  best_ = glm::length(way(walker));
  waited_ = 0.0;
}

roam::Vec3 Journey::way(const roam::Walker& walker) const {
  roam::Vec3 w = target_ - walker.position();
  if (walker.mode() == roam::Mode::walk) w.z = 0.0;  // gravity and steps change z
  return w;
}

roam::Vec3 Journey::velocity(const roam::Walker& walker, double speed, double seconds) {
  const roam::Vec3 w = way(walker);
  const double left = glm::length(w);
  if (left <= there + 2.0 * walker.skin()) {
    end();
    return roam::Vec3(0.0);
  }
  if (waited_ >= patience) {
    if (best_ - left < least_progress * speed * waited_) {
      end();
      return roam::Vec3(0.0);
    }
    best_ = left;
    waited_ = 0.0;
  }
  waited_ += seconds;
  return w * (std::min(speed, left / seconds) / left);
}

}  // namespace osgRoam
