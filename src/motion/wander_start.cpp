#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <vector>

#include "math/floating_point.h"
#include "math/slope.h"
#include "motion/look_ahead.h"
#include "roam/error.h"
#include "roam/wander.h"

namespace roam {

using namespace wandering;

namespace {

constexpr int most_floors = 64;       // that are looked at in a column
constexpr double lift = 0.05;         // m, a start is looked for so high above a floor, then let down
constexpr double floor_gap = 0.01;    // m, at least: the next floor of a column is looked for so far below the last
constexpr int most_more_rays = 2048;  // in all, for scenes that are higher than a ray is long
constexpr double wall_reach = 30.0;   // m, farther is the open
constexpr double hall = 15.0;         // m, who sees farther from within walls is in no closet and no hollow house
constexpr double inside_worth = 4.0;
constexpr double hollow = 1.0;            // m, of air below a floor under the sky: that is a roof
constexpr double least_open_room = 10.0;  // m, the sum of eight directions: under the sky, less is no ground to walk on
constexpr int room_strides = 20;          // 10 m: farther is free enough
constexpr std::size_t most_rooms = 16;    // whose views are compared
constexpr double same_room = 3.0;         // m: nearer places are in the same room
constexpr double long_view = 7.0;         // m: who sees so far is in no small room
constexpr double view_share = 0.75;       // of the longest view: that is long, too

/// Whether there is air below the surface at `floor`, over another one.
bool is_over_hollow(const Space& space, const Vec3& floor) {
  const double gap = std::max(floor_gap, 8.0 * space.largest_error());
  const double depth = std::min(floor.z - space.bounds().lower.z + 1.0, Space::motion_limit);
  const FirstImpact below = space.first_impact({0.0, 0.0}, floor - Vec3(0, 0, gap), {0, 0, -depth});
  return below.hit && gap + below.time * depth > hollow;
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
                 [&](const Vec3&, double length) { start.room += length; });
  }
  start.on_top = !above.hit && (start.room < least_open_room || is_over_hollow(space, floor));
  // In the open, a place with walls all around has no view: a hollow of the land.
  if (above.hit || sight >= wall_reach) start.room *= 1.0 + walls;
  // A long corridor is open at its ends.
  if (above.hit && walls >= directions - 1 && sight > hall) start.room *= inside_worth;
  return start;
}

/// Metres to the walls at the height of the eye, on average over a sixth of the horizon: where they are farthest.
double view_from(const Space& space, const WalkerSettings& settings, const Vec3& place) {
  constexpr int directions = 32, beside = 2;
  constexpr double slit = 0.2;  // m, radius: nobody looks through narrower ones
  const Vec3 eye = place + Vec3(0, 0, std::max(0.0, settings.eye - 0.5 * settings.height));
  std::array<double, directions> way{};
  for (int i = 0; i < directions; ++i) {
    const FirstImpact wall = space.first_impact({slit, 0.0}, eye, wall_reach * level(i, directions));
    way[static_cast<std::size_t>(i)] = wall.hit ? wall.time * wall_reach : 0.0;
  }
  double best = 0.0;
  for (int i = 0; i < directions; ++i) {
    double sum = 0.0;
    for (int k = -beside; k <= beside; ++k) sum += way[static_cast<std::size_t>((i + k + directions) % directions)];
    best = std::max(best, sum / (2 * beside + 1));
  }
  return best;
}

/// Puts places with a long view before the others, of places that are sorted, best first. A bed leaves more room to
/// stride than a table and chairs, but a living room is larger than a bedroom. In the open nothing changes.
void prefer_views(std::vector<WanderStart>& places, const Space& space, const WalkerSettings& settings) {
  if (places.empty() || !space.first_impact({0.0, 0.0}, places.front().place, {0, 0, wall_reach}).hit) return;
  struct Room {
    WanderStart start;
    double view;
  };
  std::vector<Room> rooms;
  double longest = 0.0;
  for (const WanderStart& start : places) {
    if (rooms.size() == most_rooms || start.on_top != places.front().on_top) break;
    if (std::any_of(rooms.begin(), rooms.end(),
                    [&](const Room& room) { return glm::distance(room.start.place, start.place) < same_room; })) {
      continue;
    }
    rooms.push_back({start, std::min(view_from(space, settings, start.place), long_view)});
    if (rooms.front().view == long_view) return;
    longest = std::max(longest, rooms.back().view);
  }
  std::erase_if(rooms, [&](const Room& room) { return room.view < view_share * longest; });
  std::vector<WanderStart> preferred;
  for (const Room& room : rooms) preferred.push_back(room.start);
  places.insert(places.begin(), preferred.begin(), preferred.end());
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
  prefer_views(found, space, settings);
  const auto best = std::find_if(found.begin(), found.end(),
                                 [&](const WanderStart& start) { return !accepts || accepts(start.place); });
  return best == found.end() ? std::nullopt : std::optional(*best);
}

}  // namespace roam
