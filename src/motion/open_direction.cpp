#include <algorithm>
#include <array>

#include "math/floating_point.h"
#include "motion/look_ahead.h"
#include "roam/wander.h"

namespace roam {

OpenDirection open_direction(const Space& space, const Vec3& eye, double reach) {
  constexpr int directions = 32;
  constexpr std::array<double, 5> weights{1.0, 2.0, 3.0, 2.0, 1.0};  // of neighbouring directions
  constexpr double all_weights = 9.0;
  constexpr int beside = 2;
  constexpr double slit = 0.15;  // m, radius: narrower ones are closed
  const DefaultFloatingPoint guard;
  const Box box = space.bounds();
  if (box.empty()) return {};
  // Near a floor or a wall a smaller ball: it must not touch them from the start.
  const double ball = std::clamp(0.5 * space.clearance({0.0, 0.0}, eye, 2.0 * slit).distance, 0.0, slit);
  std::array<double, directions> way{};
  for (int i = 0; i < directions; ++i) {
    const Vec3 direction = wandering::level(i, directions);
    double length = std::min(reach, Space::motion_limit);
    for (int k = 0; k < 2; ++k) {
      if (direction[k] == 0.0) continue;
      const double border = direction[k] > 0.0 ? box.upper[k] : box.lower[k];
      length = std::clamp((border - eye[k]) / direction[k], 0.0, length);
    }
    way[static_cast<std::size_t>(i)] = length * space.first_impact({ball, 0.0}, eye, length * direction).time;
  }
  OpenDirection best;
  for (int i = 0; i < directions; ++i) {
    double sum = 0.0;
    for (int k = -beside; k <= beside; ++k) {
      sum += weights[static_cast<std::size_t>(k + beside)] *
             way[static_cast<std::size_t>((i + k + directions) % directions)];
    }
    if (sum / all_weights > best.length) best = {360.0 * i / directions, sum / all_weights};
  }
  return best;
}

}  // namespace roam
