#pragma once
/// \file
/// Frame of a scene: which axis of its files points up, and the length of their unit. Plain values.
///
/// Positions in a scene are in metres with +z up. SceneFrame::to_file() leads back to those of the file.

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace roam {

/// The axis of a file that points up. Reading rotates it to +z: (x, y, z) becomes
/// x: (-z, y, x);  y: (x, -z, y);  z: (x, y, z);  minus_x: (z, y, -x);  minus_y: (x, z, -y);  minus_z: (x, -y, -z).
enum class UpAxis : std::uint8_t { x, y, z, minus_x, minus_y, minus_z };
inline constexpr std::array<const char*, 6> up_axis_names{"x", "y", "z", "-x", "-y", "-z"};

/// The length of 1 in a file: metre, centimetre, millimetre, international foot (0.3048 m), inch (0.0254 m).
enum class LengthUnit : std::uint8_t { m, cm, mm, ft, in };
inline constexpr std::array<const char*, 5> length_unit_names{"m", "cm", "mm", "ft", "in"};

/// "x", "y", "z", "-x", "-y" or "-z".
[[nodiscard]] inline const char* to_string(UpAxis up) { return up_axis_names[static_cast<std::size_t>(up)]; }
/// "m", "cm", "mm", "ft" or "in".
[[nodiscard]] inline const char* to_string(LengthUnit unit) {
  return length_unit_names[static_cast<std::size_t>(unit)];
}

/// The reverse of to_string. Both throw roam::Error for other texts.
[[nodiscard]] UpAxis parse_up_axis(std::string_view text);
[[nodiscard]] LengthUnit parse_length_unit(std::string_view text);

/// Metres per unit, exact.
[[nodiscard]] constexpr double metres_per(LengthUnit unit) {
  constexpr std::array<double, 5> metres{1.0, 0.01, 0.001, 0.3048, 0.0254};
  return metres[static_cast<std::size_t>(unit)];
}

struct SceneFrame {
  UpAxis up = UpAxis::z;
  LengthUnit unit = LengthUnit::m;

  friend bool operator==(const SceneFrame&, const SceneFrame&) = default;

  /// Rows of the matrix that turns a position in the scene, as a column (x, y, z, 1), into that of the file.
  [[nodiscard]] std::array<std::array<double, 4>, 4> to_file() const;
};

}  // namespace roam
