#pragma once
/// \file
/// Positions and lengths as text for people.

#include <fmt/format.h>

#include <cstdint>
#include <string>
#include <string_view>

#include "roam/math.h"
#include "roam/walker_settings.h"
#include "text/number.h"

namespace roam::words {

/// "(1.00, 2.00, 3.00)".
[[nodiscard]] inline std::string at(const Vec3& place) {
  return fmt::format("({}, {}, {})", fixed_text(place.x, 2), fixed_text(place.y, 2), fixed_text(place.z, 2));
}

/// The same to the millimetre.
[[nodiscard]] inline std::string exactly_at(const Vec3& place) {
  return fmt::format("({}, {}, {})", fixed_text(place.x, 3), fixed_text(place.y, 3), fixed_text(place.z, 3));
}

/// "0.520 m"; in millimetres where metres would show little of it.
[[nodiscard]] inline std::string metres(double length) {
  return length >= 0.01 ? fmt::format("{:.3f} m", length) : fmt::format("{:.1f} mm", 1e3 * length);
}

/// Rounded down or up to a millimetre: as text of three decimals it is at most, or at least, the length itself.
[[nodiscard]] double down_to_mm(double length);
[[nodiscard]] double up_to_mm(double length);
/// As metres(), but at most the length itself.
[[nodiscard]] std::string metres_down(double length);

/// "499,936".
[[nodiscard]] std::string grouped(std::uint64_t number);
/// "1 tile", "2,000 tiles".
[[nodiscard]] std::string counted(std::uint64_t count, std::string_view noun);
/// "once", "twice", "3 times".
[[nodiscard]] std::string times(std::uint64_t count);
/// "75 mm to spare on each side".
[[nodiscard]] std::string spare_words(double spare);
/// "0.60 m wide and 1.80 m high", of a sphere "0.60 m wide (a sphere)".
[[nodiscard]] std::string size_of(double radius, double height);
/// "door 3" in quotes and printable; "an object without a name" for none.
[[nodiscard]] std::string quoted(const std::string& object);
/// "between "a" and "b"", "beside "a"" if only one has a name, "of "a"" if both have the same; empty if none has.
[[nodiscard]] std::string between(const std::string& left, const std::string& right);

}  // namespace roam::words
