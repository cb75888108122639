#pragma once
/// \file
/// What a body knows of the space around it from one step to the next, so that it need not ask again.

#include <cstdint>
#include <limits>

#include "roam/math.h"

namespace roam::walking {

/// What is known to be free around a place: a body of this size has a gap of at least `gap`, less what it is away from
/// the centre, as long as the space stays as it is.
struct FreeBall {
  Vec3 centre{0.0};     ///< of the body, metres
  double gap = 0.0;     ///< metres; 0: nothing is known
  double way = 0.0;     ///< metres: `gap` is the least over a way of this length that ends at the centre
  double radius = 0.0;  ///< of the body, metres
  double height = 0.0;
};

/// What a clearance was measured of.
enum class Measured : std::uint8_t {
  nothing,  ///< of this body in the space as it is: it is out of date
  place,
  way,  ///< the way to the place, so that it may be far below that of the place
};

/// Whether the body fits where it is.
enum class Fit : std::uint8_t {
  known,
  unproven,   ///< the space has changed, and it is not known yet
  came_upon,  ///< the space has changed, and it does not
};

struct Known {
  double clearance = 0.0;  ///< certified at the place when the body came there, metres; 0: not known
  /// An upper bound of the gap at the place, metres: to look for the nearest triangle farther off is in vain.
  double nearest = std::numeric_limits<double>::infinity();
  FreeBall ball;
  Measured measured = Measured::nothing;  ///< what `clearance` is that of
  Fit fit = Fit::known;
  bool touching = false;  ///< it was in touch when it was last seen: a look ahead is likely to find that in the way

  /// The body is elsewhere, or another.
  void forget_place() {
    clearance = 0.0;
    nearest = std::numeric_limits<double>::infinity();
    measured = Measured::nothing;
  }
  /// The space has changed.
  void forget() {
    forget_place();
    ball = {};
  }
};

/// Where a body is, how high it is there, and what it knows of the space around.
struct Whereabouts {
  Vec3 place{0.0};      ///< of the centre, metres
  double height = 0.0;  ///< metres
  Known known;
};

}  // namespace roam::walking
