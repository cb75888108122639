#pragma once
/// \file
/// A route: walking or flying a Walker along waypoints, and how that ended.
///
///     const std::vector<roam::Vec3> path = roam::positions(roam::load_path("tour.path"));
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::walk, path[0]);
///     roam::Route route(walker, path, {.speed = 1.4});
///     while (!route.done()) route.advance();
///     std::cout << roam::to_string(route.result().outcome) << "\n";
///
/// The body heads straight for each waypoint and slides along obstacles; it searches no path. The same input gives the
/// same bits, as with Walker. Lengths are metres, times seconds.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "roam/math.h"
#include "roam/standing.h"
#include "roam/step_report.h"
#include "roam/walker.h"

namespace roam {

struct RouteOptions {
  double speed = 1.4;      ///< m/s, > 0
  double dt = 1.0 / 60.0;  ///< of one step, >= Route::shortest_step; a step that comes to a waypoint ends there
  /// m/s^2, > 0: see WalkerInput. With a limit the body comes to rest at each turn and at the end.
  double acceleration = std::numeric_limits<double>::infinity();
  double braking = std::numeric_limits<double>::infinity();
  /// > 0: the body is blocked after this time, and at least 8 steps, without progress. Progress: it came nearer to its
  /// waypoint by 1/20 of the length of free motion, or slid that far and came a little nearer, as along a wall met 3
  /// degrees from head-on. 64 steps in a row that end within 1e-6 s block it, too.
  double patience = 1.0;
  double wait = 10.0;             ///< >= 0, real time: how long follow() waits for a LiveSpace after its last change
  std::optional<Box> scene = {};  ///< the box for Outcome::left_scene; none: that of the space
};

/// Throws roam::Error as the constructor of Route does.
void check(const RouteOptions& options, std::span<const Vec3> waypoints, const Walker& walker);

enum class Outcome : std::uint8_t {
  reached,     ///< was at every waypoint in turn
  blocked,     ///< no longer came nearer to a waypoint; see RouteOptions::patience
  left_scene,  ///< left the box of the scene: flying, by more than its own size; walking, fell over its side
  fell,        ///< walking: dropped by more than Walker::fall_limit() below its last ground
  held,        ///< cannot move: did not fit where it was put, found no ground below, or waits for unknown space
};
[[nodiscard]] const char* to_string(Outcome outcome);  ///< "reached", "blocked", "left_scene", "fell" or "held"

/// The contact that the body could not pass, from StepReport::contacts.
struct Blockage : Contact {
  std::optional<double> opening;  ///< width of the opening that is too small, see measure_opening(); none: closed wall
};

struct RouteEvent {
  std::uint64_t step = 0;  ///< counted from 1; 0 is the start
  Event event;
};

struct RouteResult : Tally {
  Outcome outcome = Outcome::reached;  ///< meaningless before Route::done()
  std::size_t waypoints = 0;           ///< how many were reached, the start included
  Vec3 end{0.0};                       ///< the centre at the end
  std::optional<Blockage> blocked_at;  ///< if blocked by a contact, or held by unknown space
  /// In order: of each step the first event of each kind, unless the step before had that kind too.
  std::vector<RouteEvent> events;
};

class Route {
 public:
  static constexpr double shortest_step = 1e-6;
  static constexpr double highest_speed = 1e4;      ///< m/s, of a Walker too
  static constexpr double longest_descent = 600.0;  ///< s: a body that first falls for longer has found no ground

  /// Places the walker at waypoints[0], as Walker::place(); in walk mode it first comes down to the ground there.
  /// Waypoints are positions of the *centre*, copied; standing() converts paths of the feet, as from train() or
  /// widest_way(). The walker must outlive the route; do not move it meanwhile. A LiveSpace is not updated: do so
  /// between steps. Throws roam::Error for no waypoint, a waypoint that is not finite or beyond coordinate_limit,
  /// options out of range, and a walker in ghost mode.
  ///
  /// A waypoint counts as reached at a distance of at most the radius from the body's axis. In walk mode that distance
  /// is horizontal, and the waypoint at most the step height above the body's top or below its lowest point, or in
  /// sight at most 2 m above its lowest point. The body still heads for the waypoint itself until something keeps it
  /// from coming nearer: it cuts no corners.
  Route(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options = {});
  ~Route();
  Route(const Route& other);
  Route(Route&& other) noexcept;
  Route& operator=(const Route& other);
  Route& operator=(Route&& other) noexcept;
  [[nodiscard]] bool done() const;
  const StepReport& advance();                      ///< makes one step; throws roam::Error when done()
  [[nodiscard]] const RouteResult& result() const;  ///< so far; complete when done()

 private:
  friend RouteResult follow(Walker& walker, LiveSpace& space, std::span<const Vec3> waypoints,
                            const RouteOptions& options);
  void start_window();

  class State;
  std::unique_ptr<State> state_;  ///< null when it was moved from
};

/// Follows the whole route in a space that does not change. For a LiveSpace use the function below.
[[nodiscard]] RouteResult follow(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options = {});
/// Follows the whole route in `space`, the walker's, which it updates between steps. Waits for unknown space, see
/// RouteOptions::wait, and steps no faster than real time while the space limits the speed. The result depends on when
/// the space loads. Throws roam::Error as Route and LiveSpace::update() do, and for another space than the walker's.
[[nodiscard]] RouteResult follow(Walker& walker, LiveSpace& space, std::span<const Vec3> waypoints,
                                 const RouteOptions& options = {});

}  // namespace roam
