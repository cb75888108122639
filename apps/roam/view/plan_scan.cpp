#include "view/plan_scan.h"

#include <algorithm>
#include <cmath>

#include "roam/error.h"

namespace roam::app {
namespace {

constexpr double behind = 0.01;      // m: the next ray begins so far behind a hit
constexpr int most_on_a_line = 400;  // hits; more are clutter that no plan shows

/// Adds what a ray along `axis` (0: x, 1: y) meets, one surface after another.
void scan_line(const Space& space, const PlanArea& area, int axis, double aside, std::vector<glm::vec2>& out) {
  const int across = 1 - axis;
  Vec3 from = area.centre;
  from[axis] -= area.half;
  from[across] += aside;
  double left = 2.0 * area.half;
  for (int i = 0; i < most_on_a_line && left > 0.0; ++i) {
    Vec3 motion(0.0);
    motion[axis] = std::min(left, Space::motion_limit);
    const Impact hit = space.ray(from, motion);
    if (!hit.hit || hit.unknown) return;
    const double facing = std::abs(hit.normal[axis]), turned = std::abs(hit.normal[across]);
    if (facing > 0.0 && (axis == 0 ? facing >= turned : facing > turned)) {
      // The piece of the surface between this line's middles to its neighbours.
      const double half = 0.5 * area.spacing, shift = half * hit.normal[across] / hit.normal[axis];
      for (const double side : {-1.0, 1.0}) {
        glm::dvec2 end(hit.point.x - area.centre.x, hit.point.y - area.centre.y);
        end[axis] -= side * shift;
        end[across] += side * half;
        out.emplace_back(end);
      }
    }
    const double passed = hit.time * motion[axis] + behind;
    from[axis] += passed;
    left -= passed;
  }
}

}  // namespace

std::vector<glm::vec2> scan_plan(const Space& space, const PlanArea& area, const std::function<bool()>& goes_on) {
  std::vector<glm::vec2> found;
  const int lines = static_cast<int>(std::ceil(2.0 * area.half / area.spacing));
  for (int i = 0; i < lines; ++i) {
    if (!goes_on()) throw Cancelled();
    const double aside = -area.half + (i + 0.5) * area.spacing;
    for (const int axis : {0, 1}) scan_line(space, area, axis, aside, found);
  }
  return found;
}

}  // namespace roam::app
