#include "view/turntable.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "view/surroundings.h"

namespace roam::app {
namespace {

// Degrees. The turn begins where the overview stands.
constexpr double first_yaw = 60.0, pitch = -27.0;
constexpr int looked_from = 72;

/// Distance from which a camera with this heading sees all corners of a box of these half sides around its middle.
double distance_for(const Vec3& half, double yaw, double tan_across, double tan_up) {
  const Vec3 ahead = gaze(yaw, glm::radians(pitch)), right(std::sin(yaw), -std::cos(yaw), 0.0);
  const Vec3 up = glm::cross(right, ahead);
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 at((corner & 1) != 0 ? half.x : -half.x, (corner & 2) != 0 ? half.y : -half.y,
                  (corner & 4) != 0 ? half.z : -half.z);
    const double aside = std::max(std::abs(glm::dot(at, right)) / tan_across, std::abs(glm::dot(at, up)) / tan_up);
    distance = std::max(distance, aside - glm::dot(at, ahead));
  }
  return distance;
}

}  // namespace

Pose on_turntable(const Box& box, double fov, double aspect, double share) {
  constexpr double least = 1e-3;   // metres
  constexpr double border = 1.04;  // room at the edge of the picture
  const Vec3 middle = box.empty() ? Vec3(0.0) : box.center();
  const Vec3 half = box.empty() ? Vec3(1.0) : glm::max(0.5 * box.size(), Vec3(least));
  const double tan_up = std::tan(0.5 * glm::radians(fov)) / border;
  double distance = 0.0;
  for (int i = 0; i < looked_from; ++i) {
    distance = std::max(distance, distance_for(half, glm::radians(360.0 * i / looked_from), aspect * tan_up, tan_up));
  }
  const double yaw = first_yaw + 360.0 * share;
  return {middle - distance * gaze(glm::radians(yaw), glm::radians(pitch)), yaw, pitch};
}

}  // namespace roam::app
