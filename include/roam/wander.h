#pragma once
/// \file
/// Wandering: roaming a scene without a known path, and a place to start.
///
///     const roam::WalkerSettings person;
///     const auto start = roam::wander_start(world, person, roam::Mode::walk, roam::floor_samples(meshes));
///     if (!start) return;
///     roam::Walker walker(world, person, roam::Mode::walk, start->place);
///     roam::Wander wander(walker, {.seconds = 60.0});
///     while (!wander.done()) wander.advance();
///     std::cout << wander.result().length << " m\n";
///
/// From time to time a Wander probes strides in all directions with the body itself, and heads for places where the
/// body has been least. On the way the Walker moves the body, as along a Route. Nothing is random: the same scene and
/// settings give the same walk.

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "roam/route.h"
#include "roam/walker.h"

namespace roam {

/// The middles of up to `count` triangles that lie flat enough to stand on and face up, in metres. They are spread
/// evenly over all such triangles, in the order of the meshes. So a gallery in a wide landscape, with most of the
/// triangles, has most of the samples. If no triangle faces up, those that face down count. Thread-safe.
[[nodiscard]] std::vector<Vec3> floor_samples(std::span<const Mesh> meshes, std::size_t count = 512);

/// A free place, and how much room there is.
struct WanderStart {
  Vec3 place{0.0};      ///< of the centre, metres, for Walker::place
  double room = 0.0;    ///< metres that the body can stride from there, weighted by walls and view; >= 0
  bool on_top = false;  ///< under the sky, over a hollow or with little room: a roof, a deck, the top of an object
};

/// The candidate from which the body can stride farthest, in eight directions. Candidates are `floors`, and all floors
/// under a grid of `columns` x `columns` (>= 0) over the space. Walls in sight count; a place within walls and under a
/// ceiling counts up to fivefold for a long view. A place on top counts only if there is no other. So a walk starts in
/// a tunnel or a house, not on top of it. None if the body fits at no candidate.
///
/// `accepts` is called with the centres of candidates, best first; the first that it accepts is returned.
///
/// Takes some microseconds to milliseconds a candidate. `goes_on` is called before each; if it returns false,
/// roam::Cancelled is thrown. Throws roam::Error for settings out of range. Thread-safe as the space's queries are.
[[nodiscard]] std::optional<WanderStart> wander_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                                      std::span<const Vec3> floors = {}, int columns = 32,
                                                      const std::function<bool()>& goes_on = {},
                                                      const std::function<bool(const Vec3&)>& accepts = {});

struct OpenDirection {
  double yaw = 0.0;     ///< degrees
  double length = 0.0;  ///< metres that are open there, on average over a sixth of the horizon, most of all its middle
};

/// The level direction from `eye` in which most is open, up to `reach` metres and within the bounds of the space. Views
/// through slits count for nothing. Thread-safe as the space's queries are.
[[nodiscard]] OpenDirection open_direction(const Space& space, const Vec3& eye, double reach);

struct WanderOptions {
  double speed = 1.4;      ///< metres per second, > 0
  double dt = 1.0 / 60.0;  ///< seconds a step, >= Route::shortest_step
  double seconds = 60.0;   ///< simulated, > 0: after these it is done
};

/// One walk without a goal, step by step.
class Wander {
 public:
  /// Metres in which it looks around: the next few corners of a corridor.
  static constexpr double look_around = 12.0;

  /// Begins at the walker's position. The walker must outlive it and must not be moved by others meanwhile; its space
  /// is never updated here. Throws roam::Error for options out of range and for a walker in ghost mode.
  Wander(Walker& walker, const WanderOptions& options = {});

  ~Wander();
  Wander(const Wander& other);
  Wander(Wander&& other) noexcept;
  Wander& operator=(const Wander& other);
  Wander& operator=(Wander&& other) noexcept;

  [[nodiscard]] bool done() const;

  /// Chooses a new heading if the last one is used up. Moves nothing. advance() calls it; a caller that times steps
  /// calls it before.
  void look();

  /// One step. If no heading is left, it moves nothing and is done. Throws roam::Error when done().
  const StepReport& advance();

  /// The result so far; complete when done(). It has at most 10,000 events: the first ones, and the last of all.
  /// `reached` when the time is over; `held` if the body cannot move then, or could not for 2 s, or if every heading
  /// has failed, or 64 steps in a row ended within 1e-6 s. `left_scene` if the whole body is outside the bounds of the
  /// space: on foot, below or beside them; flying, by its height + 2.5 m, after it was nearer. No `waypoints`,
  /// `blocked_at`.
  [[nodiscard]] const RouteResult& result() const;

 private:
  class State;
  std::unique_ptr<State> state_;  ///< null when it was moved from
};

}  // namespace roam
