#pragma once
/// \file
/// The ways of the paper's experiments, how a body goes along one, and how that is judged.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "reference.h"

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
  /// The radius now, for those who change it on ways that are adapting. Empty for those who cannot.
  std::function<double()> radius{};
};

/// How a body went.
struct Walked {
  std::vector<double> nanoseconds;  ///< of each step, of the thread's own time
  std::vector<Vec3> places;         ///< the centre at the start and after each step
  double radius = 0.0;              ///< metres, the least that the body had
  bool cut = false;                 ///< ended by the clock while it was still getting on
};

/// Goes until the end is reached, nothing moves any more, the body has fallen, or `longest` seconds have passed.
[[nodiscard]] Walked walk(const Mover& mover, const Way& way, double longest);

/// `cut`: patience ran out first, and nothing is known of the rest of the way.
enum class Ending : std::uint8_t { reached, stuck, fell, through, cut };

/// How a way ended, judged by geometry that no mover has a part in.
struct Judgement {
  Ending ending = Ending::stuck;
  std::size_t in_walls = 0;  ///< steps that began or ended deeper in a wall than depth_allowed
  double deepest = 0.0;      ///< metres
};
/// `near` holds all triangles within `paper_reach` of the way. A body whose centre crosses a triangle went through.
[[nodiscard]] Judgement judge(const Way& way, const Walked& walked, const Reference& near);
constexpr double paper_reach = 20.0;  ///< metres

/// "completed", "stuck", "fell", "through a wall" or "not finished".
[[nodiscard]] const char* name(Ending ending);

}  // namespace roam::bench
