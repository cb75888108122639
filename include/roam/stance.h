#pragma once
/// \file
/// What a Walker remembers from one step to the next: whether and where it stands, and what it need not ask again.

#include <cstdint>
#include <limits>

#include "roam/math.h"

namespace roam {

namespace walking {

/// What a body measures, metres.
struct Size {
  double radius = 0.0;
  double support_radius = 0.0;

  friend bool operator==(const Size&, const Size&) = default;
};

/// What is known to be free around a place: a body of this size has a gap of at least `gap`, less what it is away from
/// the centre, as long as the space stays as it is.
struct FreeBall {
  Vec3 centre{0.0};     ///< of the body, metres
  double gap = 0.0;     ///< metres; 0: nothing is known
  double way = 0.0;     ///< metres: `gap` is the least over a way of this length that ends at the centre
  double radius = 0.0;  ///< of the body, metres
  double height = 0.0;
};

/// What is known of the space around a body.
struct Known {
  double clearance = 0.0;  ///< certified at the place when the body came there, metres; 0: not known
  /// An upper bound of the gap at the place, metres: to look for the nearest triangle farther off is in vain.
  double nearest = std::numeric_limits<double>::infinity();
  FreeBall ball;
  bool fresh = false;      ///< `clearance` was measured of this body, in the space as it is
  bool over_way = false;   ///< over the way that it came, so that it may be far below that of the place
  bool touching = false;   ///< it was in touch when it was last seen: a look ahead is likely to find that in the way
  bool unproven = false;   ///< the space has changed, and whether the body still fits is not known yet
  bool came_upon = false;  ///< it does not

  /// The body is elsewhere, or another.
  void forget_place() {
    clearance = 0.0;
    nearest = std::numeric_limits<double>::infinity();
    fresh = over_way = false;
  }
  /// The space has changed.
  void forget() {
    forget_place();
    ball = {};
  }
};

/// What was found out about a foot: asked again only when something of it has changed.
struct FootAnswer {
  Vec3 place{0.0};  ///< of the body's centre, metres
  double height = 0.0;
  Size size;
  Vec3 floor_point{0.0};  ///< the plane over which it was asked
  Vec3 floor_normal{0.0, 0.0, 1.0};
  std::uint64_t revision = 0;  ///< of the space
  bool known = false;          ///< it was asked, in a space that tells its changes
  bool carries = false;
  bool unknown = false;  ///< by what is not known yet

  /// Whether the question is the same.
  [[nodiscard]] bool same_question(const FootAnswer& other) const {
    return place == other.place && height == other.height && size == other.size && floor_point == other.floor_point &&
           floor_normal == other.floor_normal && revision == other.revision;
  }
};

}  // namespace walking

/// What walking remembers from one step to the next.
struct Stance {
  Vec3 ground{0.0, 0.0, 1.0};  ///< normal of the ground stood on
  double level = 0.0;          ///< z of the point last stood on, metres; means nothing before `stood`
  double rise_speed = 0.0;     ///< upward, m/s; 0 on the ground
  bool grounded = false;
  bool firm = false;     ///< grounded within the slope limit: not on a rim, not wedged between slopes
  bool carried = false;  ///< grounded by its foot alone, over a crack
  bool unknown = false;  ///< grounded on what is not known yet
  bool stood = false;    ///< has stood on ground since it was placed
  bool fallen = false;   ///< the present fall has been reported
  /// With a foot of its own: the plane of the floor last seen under the axis. Means nothing before `floor_seen`.
  Vec3 floor_point{0.0};
  Vec3 floor_normal{0.0, 0.0, 1.0};
  bool floor_seen = false;
  walking::FootAnswer foot;  ///< where it was asked last
};

}  // namespace roam
