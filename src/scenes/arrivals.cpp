#include "scenes/arrivals.h"

#include <algorithm>
#include <thread>

namespace roam::app {
namespace {

/// Seconds of one wait.
constexpr double slice = 0.02;

}  // namespace

Arrivals::Arrivals(OpenScene& scene) : scene_(scene), loads_(scene.paging()->loads) {}

double Arrivals::wait(const Body& body, const Vec3& place, const Vec3& velocity) {
  settled_ = scene_.wait_along(body, place, velocity, slice);
  if (settled_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  const std::uint64_t now = scene_.paging()->loads;
  if (now != loads_) last_ = Clock::now();
  loads_ = now;
  return std::chrono::duration<double>(Clock::now() - last_).count();
}

void Surroundings::wait(const Vec3& place, double reach) {
  const Body point = Body{};
  const Vec3 velocity(std::min(reach, fits_), 0.0, 0.0);
  if (scene_.wait_along(point, place, velocity, slice)) return;
  Arrivals arrivals(scene_);
  while (arrivals.wait(point, place, velocity) < Arrivals::full_after) {
    if (arrivals.settled()) return;
  }
  fits_ = 0.5 * velocity.x;
}

}  // namespace roam::app
