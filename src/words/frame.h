#pragma once
/// \file
/// The frame of a scene in plain words.

#include <string>

#include "roam/scene_frame.h"

namespace roam::words {

/// The note that an axis other than z is likely up, with the option that applies it. `scene`: the file names,
/// printable.
[[nodiscard]] std::string likely_up(const std::string& scene, UpAxis axis);
/// The note that a scene may be too large because its ceilings are `metres` high, with the option for its unit.
[[nodiscard]] std::string high_ceilings(const std::string& scene, double metres);

}  // namespace roam::words
