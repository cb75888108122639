#pragma once
/// \file
/// Roaming a scene of which no path is known, and where to start.
///
///     const roam::WalkerSettings person;
///     const auto start = roam::wander_start(world, person, roam::Mode::walk, roam::floor_samples(meshes));
///     if (!start) return;
///     roam::Walker walker(world, person, roam::Mode::walk, start->place);
///     roam::Wander wander(walker, {.seconds = 60.0});
///     while (!wander.done()) wander.advance();
///     std::cout << wander.result().length << " m\n";
///
/// A look ahead probes strides in all directions with the body itself and heads where it has been least. On the way the
/// Walker moves the body, as along a Route. Nothing is random: the same scene and settings give the same walk.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

#include "roam/route.h"
#include "roam/walker.h"

namespace roam {

/// The middles of up to `count` triangles that lie flat enough to stand on and face up, in metres. They are spread
/// evenly over all such triangles, in the order of the meshes. So a gallery in a wide landscape, with most of the
/// triangles, has most of the samples. In meshes of which nothing faces up, those that face down. Thread-safe.
[[nodiscard]] std::vector<Vec3> floor_samples(std::span<const Mesh> meshes, std::size_t count = 512);

/// A free place, and how much room there is.
struct WanderStart {
  Vec3 place{0.0};      ///< of the centre, metres, for Walker::place
  double room = 0.0;    ///< metres that the body can stride from there, weighted by the walls in sight; >= 0
  bool on_top = false;  ///< under the sky, over a hollow or with little room: a roof, a deck, the top of an object
};

/// Where the body can stride farthest in eight directions. The candidates are `floors`, and all floors under a grid of
/// `columns` x `columns` (>= 0) over the space. Walls in sight count; a place within walls and under a ceiling counts
/// fourfold, unless it is only a closet. A place on top counts only where there is no other. So a walk starts in a
/// tunnel or a house, not on top of it. None where the body fits at no candidate.
///
/// `accepts` is called with the centres of candidates, best first; the first that it accepts is returned.
///
/// Takes some microseconds to milliseconds a candidate. `goes_on` is called before each; it ends the search by false.
/// Throws roam::Cancelled then, and roam::Error for settings out of range. Thread-safe as the space's queries are.
[[nodiscard]] std::optional<WanderStart> wander_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                                      std::span<const Vec3> floors = {}, int columns = 32,
                                                      const std::function<bool()>& goes_on = {},
                                                      const std::function<bool(const Vec3&)>& accepts = {});

struct WanderOptions {
  double speed = 1.4;      ///< metres per second, > 0
  double dt = 1.0 / 60.0;  ///< seconds a step, >= Route::shortest_step
  double seconds = 60.0;   ///< simulated, > 0: after these it is done
};

/// One walk without an aim, step by step.
class Wander {
 public:
  /// Begins where the walker is. The walker must outlive it and must not be moved by others meanwhile; its space is
  /// never updated here. Throws roam::Error for options out of range and for a walker in ghost mode.
  Wander(Walker& walker, const WanderOptions& options = {});

  [[nodiscard]] bool done() const { return done_; }

  /// Chooses a new heading when the last one is used up. Moves nothing. advance() does so itself: a caller that times
  /// steps calls it before.
  void look();

  /// One step. Where no heading is left it moves nothing, and is done. Throws roam::Error when done().
  const StepReport& advance();

  /// The result so far; complete when done(). Its events are the first 10,000, the last of them the last of all.
  /// `reached` when the time is over; `held` when the body cannot move then, or not for 2 s before, or when every
  /// heading has failed; `left_scene` as for a route. `waypoints` is 0 and `blocked_at` none.
  [[nodiscard]] const RouteResult& result() const { return result_; }

 private:
  struct Look {
    double way = 0.0;      ///< metres that are free
    double novelty = 0.0;  ///< of the cells along it
  };
  [[nodiscard]] Look probe(const Vec3& direction) const;
  [[nodiscard]] std::uint64_t cell(const Vec3& place) const;
  [[nodiscard]] bool is_barred(const Vec3& direction) const;
  void note(const StepReport& report);

  /// A way that ended in the void.
  struct Leg {
    Vec3 from{0.0};
    Vec3 heading{0.0};
  };

  Walker* walker_;
  WanderOptions options_;
  RouteResult result_;
  std::unordered_map<std::uint64_t, std::uint32_t> visits_;  ///< of each cell
  std::uint64_t last_cell_ = 0;
  Vec3 heading_{0.0};            ///< unit; zero before the first look
  double way_left_ = 0.0;        ///< metres to go along heading_
  double window_seconds_ = 0.0;  ///< since getting on was last judged
  double window_length_ = 0.0;   ///< metres moved since
  bool stuck_ = false;
  Vec3 leg_start_{0.0};
  std::vector<Leg> voids_;
  double held_seconds_ = 0.0;
  bool was_inside_ = false;  ///< has been in the box of the scene
  EventFilter filter_;
  bool done_ = false;
};

}  // namespace roam
