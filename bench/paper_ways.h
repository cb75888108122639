#pragma once
/// \file
/// The ways of the paper's experiments, and the motion of a body along one.

#include <functional>
#include <string>
#include <vector>

#include "roam/math.h"
#include "roam/sweep.h"

namespace roam::bench {

/// A straight way of a body's centre, metres. Those of the paper are in the coordinates of its Table 1.
struct Way {
  std::string name;
  Vec3 from, to;
  double radius = 0.5;
  double speed = 50.0;    ///< metres per second
  bool walking = false;   ///< under gravity
  bool adapting = false;  ///< the radius may change on the way
  double height = 0.0;    ///< of an upright capsule; 0: a sphere

  [[nodiscard]] Body body() const { return height > 0.0 ? Body::capsule(radius, height) : Body{.radius = radius}; }
};

/// Table 1's three ways, the split again for a sphere that falls into it, and a way into a grotto behind a door of 0.75
/// m.
[[nodiscard]] std::vector<Way> paper_ways(double radius, double split_radius);

/// Steps a second.
constexpr double paper_rate = 60.0;

/// Moves a body through a scene.
struct Mover {
  std::function<void(const Way&)> place;
  /// One step at this velocity (m/s). Returns the centre afterwards. Only this is timed.
  std::function<Vec3(const Vec3& velocity)> step;
  /// Called with the rest of the step's frame, in seconds, for loading. May be empty.
  std::function<void(double seconds)> rest{};
  /// The least radius of the body on the last step of an adapting way. Empty if the mover cannot change it.
  std::function<double()> radius{};
  /// Nanoseconds of the last step, if another process makes the steps. Empty: the thread's own time counts.
  std::function<double()> nanoseconds{};
};

/// The record of a way.
struct Walked {
  std::vector<double> nanoseconds;  ///< of each step
  std::vector<double> radii;        ///< metres, the least of the body on each step
  std::vector<Vec3> places;         ///< the centre at the start and after each step
  bool cut = false;                 ///< ended by the clock while it made progress
};

[[nodiscard]] bool arrived(const Way& way, const Vec3& place);
[[nodiscard]] bool has_fallen(const Way& way, const Vec3& place);

/// Moves until the end is reached, the body is stuck or has fallen, or `longest` seconds have passed.
[[nodiscard]] Walked walk(const Mover& mover, const Way& way, double longest);

}  // namespace roam::bench
