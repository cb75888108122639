#pragma once
/// \file
/// Positions for a body that is placed from outside.

#include <optional>

#include "roam/walker.h"

namespace osgRoam {

/// Places the body at `centre`, by Walker::place. If it is held there in known space, searches all directions, through
/// walls too, for a near position where it fits. If there is none, leaves it held at `centre`.
void place_safely(roam::Walker& walker, const roam::Vec3& centre);

/// The centre of a standing body on the topmost floor that is not too steep, at a sampled position as near as possible
/// to the middle of the space in plan. Empty if there is none.
[[nodiscard]] std::optional<roam::Vec3> standing_place(const roam::Space& space, const roam::WalkerSettings& settings);

/// The same on a floor below `eye`, else where it looks along the unit vector `gaze`, else that of standing_place().
[[nodiscard]] std::optional<roam::Vec3> landing_place(const roam::Space& space, const roam::WalkerSettings& settings,
                                                      const roam::Vec3& eye, const roam::Vec3& gaze);

/// Whether a body with its centre there falls at most its own height, and at least 2 m.
[[nodiscard]] bool has_floor(const roam::Space& space, const roam::WalkerSettings& settings, const roam::Vec3& centre);

}  // namespace osgRoam
