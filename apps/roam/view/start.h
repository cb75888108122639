#pragma once
/// \file
/// The start of a session without a given position.

#include <cstdint>
#include <functional>
#include <span>
#include <string>

#include "roam/store.h"
#include "roam/walker.h"
#include "view/pose.h"

namespace roam::app {

struct StartPlace {
  Pose pose;
  Mode mode = Mode::walk;  ///< the desired mode; fly without a floor to walk on; see find_start
  std::string note;        ///< a sentence for the user if the start is not as desired; else empty
};

/// A free pose on a floor, indoors if there is an indoors, in the direction in which most is open; see wander_start.
/// `meshes`: the triangles of the space. If the body fits on no floor: in the air, flying. If there is no place but on
/// a roof, on an object or within a closed hull, or none at all: outside of the scene, flying, all of it in view. A
/// ghost before a scene that a body could not see from near enough, such as one of 8 mm.
/// Throws roam::Cancelled when `goes_on` returns false.
[[nodiscard]] StartPlace find_start(const Space& space, const WalkerSettings& settings, Mode mode,
                                    std::span<const Mesh> meshes, const std::function<bool()>& goes_on);

/// The same in a store, near a few points only; see free_start.
[[nodiscard]] StartPlace find_start(const Store& store, std::uint64_t memory, const WalkerSettings& settings, Mode mode,
                                    const std::function<bool()>& goes_on);

/// A pose from which a camera of this field of view sees all of `box`. `fov`: degrees, of the picture's smaller side.
[[nodiscard]] Pose overview(const Box& box, double fov);

}  // namespace roam::app
