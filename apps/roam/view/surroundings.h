#pragma once
/// \file
/// The surroundings of a body: the floor below, and the object in the middle of the picture.

#include <optional>
#include <span>
#include <string>

#include "osgRoam/Manipulator.h"
#include "roam/space.h"
#include "view/pick.h"

namespace roam::app {

/// Metres, in the scene's frame.
struct Surroundings {
  Vec3 feet{0.0};                     ///< the body's lowest point
  std::optional<double> above_floor;  ///< height of the feet; none if no floor is known below
  std::optional<double> ahead_m;      ///< from the eye to the surface in the middle of the picture; none: there is none
  std::string ahead;                  ///< name of that surface's object; may be empty
};

/// The floor is that of the body's own space. The surface ahead is the first along `ahead` of `visible`, outside of the
/// half spaces. Needs a walker; the spaces must not change meanwhile.
[[nodiscard]] Surroundings surroundings(const osgRoam::Manipulator& roamer, const Space& visible,
                                        const std::optional<Sightline>& ahead, std::span<const HalfSpace> hidden = {});

/// The unit vector of a gaze. Radians, as in osgRoam::Manipulator.
[[nodiscard]] Vec3 gaze(double yaw, double pitch);

}  // namespace roam::app
