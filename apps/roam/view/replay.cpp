#include "view/replay.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::app {
namespace {

constexpr double look_ahead = 4.0;     // m along the path: turns the gaze into a bend early
constexpr double turning_time = 0.35;  // s: time constant of a turn of the gaze

/// The direction of a camera with this rotation: OpenSceneGraph's cameras look along their own -z.
Vec3 view_direction(const std::array<double, 4>& q) {
  const auto [x, y, z, w] = q;
  const Vec3 d(-2.0 * (x * z + w * y), -2.0 * (y * z - w * x), 2.0 * (x * x + y * y) - 1.0);
  const double length = glm::length(d);
  return length > 0.0 ? d / length : Vec3(1.0, 0.0, 0.0);
}

}  // namespace

Replay::Replay(Walker& walker, const std::vector<Waypoint>& path, const RouteOptions& options)
    : walker_(&walker),
      path_(path),
      route_(walker, positions(path), options),
      speed_(options.speed),
      mode_(walker.mode()),
      place_(walker.position()) {}

void Replay::lead(osgRoam::Manipulator& roamer) {
  roamer.setPilot([this](Walker&, double) { return advance(); });
  roamer.placed();
  look(roamer, 0.0);
}

void Replay::look(osgRoam::Manipulator& roamer, double seconds) {
  if (done()) return;
  const auto [yaw, pitch] = gaze(seconds);
  roamer.look(yaw, pitch);
}

const StepReport* Replay::advance() {
  left_ = left_ || walker_->mode() != mode_ || walker_->position() != place_;
  if (done()) return nullptr;
  const StepReport& report = route_.advance();
  place_ = walker_->position();
  return &report;
}

Vec3 Replay::wish() const {
  const std::size_t next = std::min(route_.result().waypoints, path_.size() - 1);
  const Vec3 way = path_[next].position - walker_->position();
  const double length = glm::length(way);
  return length > 0.0 ? speed_ / length * way : Vec3(0.0);
}

Vec3 Replay::recorded_direction() const {
  const std::size_t next = std::min(route_.result().waypoints, path_.size() - 1);
  const std::size_t last = next > 0 ? next - 1 : 0;
  const double before = glm::distance(path_[last].position, walker_->position());
  const double after = glm::distance(path_[next].position, walker_->position());
  const double share = before + after > 0.0 ? before / (before + after) : 1.0;
  const Vec3 mixed =
      (1.0 - share) * view_direction(path_[last].pose->rotation) + share * view_direction(path_[next].pose->rotation);
  return glm::length(mixed) > 1e-6 ? glm::normalize(mixed) : view_direction(path_[next].pose->rotation);
}

Vec3 Replay::direction_ahead() const {
  double left = look_ahead;
  Vec3 place = walker_->position();
  for (std::size_t i = route_.result().waypoints; i < path_.size() && left > 0.0; ++i) {
    const Vec3 way = path_[i].position - place;
    const double length = glm::length(way);
    if (length > 0.0) place += std::min(1.0, left / length) * way;
    left -= length;
  }
  Vec3 ahead = place - walker_->position();
  // Near the end, keep the gaze.
  constexpr double least = 0.5;
  if (glm::length(ahead) < least) return direction_.value_or(Vec3(1.0, 0.0, 0.0));
  ahead = glm::normalize(ahead);
  // When walking, look ahead, not at the feet: the heights of waypoints say little about the slope.
  if (mode_ == Mode::walk) ahead.z = std::clamp(ahead.z, -0.3, 0.3);
  return glm::normalize(ahead);
}

Replay::Gaze Replay::gaze(double seconds) {
  const bool recorded = path_.front().pose.has_value();
  const Vec3 wish = recorded ? recorded_direction() : direction_ahead();
  if (!direction_ || recorded) {
    direction_ = wish;
  } else {
    const double share = 1.0 - std::exp(-seconds / turning_time);
    Vec3 turned = (1.0 - share) * *direction_ + share * wish;
    // A turn of 180 degrees: any side will do.
    if (glm::length(turned) < 0.1) turned += Vec3(-direction_->y, direction_->x, 0.0);
    direction_ = glm::normalize(turned);
  }
  return {std::atan2(direction_->y, direction_->x), std::asin(std::clamp(direction_->z, -1.0, 1.0))};
}

void Replay::fill(ViewReport& report) const {
  report.result = route_.result();
  report.path_ended = ended();
  report.waypoints = path_.size();
}

}  // namespace roam::app
