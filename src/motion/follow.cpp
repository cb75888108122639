// Following a route through a space that comes while the body goes. The only part of motion that looks at a clock: what
// the body does between two changes of the space does not depend on it.

#include <algorithm>
#include <chrono>
#include <thread>

#include "math/floating_point.h"
#include "roam/route.h"

namespace roam {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::microseconds between_updates{500};

/// A limit below this part of the route's speed is no way to go on: less than that counts as not getting on.
constexpr double crawling = 0.1;

/// Lets a live space bring what a body waits for.
class Attendant {
 public:
  Attendant(const Walker& walker, LiveSpace& space, const RouteOptions& options)
      : walker_(walker), space_(space), options_(options) {}

  /// Until what is at `place` is known.
  void wait_at(const Vec3& place) {
    const Body body = walker_.settings().body();
    wait_for([&] { return space_.update(body, place, Vec3(0.0)); },
             [&] { return space_.clearance(body, place, 0.0).unknown; });
  }

  /// After the step that the walker has made: whether the space is another one now than when the body had to wait.
  bool attend() {
    const auto update = [&] { return space_.update(walker_.body(), walker_.position(), walker_.velocity()); };
    bool changed = update();
    if (changed) vain_ = false;
    const auto stopped = [&] { return space_.facts().speed_limit < crawling * options_.speed; };
    if (walker_.report().met_unknown || stopped()) {
      // What came just now may be what it met: a step will tell.
      if (!changed) changed = wait_for(update, [&] { return stopped() || !changed_; });
      return changed;
    }
    // No faster than in life where that is what makes it slow.
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

  /// Updates as long as `waits` says, and not longer than RouteOptions::wait after the last change. Who has waited in
  /// vain does not again before something has changed.
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
