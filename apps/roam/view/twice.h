#pragma once
/// \file
/// Confirmation by a second order.

#include <limits>

namespace roam::app {

/// An action that takes two orders: after the first the program asks, the second within some seconds confirms.
class Twice {
 public:
  explicit Twice(double seconds) : seconds_(seconds) {}

  /// Whether this order, given at `now` (s), confirms an earlier one. The next order is a first one again.
  [[nodiscard]] bool confirms(double now) {
    const bool second = now <= until_;
    until_ = second ? none : now + seconds_;
    return second;
  }

 private:
  static constexpr double none = -std::numeric_limits<double>::infinity();
  double seconds_;
  double until_ = none;
};

}  // namespace roam::app
