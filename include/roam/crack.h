#pragma once
/// \file
/// Crack: a hole or slit in a floor that bodies can fall into. train.h finds the cracks of a scene.

#include <cstdint>

#include "roam/math.h"

namespace roam {

/// A hole or slit in the floor that a small enough body falls into; docs/cracks.md defines it. Metres.
struct Crack {
  enum class Kind : std::uint8_t {
    crack,      ///< a large enough body or support disc spans it
    step_down,  ///< its bottom is floor for walking
    open_drop,  ///< larger than any support disc: a pit, a shaft, a cliff; limits no radius
  };
  Kind kind = Kind::crack;
  Vec3 point{0.0};         ///< centre of the largest level disc free of floor, at the height of the rim
  double radius = 0.0;     ///< of that disc: half the width of a split
  Vec3 direction{0.0};     ///< unit, level, across it
  bool on_a_path = false;  ///< a path crosses it
};

/// "crack", "step_down" or "open_drop".
[[nodiscard]] const char* to_string(Crack::Kind kind);

}  // namespace roam
