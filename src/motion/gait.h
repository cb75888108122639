#pragma once
/// \file
/// What walking remembers from one step to the next.

#include <cstdint>

#include "motion/free_disc.h"
#include "roam/stance.h"

namespace roam::walking {

/// What a body measures, metres.
struct Size {
  double radius = 0.0;
  double support_radius = 0.0;

  friend bool operator==(const Size&, const Size&) = default;
};

/// What was found out about a foot: asked again only when something of it has changed.
struct FootAnswer {
  Vec3 place{0.0};  ///< of the body's centre, metres
  double height = 0.0;
  Size size;
  FloorPlane floor;            ///< the plane over which it was asked
  std::uint64_t revision = 0;  ///< of the space
  bool lasts = false;          ///< it was asked, in a space that tells its changes
  Carrying carrying = Carrying::no;

  /// Whether the question is the same.
  [[nodiscard]] bool same_question(const FootAnswer& other) const {
    return place == other.place && height == other.height && size == other.size && floor == other.floor &&
           revision == other.revision;
  }
};

struct Gait : Stance {
  double rise_speed = 0.0;  ///< upward, relative to `ground_velocity`, m/s; 0 on the ground
  /// With a foot of its own: the plane of the floor last seen under the axis. Means nothing before `floor_seen`.
  FloorPlane floor;
  bool floor_seen = false;
  ObjectId floor_object = no_object;  ///< that of `floor`
  FootAnswer foot;                    ///< where it was asked last
  DiscFound disc;                     ///< where the foot last found room to fall

  bool moved_along = false;  ///< move_instances() has moved it by that of the ground for the next step

  /// Nothing carries it from now on. It keeps the velocity of the ground.
  void leave_ground() {
    footing = Footing::air;
    unknown = false;
  }
};

}  // namespace roam::walking
