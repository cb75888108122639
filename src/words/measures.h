#pragma once
/// \file
/// Positions and lengths as text for people.

#include <fmt/format.h>

#include <string>

#include "roam/math.h"

namespace roam::words {

/// "(1.00, 2.00, 3.00)".
[[nodiscard]] inline std::string at(const Vec3& place) {
  return fmt::format("({:.2f}, {:.2f}, {:.2f})", place.x, place.y, place.z);
}

/// The same to the millimetre.
[[nodiscard]] inline std::string exactly_at(const Vec3& place) {
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", place.x, place.y, place.z);
}

/// "0.520 m"; in millimetres where metres would show little of it.
[[nodiscard]] inline std::string metres(double length) {
  return length >= 0.01 ? fmt::format("{:.3f} m", length) : fmt::format("{:.1f} mm", 1e3 * length);
}

}  // namespace roam::words
