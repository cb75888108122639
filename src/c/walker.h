#pragma once
/// \file
/// The handle of a walker.

#include "c/space.h"
#include "roam/profile.h"
#include "roam/roam.h"
#include "roam/walker.h"

struct roam_walker {
  roam_space in;  ///< shares the space, which outlives the walker so
  roam::Walker walker;
};

namespace roam::c {

/// Throws Invalid for a number that is no mode.
[[nodiscard]] Mode mode_of(std::int32_t mode);
void apply_to(roam_walker_settings& settings, const Profile& profile);

}  // namespace roam::c
