#pragma once
/// \file
/// Waiting for what a pager brings, as long as it brings something.

#include <chrono>
#include <cstdint>
#include <limits>

#include "scenes/open_scene.h"

namespace roam::app {

/// Waits while something comes.
class Arrivals {
 public:
  /// Seconds without anything that came: memory is full, and the rest does not come.
  static constexpr double full_after = 0.1;

  /// The scene must be a store.
  explicit Arrivals(OpenScene& scene);

  /// Seconds since anything came. What is wanted is what a body could reach that moves at `velocity` from `place`.
  double wait(const Body& body, const Vec3& place, const Vec3& velocity);
  /// Whether all is there, but for what cannot be read.
  [[nodiscard]] bool settled() const { return settled_; }

 private:
  using Clock = std::chrono::steady_clock;

  OpenScene& scene_;
  std::uint64_t loads_;
  Clock::time_point last_ = Clock::now();
  bool settled_ = false;
};

/// Waits for what lies around places, as far as memory holds it.
class Surroundings {
 public:
  explicit Surroundings(OpenScene& scene) : scene_(scene) {}

  /// Until all within `reach` (m) is known that can be read; of a store for which memory is too small, until no more
  /// comes, and from then on it waits for less.
  void wait(const Vec3& place, double reach);

 private:
  OpenScene& scene_;
  double fits_ = std::numeric_limits<double>::infinity();  ///< metres, as far as is known
};

}  // namespace roam::app
