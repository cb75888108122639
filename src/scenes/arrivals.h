#pragma once
/// \file
/// Waits for a pager's loads, as long as any arrive.

#include <chrono>
#include <cstdint>
#include <limits>

#include "scenes/open_scene.h"

namespace roam::app {

/// Waits while anything arrives.
class Arrivals {
 public:
  /// Seconds without an arrival after which memory counts as full: the rest will not arrive.
  static constexpr double full_after = 0.1;

  /// The scene must be a store.
  explicit Arrivals(OpenScene& scene);

  /// Waits for the tiles that a body moving at `velocity` from `place` could reach. Returns the seconds since anything
  /// arrived.
  double wait(const Body& body, const Vec3& place, const Vec3& velocity);
  /// Whether all of them are loaded, except unreadable ones.
  [[nodiscard]] bool settled() const { return settled_; }

 private:
  using Clock = std::chrono::steady_clock;

  OpenScene& scene_;
  std::uint64_t loads_;
  Clock::time_point last_ = Clock::now();
  bool settled_ = false;
};

/// Waits for the surroundings of places, as far as memory allows.
class Surroundings {
 public:
  explicit Surroundings(OpenScene& scene) : scene_(scene) {}

  /// Waits until everything readable within `reach` (m) is loaded. If memory is too small for a store, waits until
  /// nothing more arrives, and from then on for a smaller reach.
  void wait(const Vec3& place, double reach);

 private:
  OpenScene& scene_;
  double fits_ = std::numeric_limits<double>::infinity();  ///< metres, as far as known
};

}  // namespace roam::app
