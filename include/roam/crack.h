#pragma once
/// \file
/// Gaps of a floor into which bodies fall. train.h finds those of a scene.

#include <cstdint>

#include "roam/math.h"

namespace roam {

/// A gap of the floor into which a small enough body falls. See docs/cracks.md for what is one.
struct Crack {
  enum class Kind : std::uint8_t {
    crack,      ///< carried over by a large enough body or foot
    step_down,  ///< its bottom is floor that one walks on
    open_drop,  ///< larger than any foot: a pit, a shaft, a cliff. Sets no radius.
  };
  Kind kind = Kind::crack;
  Vec3 point{0.0};         ///< centre of the largest disc free of floor, at the level of the rim
  double radius = 0.0;     ///< of that disc, m: a split of width w has w / 2
  Vec3 direction{0.0};     ///< level unit vector across it
  bool on_a_path = false;  ///< one of the paths goes over it
};

/// "crack", "step_down" or "open_drop".
[[nodiscard]] const char* to_string(Crack::Kind kind);

}  // namespace roam
