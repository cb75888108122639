#pragma once
/// \file
/// Facts about the space around a body, kept from one step to the next to save queries.

#include <cstdint>
#include <limits>

#include "roam/math.h"

namespace roam::walking {

/// A free region around a straight way: as long as the space does not change, a body of this size has there a gap of at
/// least `gap` less its distance from the way.
struct FreeWay {
  Vec3 from{0.0}, to{0.0};  ///< of the centre, metres
  double gap = 0.0;         ///< metres; 0: nothing is known
  double radius = 0.0;      ///< of the body, metres
  double height = 0.0;
};

/// The subject of a measured clearance.
enum class Measured : std::uint8_t {
  nothing,  ///< out of date for this body in the space as it is
  place,
  way,  ///< the way to the position, so that it may be far below the clearance there
};

/// Whether the body fits at its position.
enum class Fit : std::uint8_t {
  known,
  unproven,   ///< the space has changed, and it is not known whether the body fits
  came_upon,  ///< the space has changed, and the body does not fit
};

struct Known {
  double clearance = 0.0;  ///< certified at the position when the body came there, metres; 0: not known
  /// Upper bound of the gap at the position, metres. A search farther than this for the nearest triangle is useless.
  double nearest = std::numeric_limits<double>::infinity();
  FreeWay free_way;
  Measured measured = Measured::nothing;  ///< the subject of `clearance`
  Fit fit = Fit::known;
  bool touching = false;  ///< it was in touch when last seen, so a query ahead is likely to meet the same obstacle

  /// Must be called when the body has moved or has another size.
  void forget_place() {
    clearance = 0.0;
    nearest = std::numeric_limits<double>::infinity();
    measured = Measured::nothing;
  }
  /// Must be called when the space has changed.
  void forget() {
    forget_place();
    free_way = {};
  }
};

/// Position and height of a body, and known facts about the space around it.
struct Whereabouts {
  Vec3 place{0.0};      ///< of the centre, metres
  double height = 0.0;  ///< metres
  Known known;
};

}  // namespace roam::walking
