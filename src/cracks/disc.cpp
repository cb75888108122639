#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "cracks/floor_plan.h"
#include "math/level_distance.h"

namespace roam::cracks {

namespace {

/// The direction in which a disc grows fastest while it moves away from all obstacles that it touches: the middle of
/// the shortest arc with all directions away from them. `rate`: metres of radius per metre. None if obstacles surround
/// the disc.
struct Climb {
  double x = 0.0, y = 0.0;
  double rate = 0.0;
};

std::optional<Climb> steepest(const Vec3& centre, const std::vector<NearPlace>& near) {
  std::vector<double> angles;
  for (const NearPlace& n : near) {
    if (n.distance > 0.0) angles.push_back(std::atan2(centre.y - n.point.y, centre.x - n.point.x));
  }
  if (angles.empty()) return std::nullopt;
  std::sort(angles.begin(), angles.end());
  constexpr double turn = 2.0 * std::numbers::pi;
  double gap = turn - angles.back() + angles.front(), begin = angles.front();
  for (std::size_t i = 1; i < angles.size(); ++i) {
    if (angles[i] - angles[i - 1] > gap) {
      gap = angles[i] - angles[i - 1];
      begin = angles[i];
    }
  }
  const double arc = turn - gap;
  if (arc >= std::numbers::pi) return std::nullopt;
  const double middle = begin + 0.5 * arc;
  return Climb{std::cos(middle), std::sin(middle), std::cos(0.5 * arc)};
}

/// The first place on the way from a place to one with a disc as large as `enough` where the disc is that large.
Vec3 first_enough(const PlanObstacles& plan, const Vec3& from, const Vec3& to, double enough) {
  constexpr double precision = 1e-6;  // m
  double below = 0.0, above = 1.0;
  while ((above - below) * level_distance(to, from) > precision) {
    const double middle = 0.5 * (below + above);
    (plan.nearest(from + middle * (to - from), enough).distance >= enough ? above : below) = middle;
  }
  return from + above * (to - from);
}

}  // namespace

std::vector<TouchedFloor> touched_floor(const FloorPlan& plan, const Disc& disc) {
  constexpr double touch_share = 0.02;  // of the radius: floor this much farther still counts as touched
  const double reach = 2.0 * disc.radius;
  std::vector<NearPlace> near;
  plan.touching(disc.centre, reach, touch_share * disc.radius, near);
  std::vector<TouchedFloor> touched;
  for (const NearPlace& n : near) {
    const double x = n.point.x - disc.centre.x, y = n.point.y - disc.centre.y, length = std::hypot(x, y);
    if (n.distance < reach && length > 0.0) touched.push_back({n, {x / length, y / length, 0.0}});
  }
  return touched;
}

Disc grow(const PlanObstacles& plan, const Vec3& start, double enough, double precision, const MayMove& may_move) {
  // Rims that part by less than this per metre count as parallel: 0.04 mm over the examined 4 m.
  constexpr double least_rate = 1e-5;
  constexpr double fair_share = 0.3;  // a step needs at least this share of the growth that the rate promises
  constexpr int most_steps = 400;     // against rims that never end; not seen to happen
  constexpr double infinite = std::numeric_limits<double>::infinity();
  std::vector<NearPlace> near;
  Disc disc{start, 0.0};
  double slack = infinite;
  for (int i = 0; i < most_steps; ++i) {
    plan.touching(disc.centre, enough, std::min(slack, 0.25 * enough), near);
    disc.radius = near.front().distance;
    if (disc.radius >= enough) break;
    if (slack == infinite) slack = 0.25 * disc.radius;
    std::erase_if(near, [&](const NearPlace& n) { return n.distance > disc.radius + slack; });
    const std::optional<Climb> climb = steepest(disc.centre, near);
    bool moved = false;
    if (climb && climb->rate > least_rate) {
      for (double way = std::max(disc.radius, 2.0 * slack); !moved && way > 0.5 * slack; way *= 0.5) {
        const Vec3 next = disc.centre + Vec3(way * climb->x, way * climb->y, 0.0);
        moved = plan.nearest(next, enough).distance >= std::min(disc.radius + fair_share * climb->rate * way, enough) &&
                may_move(disc.centre, next);
        if (!moved) continue;
        const bool is_enough = plan.nearest(next, enough).distance >= enough;
        disc.centre = is_enough ? first_enough(plan, disc.centre, next, enough) : next;
      }
    }
    if (moved) continue;
    if (slack <= precision) break;
    slack = std::max(0.25 * slack, precision);
  }
  return disc;
}

}  // namespace roam::cracks
