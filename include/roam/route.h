#pragma once
/// \file
/// Walking or flying along waypoints, and telling how it ended.
///
///     const std::vector<roam::Vec3> path = roam::positions(roam::load_path("tour.path"));  // or other places, of the
///                                                                                          // centre: see standing.h
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::walk, path[0]);
///     roam::Route route(walker, path, {.speed = 1.4});
///     while (!route.done()) route.advance();
///     std::cout << roam::to_string(route.result().outcome) << "\n";
///
/// The body heads straight for one waypoint after the other and slides along what it meets: a route is followed, not
/// searched. Deterministic as the Walker is.

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/standing.h"
#include "roam/tally.h"
#include "roam/walker.h"

namespace roam {

struct RouteOptions {
  double speed = 1.4;  ///< metres per second, > 0
  double dt =
      1.0 / 60.0;  ///< seconds a step, >= Route::shortest_step. A step that comes to a waypoint ends there, earlier.
  /// Metres per second squared, > 0: see WalkerInput. With a limit to either the body comes to rest at the last
  /// waypoint and at each where the way turns.
  double acceleration = std::numeric_limits<double>::infinity();
  double braking = std::numeric_limits<double>::infinity();
  /// Seconds, > 0. The body is blocked when in this time (and at least 8 steps) it neither came nearer to its waypoint
  /// by a twentieth of what free motion at `speed` would have brought, nor slid so far aside and a little nearer: a
  /// wall that is met 3 degrees off head-on, or more, leads on.
  double patience = 1.0;
  /// Seconds of real time, >= 0. Of follow() with a LiveSpace alone: how long it waits for what is not known yet, after
  /// the space has changed last.
  double wait = 10.0;
  /// The box that a body leaves the scene by coming out of (Outcome::left_scene), where it is another than that of all
  /// triangles: a larger one for a route that leads beside or over them.
  std::optional<Box> scene = {};
};

/// Throws what Route throws.
void check(const RouteOptions& options, std::span<const Vec3> waypoints, const Walker& walker);

/// How a route ended. The outcomes are those of `roam walk`.
enum class Outcome : std::uint8_t {
  reached,  ///< was at every waypoint in turn
  blocked,  ///< no longer came nearer to a waypoint; see RouteOptions::patience
  /// Fly mode: came out of the box of the scene (RouteOptions::scene) by its own size, so that nothing of the scene is
  /// near; a route that starts outside may come in first. Walk mode: walked over the side of that box and fell.
  left_scene,
  fell,  ///< walk mode: dropped by more than Walker::fall_limit below where it last stood
  held,  ///< cannot move: did not fit where it was put, found no ground below, or waits for what is not known (space.h)
};

/// "reached", "blocked", "left_scene", "fell" or "held".
[[nodiscard]] const char* to_string(Outcome outcome);

/// What a body was blocked by.
struct Blockage {
  Vec3 point{0.0};   ///< on the triangle, metres
  Vec3 normal{0.0};  ///< from the point towards the body
  TriangleId triangle = no_triangle;
  /// The width, metres, of the free opening in front of the blocked body, when there is one that is too narrow or too
  /// low for it: the distance between the two points that it touches on either side (or above and below), provided that
  /// a ray passes between them. Measured at the height of the contacts, to a few millimetres. None for a closed wall.
  std::optional<double> opening;
};

struct RouteResult : Tally {
  Outcome outcome = Outcome::reached;  ///< means nothing before Route::done()
  std::size_t waypoints = 0;           ///< how many were reached, the start included
  Vec3 end{0.0};                       ///< the centre at the end
  std::optional<Blockage> blocked_at;  ///< when blocked by a contact, or held by what is not known
  /// In order, as an EventFilter picks them.
  std::vector<RouteEvent> events;
};

/// One walk along waypoints, step by step, so that the caller can watch, time or draw each.
class Route {
 public:
  static constexpr double shortest_step = 1e-6;  ///< seconds

  /// Places the walker at waypoints[0], as Walker::place does: a place of the *centre*, half the height above the feet.
  /// A way of the feet, as from train() or widest_way(), is for it only after standing() (standing.h): with the centre
  /// on the floor a body is held, or freed sideways. In walk mode it first comes down to the ground there, on the spot.
  ///
  /// In walk mode a waypoint counts as reached when it is within the body's radius of the axis, seen from above, and at
  /// most the step height above the body's top or below its lowest point. For bodies lower than 2 m, paths being those
  /// of persons, also at most 2 m above the lowest point, where nothing is between. In fly mode it
  /// counts when it is within the radius of the axis. The body still heads for the waypoint itself and only turns to
  /// the next one when it is there, or when it counts as reached and something keeps the body from coming nearer:
  /// corners are not cut.
  ///
  /// The waypoints are copied. The walker must outlive the route and must not be moved by others meanwhile; its space
  /// is never updated here, which for a LiveSpace is the caller's, between two steps. Throws roam::Error for no
  /// waypoint, a waypoint that is not finite or beyond coordinate_limit, options out of range, and a walker in
  /// ghost mode.
  Route(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options = {});

  [[nodiscard]] bool done() const { return done_; }

  /// One step. Throws roam::Error when done().
  const StepReport& advance();

  /// What has been so far; complete when done().
  [[nodiscard]] const RouteResult& result() const { return result_; }
  [[nodiscard]] const Walker& walker() const { return *walker_; }

 private:
  friend RouteResult follow(Walker& walker, LiveSpace& space, std::span<const Vec3> waypoints,
                            const RouteOptions& options);

  [[nodiscard]] bool limited() const;
  [[nodiscard]] double until_rest(const Vec3& way) const;
  [[nodiscard]] Box scene() const { return options_.scene ? *options_.scene : walker_->space().bounds(); }
  void start_window();
  void turn_to_next(bool hindered);
  void judge(const StepReport& report, double distance_before, double free_way);
  [[nodiscard]] bool gets_on() const;
  void describe_blockage(const StepReport& report);
  void finish(Outcome outcome);

  Walker* walker_;
  std::vector<Vec3> waypoints_;
  RouteOptions options_;
  RouteResult result_;
  bool coming_down_ = false;  ///< to the ground, before it goes anywhere
  bool inside_ = false;       ///< has been in the box of the scene
  std::size_t next_ = 1;
  double window_best_ = 0.0;  ///< distance to the waypoint when the window of patience began
  Vec3 window_from_{0.0};     ///< where the body was then
  double window_time_ = 0.0;  ///< seconds since
  double window_free_ = 0.0;  ///< metres that free motion would have brought since
  std::uint64_t window_steps_ = 0;
  EventFilter filter_;
  bool done_ = false;
};

/// Follows the whole route, in a space that stays as it is. In a LiveSpace nothing would come, and the body be held at
/// the end of what is known: pass the space too.
[[nodiscard]] RouteResult follow(Walker& walker, std::span<const Vec3> waypoints, const RouteOptions& options = {});
/// Follows the whole route in a space that comes meanwhile: `space`, which must be the walker's, is updated between
/// the steps, and where the body meets what is not known yet, or where it starts in it, it is waited for: see
/// RouteOptions::wait. Where the space holds the body back the steps are made no faster than in life. So the time that
/// it takes, and with it the result, depends on what brings the space. Throws roam::Error as Route does, as `update`
/// does, and for a space that is not the walker's.
[[nodiscard]] RouteResult follow(Walker& walker, LiveSpace& space, std::span<const Vec3> waypoints,
                                 const RouteOptions& options = {});

}  // namespace roam
