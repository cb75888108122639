#include "motion/sizes.h"

#include <algorithm>
#include <glm/geometric.hpp>

namespace roam::walking {
namespace {

/// Metres outside a region at which it is left, so that a body moving about the border does not keep changing.
constexpr double leaving = 0.05;

/// The smaller body lies in the larger one, and so does its motion from the larger one's centre to its own.
void narrow(Move& m, const Sizes& sizes, double radius) {
  const double by = m.settings.radius - radius, before = m.settings.height;
  sizes.present = sized(sizes.given, {radius, m.settings.support_radius});
  if (m.known.measured == Measured::place) {
    m.known.clearance = std::max(m.known.clearance - by, radius - world_tolerance);
  } else {
    m.known.forget_place();  // the way there may have been much narrower
  }
  const double height = m.height < before ? m.height : m.settings.height;
  m.resize(height, m.place - Vec3(0.0, 0.0, 0.5 * (m.height - height)));
  m.note(EventKind::narrowed);
}

/// Becomes larger if the larger body with the same lowest point is certified free. Otherwise tries a body raised by as
/// much as a round body gains on the slope that it stands on.
void widen(Move& m, const Gait& gait, const Sizes& sizes, double radius) {
  const WalkerSettings larger = sized(sizes.given, {radius, m.settings.support_radius});
  const double height = m.height < m.settings.height ? m.height : larger.height;
  if (2.0 * radius > height) return;  // crouched: waits until the body stands
  const Body body = Body::capsule(radius, height);
  const Vec3 raised(0.0, 0.0, 0.5 * (height - m.height));
  Vec3 lift(0.0);
  if (!m.space.fits(body, m.place + raised)) {
    if (!gait.grounded()) return;
    const double steepness = 1.0 / std::max(gait.ground.z, m.slope_cosine) - 1.0;
    lift.z = m.skin + (radius - m.settings.radius) * steepness;
    if (m.probe(lift).touched || !m.space.fits(body, m.place + lift + raised)) return;
  }
  // The motion of the old body up lies in the new one.
  if (lift.z + raised.z > 0.0) m.go(lift + raised);
  const double gap = m.space.clearance(body, m.place, m.settings.clearance_reach).distance;
  sizes.present = larger;
  m.known.clearance = radius + std::max(gap, -world_tolerance);
  m.known.measured = Measured::place;
  m.resize(height, m.place);
  m.note(EventKind::widened);
}

}  // namespace

WalkerSettings sized(const WalkerSettings& given, const Size& size) {
  WalkerSettings s = given;
  s.radius = size.radius;
  s.support_radius = size.support_radius;
  if (given.height != 2.0 * given.radius) return s;
  s.height = 2.0 * size.radius;
  s.eye = std::min(given.eye, s.height);
  s.step = std::min(given.step, size.radius);
  return s;
}

Size wanted(const Sizes& sizes, const Vec3& centre, const Vec3& feet) {
  Size size = sizes.outside;
  bool in_any = false;
  for (std::size_t i = 0; i < sizes.regions.size(); ++i) {
    const SizeRegion& region = sizes.regions[i];
    const Box box = sizes.inside[i] != 0 ? region.bounds.grown(leaving) : region.bounds;
    sizes.inside[i] = box.holds(centre) || box.holds(feet) ? 1 : 0;
    if (sizes.inside[i] == 0) continue;
    size.radius = in_any ? std::min(size.radius, region.radius) : region.radius;
    size.support_radius = in_any ? std::max(size.support_radius, region.support_radius) : region.support_radius;
    in_any = true;
  }
  return size;
}

void adapt(Move& m, const Gait& gait, const Sizes& sizes) {
  if (sizes.settled()) return;
  const Size want = wanted(sizes, m.place, m.place - Vec3(0.0, 0.0, 0.5 * m.height));
  // The support disc touches nothing. But over a crack it does not shrink.
  const double disc = m.settings.support_radius;
  if (want.support_radius > disc || (want.support_radius < disc && gait.footing != Footing::disc)) {
    sizes.present.support_radius = want.support_radius;
  }
  if (want.radius < m.settings.radius) narrow(m, sizes, want.radius);
  if (want.radius > m.settings.radius) widen(m, gait, sizes, want.radius);
}

bool near_region(const Sizes& sizes, const Move& move, const Vec3& motion) {
  if (sizes.settled()) return false;
  if (move.settings.radius != sizes.outside.radius || move.settings.support_radius != sizes.outside.support_radius) {
    return true;
  }
  Box way;
  // A sliding body may end anywhere within this distance.
  const Vec3 reach(glm::length(motion));
  for (const double below : {0.0, 0.5 * move.height}) {
    way.include(move.place - Vec3(0.0, 0.0, below) - reach);
    way.include(move.place - Vec3(0.0, 0.0, below) + reach);
  }
  return std::any_of(sizes.regions.begin(), sizes.regions.end(), [&](const SizeRegion& region) {
    const Box box = region.bounds.grown(leaving);
    for (int k = 0; k < 3; ++k) {
      if (way.lower[k] > box.upper[k] || way.upper[k] < box.lower[k]) return false;
    }
    return true;
  });
}

}  // namespace roam::walking
