#include <algorithm>
#include <optional>
#include <vector>

#include "math/floating_point.h"
#include "math/slope.h"
#include "motion/look_ahead.h"
#include "roam/error.h"
#include "roam/wander.h"

namespace roam {

namespace {

using namespace wandering;

constexpr int most_floors = 64;       // that are looked at in a column
constexpr double lift = 0.05;         // m, a start is looked for so high above a floor, then let down
constexpr double floor_gap = 0.01;    // m, at least: the next floor of a column is looked for so far below the last
constexpr int most_more_rays = 2048;  // in all, for scenes that are higher than a ray is long
constexpr double wall_reach = 30.0;   // m, farther is the open
// m: indoors, a view counts from the one to the other
constexpr double short_view = 4.0, long_view = 7.0;
constexpr double hollow = 1.0;            // m, of air below a floor under the sky: that is a roof
constexpr double least_open_room = 10.0;  // m, the sum of eight directions: under the sky, less is no ground to walk on
constexpr int room_strides = 20;          // 10 m: farther is free enough

/// Whether there is air below the surface at `floor`, over another one.
bool is_over_hollow(const Space& space, const Vec3& floor) {
  const double gap = std::max(floor_gap, 8.0 * space.largest_error());
  const double depth = std::min(floor.z - space.bounds().lower.z + 1.0, Space::motion_limit);
  const FirstImpact below = space.first_impact({0.0, 0.0}, floor - Vec3(0, 0, gap), {0, 0, -depth});
  return below.hit && gap + below.time * depth > hollow;
}

/// The weight of a place indoors by its view. A bed leaves more room to stride than a table and chairs, but a living
/// room is larger than a bedroom.
double worth_of_view(const Space& space, const Vec3& eye) {
  const double view = open_direction(space, eye, 2.0 * long_view).length;
  const double times = std::clamp(view, short_view, long_view) / short_view;
  return times * times * times;
}

/// A place on the floor at `floor`, or in the air above it, and how much room there is; less than 0: the body does not
/// fit.
WanderStart start_at(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& floor) {
  const Body body = Body::capsule(settings.radius, settings.height);
  WanderStart start{.room = -1.0};
  const FirstImpact above = space.first_impact({0.0, 0.0}, floor + Vec3(0, 0, lift), {0, 0, wall_reach});
  const double ceiling = lift + above.time * wall_reach;
  if (mode == Mode::fly) {
    start.place = floor + Vec3(0, 0, above.hit ? 0.5 * ceiling : fly_height + 0.5 * settings.height);
  } else {
    start.place = floor + Vec3(0, 0, 0.5 * settings.height + lift);
  }
  if (space.clearance(body, start.place, lift).distance <= 0.0) return start;
  if (mode == Mode::walk) {
    const Vec3 down{0, 0, -2.0 * lift - settings.radius};
    const Impact ground = space.sweep(body, start.place, down);
    if (!ground.hit || ground.normal.z < least_upright(settings.slope_degrees)) return start;
  }
  start.room = 0.0;
  constexpr int directions = 8;
  int walls = above.hit ? 1 : 0;
  double sight = 0.0;
  for (int i = 0; i < directions; ++i) {
    const FirstImpact wall = space.first_impact({0.0, 0.0}, start.place, wall_reach * level(i, directions));
    walls += wall.hit ? 1 : 0;
    sight = std::max(sight, (wall.hit ? wall.time : 1.0) * wall_reach);
    stride_ahead({space, settings, mode, body}, start.place, level(i, directions), room_strides,
                 [&](const Vec3&, double length) { return start.room += length, true; });
  }
  start.on_top = !above.hit && (start.room < least_open_room || is_over_hollow(space, floor));
  // In the open, a place with walls all around has no view: a hollow of the land.
  if (above.hit || sight >= wall_reach) start.room *= 1.0 + walls;
  // A long corridor is open at its ends.
  if (above.hit && walls >= directions - 1) {
    start.room *= worth_of_view(space, start.place + Vec3(0, 0, settings.eye - 0.5 * settings.height));
  }
  return start;
}

/// Metres from a place down to the triangle below it, if that is within `depth`. A ray reaches no farther than a
/// motion; `more_rays` is how many more may be cast.
std::optional<double> drop_from(const Space& space, const Vec3& place, double depth, int& more_rays) {
  for (double begin = 0.0; begin < depth && (begin == 0.0 || --more_rays >= 0); begin += Space::motion_limit) {
    const double part = std::min(depth - begin, Space::motion_limit);
    const FirstImpact down = space.first_impact({0.0, 0.0}, place - Vec3(0, 0, begin), {0, 0, -part});
    if (down.hit) return begin + down.time * part;
  }
  return std::nullopt;
}

}  // namespace

std::optional<WanderStart> wander_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                        std::span<const Vec3> floors, int columns, const std::function<bool()>& goes_on,
                                        const std::function<bool(const Vec3&)>& accepts) {
  const DefaultFloatingPoint guard;
  check(settings);
  const Box& box = space.bounds();
  if (box.empty()) return std::nullopt;
  const Vec3 size = box.size();
  std::vector<WanderStart> found;
  // A hit may be some errors above the triangle: it must not be found again.
  int more_rays = most_more_rays;
  const double below = std::max(floor_gap, 8.0 * space.largest_error());
  const auto consider = [&](const Vec3& floor) {
    if (goes_on && !goes_on()) throw Cancelled();
    const WanderStart start = start_at(space, settings, mode, floor);
    if (start.room >= 0.0) found.push_back(start);
  };
  for (const Vec3& floor : floors) consider(floor);
  for (int i = 0; i < columns; ++i) {
    for (int j = 0; j < columns; ++j) {
      Vec3 top{box.lower.x + size.x * (i + 0.5) / columns, box.lower.y + size.y * (j + 0.5) / columns,
               box.upper.z + 1.0};
      for (int level_below = 0; level_below < most_floors; ++level_below) {
        const std::optional<double> drop = drop_from(space, top, top.z - box.lower.z + 1.0, more_rays);
        if (!drop) break;
        top.z -= *drop;
        consider(top);
        top.z -= below;
      }
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const WanderStart& a, const WanderStart& b) {
    return a.on_top != b.on_top ? b.on_top : a.room > b.room;
  });
  const auto best = std::find_if(found.begin(), found.end(),
                                 [&](const WanderStart& start) { return !accepts || accepts(start.place); });
  return best == found.end() ? std::nullopt : std::optional(*best);
}

}  // namespace roam
