#include "view/start.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "roam/error.h"
#include "roam/wander.h"
#include "roam/world.h"
#include "scenes/free_start.h"
#include "scenes/triangles_around.h"
#include "store/meshes.h"

namespace roam::app {
namespace {

constexpr double degree = std::numbers::pi / 180.0;
// m: radius that is loaded from a store to choose the direction
constexpr double view_limit = 60.0;
constexpr double overview_yaw = 60.0;     // degrees: shows two sides of a building, neither frontally
constexpr double overview_pitch = -30.0;  // degrees

Vec3 direction(double yaw, double pitch) {
  return {std::cos(yaw * degree) * std::cos(pitch * degree), std::sin(yaw * degree) * std::cos(pitch * degree),
          std::sin(pitch * degree)};
}

/// Whether the eye at `eye` sees anything near the middle of its picture.
bool sees_something(const Space& space, const Vec3& eye, double yaw) {
  const Box box = space.bounds();
  const double reach = box.empty() ? 0.0 : std::min(2.0 * glm::length(box.size()), Space::motion_limit);
  for (const double aside : {-20.0, 0.0, 20.0}) {
    for (const double up : {-20.0, 0.0, 20.0}) {
      if (space.first_impact({0.0, 0.0}, eye, reach * direction(yaw + aside, up)).hit) return true;
    }
  }
  return false;
}

/// The view from an eye.
struct View {
  double yaw = 0.0;  ///< degrees, direction in which most is open
  bool anything = false;
};

View look(const Space& space, const Vec3& eye) {
  const double yaw = open_direction(space, eye, Space::motion_limit).yaw;
  return {yaw, sees_something(space, eye, yaw)};
}

/// Whether this is wide land, even if it has a bottom.
bool is_land(const Box& bounds, double room) {
  constexpr double wide = 60.0;  // m, of the sum of eight directions
  constexpr double flat = 0.1;   // height of the land, of its width
  const Vec3 size = bounds.size();
  return room >= wide && size.z < flat * std::min(size.x, size.y);
}

/// The radius of the ball around a box, in metres.
double radius_of(const Box& box) { return box.empty() ? 1.0 : std::max(0.5 * glm::length(box.size()), 1e-4); }

/// From its middle to a camera that sees all of it, m.
double distance_for(const Box& box, double fov) { return radius_of(box) / std::sin(0.5 * fov * degree); }

/// "19 x 11.4 x 3 m", "7.6 x 4.56 x 1.2 mm"
std::string size_text(const Box& box) {
  constexpr double small = 0.1;  // m
  const bool in_mm = std::max({box.size().x, box.size().y, box.size().z}) < small;
  const Vec3 size = (in_mm ? 1e3 : 1.0) * box.size();
  return fmt::format("{:.3g} x {:.3g} x {:.3g} {}", size.x, size.y, size.z, in_mm ? "mm" : "m");
}

/// Why a body does not start on top of a scene.
std::string no_floor_text(const Box& bounds) {
  constexpr double large = 100.0;  // m: few things that are seen from outside are longer
  const bool doubted = std::max({bounds.size().x, bounds.size().y, bounds.size().z}) > large;
  return fmt::format("the scene, {}, has no floor with room for this body{}", size_text(bounds),
                     doubted ? "; is its unit right (--unit)?" : "");
}

/// Where a camera is beside a body's centre.
Vec3 eye_offset(const WalkerSettings& settings) { return {0.0, 0.0, settings.eye - 0.5 * settings.height}; }

/// Outside of the scene, flying, with all of it in view. A ghost near to a scene that would be small in the picture
/// because the body has no room nearer to it.
StartPlace outside(const WalkerSettings& settings, Mode mode, const Box& bounds, const std::string& why) {
  constexpr double fov = 60.0;
  constexpr double gap = 0.1;    // m, at least, between the body and the ball around the scene
  constexpr double small = 0.5;  // of its greatest size in the picture
  StartPlace start;
  start.mode = mode == Mode::ghost ? Mode::ghost : Mode::fly;
  start.pose = overview(bounds, fov);
  const double whole = distance_for(bounds, fov);
  const double needed = (radius_of(bounds) + settings.radius + gap) / std::cos(overview_pitch * degree);
  if (whole < small * needed) {
    start.mode = Mode::ghost;
    start.note = fmt::format("A ghost, because the scene is smaller than the body: {}", size_text(bounds));
  } else {
    start.pose.position -= std::max(0.0, needed - whole) * direction(overview_yaw, overview_pitch);
    if (!why.empty()) start.note = fmt::format("Outside of the scene, flying: {}", why);
  }
  start.pose.position -= eye_offset(settings);
  return start;
}

/// `find` returns a start for a body of a mode, or throws Error.
StartPlace start_place(const WalkerSettings& settings, Mode mode, const Box& bounds,
                       const std::function<WanderStart(Mode)>& find,
                       const std::function<View(const Vec3&)>& look_around) {
  StartPlace start;
  start.mode = mode;
  std::string why;
  for (const Mode way : {Mode::walk, Mode::fly}) {
    if (way == Mode::walk && mode != Mode::walk) continue;
    try {
      const WanderStart found = find(way);
      if (found.on_top && !is_land(bounds, found.room)) {
        if (mode == Mode::walk) why = no_floor_text(bounds);
        break;
      }
      const Vec3 centre = found.place;
      if (way != mode && mode == Mode::walk) {
        start.mode = Mode::fly;
        start.note = "There is no floor that this body can stand on: it flies. Is the up axis right (--up)?";
      }
      const View view = look_around(centre + eye_offset(settings));
      // A flying body may as well begin with something in view.
      if (start.mode == Mode::fly && !view.anything) return outside(settings, mode, bounds, why);
      start.pose = {centre, view.yaw, 0.0};
      return start;
    } catch (const Error& error) {
      why = error.what();
    }
  }
  return outside(settings, mode, bounds, why);
}

}  // namespace

Pose overview(const Box& box, double fov) {
  const Vec3 centre = box.empty() ? Vec3(0.0) : box.center();
  return {centre - distance_for(box, fov) * direction(overview_yaw, overview_pitch), overview_yaw, overview_pitch};
}

StartPlace find_start(const Space& space, const WalkerSettings& settings, Mode mode, std::span<const Mesh> meshes,
                      const std::function<bool()>& goes_on) {
  const std::vector<Vec3> floors = floor_samples(meshes);
  return start_place(
      settings, mode, space.bounds(),
      [&](Mode way) { return free_start(space, settings, way, floors, meshes, goes_on); },
      [&](const Vec3& eye) { return look(space, eye); });
}

StartPlace find_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                      const std::function<bool()>& goes_on) {
  return start_place(
      settings, mode, store.info().bounds, [&](Mode way) { return free_start(store, memory, settings, way, goes_on); },
      [&](const Vec3& eye) {
        Mesh mesh;
        store::append(mesh, triangles_around(store, eye, view_limit, indexed_in(memory), goes_on).triangles);
        return look(World::build({&mesh, 1}), eye);
      });
}

}  // namespace roam::app
