#pragma once
/// \file
/// State of walking kept from one step to the next.

#include <cstdint>

#include "motion/free_disc.h"
#include "roam/stance.h"

namespace roam::walking {

/// The sizes of a body, metres.
struct Size {
  double radius = 0.0;
  double support_radius = 0.0;

  friend bool operator==(const Size&, const Size&) = default;
};

/// The last result for a support disc. It is computed again only when one of its inputs has changed.
struct DiscResult {
  Vec3 place{0.0};  ///< centre of the body, metres
  double height = 0.0;
  Size size;
  FloorPlane floor;            ///< the floor plane used
  std::uint64_t revision = 0;  ///< revision of the space
  bool lasts = false;          ///< there is a result, and the space reports its changes
  Carrying carrying = Carrying::no;

  /// Whether the inputs are the same.
  [[nodiscard]] bool same_input(const DiscResult& other) const {
    return place == other.place && height == other.height && size == other.size && floor == other.floor &&
           revision == other.revision;
  }
};

struct Gait : Stance {
  double rise_speed = 0.0;  ///< m/s upward, relative to `ground_velocity`; 0 on the ground
  /// For a body with a support disc: the plane of the floor last seen under the axis. Undefined until `floor_seen`.
  FloorPlane floor;
  bool floor_seen = false;
  ObjectId floor_object = no_object;  ///< the object of `floor`
  DiscResult disc_result;             ///< the last result for the support disc
  DiscFound disc;                     ///< where the support disc last found room to fall

  bool moved_along = false;  ///< move_instances() has already moved it with the ground for the next step

  /// Leaves the ground, so that nothing carries the body. It keeps the velocity of the ground.
  void leave_ground() {
    footing = Footing::air;
    unknown = false;
  }
};

}  // namespace roam::walking
