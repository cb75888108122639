#include "osgroam/soft_eye.h"

#include <algorithm>
#include <cmath>

namespace osgRoam {
namespace {

/// Time constant in seconds of the eye's return after a step. A stair at walking speed takes 0.2 s.
constexpr double softness = 0.08;

/// Metres. Less is invisible.
constexpr double least_lag = 1e-4;

/// Least depth of the eye inside the body's surface, as a part of the radius.
constexpr double inside = 0.25;

double half_axis(double radius, double body_height) { return 0.5 * body_height - radius; }

double eye_distance(const roam::WalkerSettings& s, double body_height) {
  return s.radius - std::max(0.0, std::abs(eye_height(s, body_height)) - half_axis(s.radius, body_height));
}

}  // namespace

double eye_height(const roam::WalkerSettings& s, double body_height) {
  const double most = half_axis(s.radius, body_height) + (1.0 - inside) * s.radius;
  return std::clamp(s.eye * (body_height / s.height) - 0.5 * body_height, -most, most);
}

double least_eye_distance(const roam::WalkerSettings& s) {
  const double crouched = std::min(s.height, std::max(s.crouch_height, 2.0 * s.radius));
  return std::min(eye_distance(s, s.height), eye_distance(s, crouched));
}

SoftEye::Before SoftEye::before(const roam::Walker& walker) {
  const double height = walker.body().height();
  return {walker.position().z + eye_height(walker.settings(), height), height, walker.grounded()};
}

void SoftEye::follow(const roam::Walker& walker, const Before& before, double seconds) {
  const Before after = SoftEye::before(walker);
  const bool on_foot = walker.mode() == roam::Mode::walk && before.grounded && after.grounded;
  // In the air the eye moves with the body, which jumps and falls smoothly.
  if (on_foot || before.height != after.height) lag_ += before.z - after.z;
  lag_ = std::clamp(lag_ * std::exp(-seconds / softness), -after.height, after.height);
  if (std::abs(lag_) < least_lag) reset();
}

void SoftEye::keep_free(const roam::Walker& walker) {
  if (lag_ == 0.0) return;
  const roam::Body body = walker.body();
  const double belongs = eye_height(walker.settings(), body.height());
  if (lag_ < 0.0) {
    // Down to the lower end of the axis, each point is as free as the body.
    lag_ = std::max(lag_, std::min(0.0, -body.half_height - belongs));
  } else if (walker.mode() != roam::Mode::ghost && !walker.held()) {
    const roam::Vec3 from = walker.position() + roam::Vec3(0.0, 0.0, belongs);
    const double radius = least_eye_distance(walker.settings());
    lag_ *= walker.space().first_impact({radius, 0.0}, from, {0.0, 0.0, lag_}).time;
  }
}

roam::Vec3 SoftEye::eye(const roam::Walker& walker) const {
  return walker.position() + roam::Vec3(0.0, 0.0, eye_height(walker.settings(), walker.body().height()) + lag_);
}

}  // namespace osgRoam
