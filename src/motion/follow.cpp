// Following a route through a space that is loaded while the body moves. Only this part of motion reads a clock:
// between two changes of the space, the body's motion does not depend on it.

#include <chrono>
#include <thread>

#include "math/floating_point.h"
#include "roam/route.h"

namespace roam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds between_updates{500};

/// Part of the route's speed. A lower speed limit of the space counts as no progress.
constexpr double crawling = 0.1;

/// Waits until a live space has loaded what a body needs.
class Attendant {
 public:
  Attendant(const Walker& walker, LiveSpace& space, const RouteOptions& options)
      : walker_(walker), space_(space), options_(options) {}

  /// Waits until the space at `place` is known.
  void wait_at(const Vec3& place) {
    const Body body = walker_.settings().body();
    wait_for([&] { return space_.update(body, place, Vec3(0.0)); },
             [&] { return space_.clearance(body, place, 0.0).unknown; });
  }

  /// Called after a step of the walker. Returns whether the space has changed since the body had to wait.
  bool attend() {
    const auto update = [&] { return space_.update(walker_.body(), walker_.position(), walker_.velocity()); };
    bool changed = update();
    if (changed) vain_ = false;
    const auto stopped = [&] { return space_.facts().speed_limit < crawling * options_.speed; };
    if (walker_.report().met_unknown || stopped()) {
      // The change that just came may be the part that was met: a step shows that.
      if (!changed) changed = wait_for(update, [&] { return stopped() || !changed_; });
      return changed;
    }
    // If the space limits the speed, goes on no faster than in real time.
    const auto begin = Clock::now();
    while (space_.facts().speed_limit < options_.speed && seconds_since(begin) < options_.dt) {
      std::this_thread::sleep_for(between_updates);
      update();
    }
    return false;
  }

 private:
  static double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  }

  /// Updates while `waits` returns true, for at most RouteOptions::wait after the last change. After a wait in vain it
  /// does not wait again until something has changed.
  template <class Update, class Waits>
  bool wait_for(const Update& update, const Waits& waits) {
    bool changed = changed_ = update();
    if (changed) vain_ = false;
    auto begin = Clock::now();
    while (!vain_ && waits()) {
      if (seconds_since(begin) >= options_.wait) {
        vain_ = true;
        break;
      }
      std::this_thread::sleep_for(between_updates);
      if (!update()) continue;
      changed = changed_ = true;
      begin = Clock::now();
    }
    return changed;
  }

  const Walker& walker_;
  LiveSpace& space_;
  const RouteOptions& options_;
  bool changed_ = false;
  bool vain_ = false;
};

}  // namespace

RouteResult follow(Walker& walker, LiveSpace& space, std::span<const Vec3> waypoints, const RouteOptions& options) {
  const DefaultFloatingPoint guard;
  if (&walker.space() != &space) {
    throw Error("the walker moves in another space than the one that is to be updated; pass the walker's own");
  }
  check(options, waypoints, walker);
  Attendant attendant(walker, space, options);
  attendant.wait_at(waypoints[0]);
  Route route(walker, waypoints, options);
  while (!route.done()) {
    if (attendant.attend()) route.start_window();
    route.advance();
  }
  return route.result();
}

}  // namespace roam
