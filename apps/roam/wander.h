#pragma once
/// \file
/// Roaming a scene of which no path is known: `roam walk --wander`.
///
/// A look ahead probes strides in all directions with the body itself and heads where it has been least; on the way
/// it is the Walker that moves, as along any path. Nothing is random: the same scene and settings give the same walk.

#include <cstdint>
#include <functional>
#include <span>
#include <unordered_map>
#include <vector>

#include "roam/route.h"
#include "roam/walker.h"

namespace roam::app {

/// A free place, and how much room there is.
struct Start {
  Vec3 place{0.0};
  double room = -1.0;  ///< less than 0: there is none
};

/// The best place to start from, as wander_start: of `floors` and all floors under a grid of `columns` x `columns`.
[[nodiscard]] Start best_start(const Space& space, const WalkerSettings& settings, Mode mode,
                               std::span<const Vec3> floors, int columns, const std::function<bool()>& goes_on);
/// Throws roam::Error: a body with these settings fits nowhere.
[[noreturn]] void fail_to_start(const WalkerSettings& settings);

/// A free place to start from: of `floors` (see floor_samples) and all floors under a grid of columns over the scene,
/// the one from which the body can stride farthest in eight directions; the more walls are in sight the better. A place
/// within walls and under a ceiling counts fourfold, so that one starts in a tunnel instead of on top of it, unless it
/// is only a closet. Throws roam::Error when the body fits nowhere and in an empty scene. `goes_on` is asked now
/// and then, and ends it by false: roam::Cancelled.
[[nodiscard]] Vec3 wander_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                std::span<const Vec3> floors, const std::function<bool()>& goes_on = {});

/// One walk without an aim. The walker must outlive it and be in walk or fly mode.
class Wander {
 public:
  /// Goes for `seconds` with the speed and time step of `options`.
  Wander(Walker& walker, const RouteOptions& options, double seconds);

  [[nodiscard]] bool done() const { return done_; }
  /// Chooses a new heading when the last one is used up. Moves nothing.
  void look();
  /// One step. Must not be called when done().
  const StepReport& advance();
  /// Its events are the first 10,000, the last of them the last of all. `reached` when the time is over; `held` when
  /// the body cannot move then, or not for 2 s before; `left_scene` as for a route.
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
  RouteOptions options_;
  double seconds_;
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
  EventFilter filter_;
  bool done_ = false;
};

}  // namespace roam::app
