#pragma once
/// \file
/// Places for a body that is put somewhere from outside.

#include <optional>

#include "roam/walker.h"

namespace osgRoam {

/// Puts the body to `centre`, by Walker::place; where that leaves it held, in what is known, to the nearest place found
/// in any direction where it fits, through walls too. Held when there is none.
void place_safely(roam::Walker& walker, const roam::Vec3& centre);

/// The centre of a standing body on the topmost floor that is not too steep, as near to the middle of the space, seen
/// from above, as one is found.
[[nodiscard]] std::optional<roam::Vec3> standing_place(const roam::Space& space, const roam::WalkerSettings& settings);

}  // namespace osgRoam
