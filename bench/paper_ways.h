#pragma once
/// \file
/// The ways of the paper's experiments, and how a body goes along one.

#include <functional>
#include <string>
#include <vector>

#include "roam/math.h"

namespace roam::bench {

/// A straight way of a sphere's centre, metres, in the coordinates of the paper's Table 1.
struct Way {
  std::string name;
  Vec3 from, to;
  double radius = 0.5;
  double speed = 50.0;    ///< metres per second
  bool walking = false;   ///< under gravity
  bool adapting = false;  ///< who can change the radius on the way may do so
};

/// Table 1's three, the split once more for a sphere that it swallows, and one into a grotto behind a door of 0.75 m.
[[nodiscard]] std::vector<Way> paper_ways(double radius, double split_radius);

/// Steps a second.
constexpr double paper_rate = 60.0;

/// What moves a sphere through a scene.
struct Mover {
  std::function<void(const Way&)> place;
  /// One step at this velocity (m/s); the centre afterwards. This is what is timed.
  std::function<Vec3(const Vec3& velocity)> step;
  /// What the step has left of its frame, seconds: for those who load meanwhile. May be empty.
  std::function<void(double seconds)> rest{};
  /// The least radius that the body had on the last step, for those who change it on ways that are adapting. Empty for
  /// those who cannot.
  std::function<double()> radius{};
  /// Nanoseconds of the last step, for those whose steps another process takes. Empty: the thread's own time counts.
  std::function<double()> nanoseconds{};
};

/// How a body went.
struct Walked {
  std::vector<double> nanoseconds;  ///< of each step
  std::vector<double> radii;        ///< metres, the least that the body had on each step
  std::vector<Vec3> places;         ///< the centre at the start and after each step
  bool cut = false;                 ///< ended by the clock while it was still getting on
};

[[nodiscard]] bool arrived(const Way& way, const Vec3& place);
[[nodiscard]] bool has_fallen(const Way& way, const Vec3& place);

/// Goes until the end is reached, nothing moves any more, the body has fallen, or `longest` seconds have passed.
[[nodiscard]] Walked walk(const Mover& mover, const Way& way, double longest);

}  // namespace roam::bench
