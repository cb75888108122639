#pragma once
/// \file
/// The way of a walk for a picture: few places, with their distances along the way.

#include <vector>

#include "draw/geometry.h"
#include "roam/walker.h"

namespace roam::draw {

/// A place of the body, from a step's report.
struct Place {
  Vec3 position{0.0};      ///< of the centre, metres
  double height = 0.0;     ///< the body's whole height, metres
  double clearance = 0.0;  ///< certified along the straight piece that ends here, metres; 0: none
  bool teleport = false;   ///< put here, not moved
};

/// A touched point.
struct Touch {
  Vec3 point{0.0};        ///< on the triangle, metres
  Vec3 normal{0.0};       ///< towards the body
  std::size_t place = 0;  ///< index of the place where it was reported
};

/// The record of a walk in progress: at most some 8,000 places for any length. Of more than some 2,000 runs between
/// teleports some are left out.
struct Record {
  static constexpr std::size_t most = 8192;  ///< places, and touches

  std::vector<Place> places;
  std::vector<Touch> touches;
  std::size_t thinned = 0;  ///< the number of first places that were thinned
  /// Metres. Places removed from runs that stay lie within twice this of the straight lines between the kept ones. 0:
  /// none was removed.
  double tolerance = 0.0;
  std::size_t runs_left_out = 0;
  double spacing = 1e-2;  ///< metres; consecutive touches nearer to each other than this count once
};

/// Records a step. The start, step 0, is one place: the body's position.
void append(Record& record, const StepReport& report, bool is_start);

/// A corner of the simplified way.
struct WayPoint {
  Vec3 position{0.0};   ///< of the centre, metres
  double height = 0.0;  ///< of the body, metres
  double along = 0.0;   ///< metres from the start, seen from above; teleports do not count
  bool jump = false;    ///< teleport: no way leads from the point before
};

struct Way {
  std::vector<WayPoint> points;
  double length = 0.0;     ///< `along` of the last point
  double tolerance = 0.0;  ///< metres: no place of the recorded runs lies farther from the way
  /// For each place of the record, its distance along the way.
  std::vector<double> along;
  /// Index of the place that ends the piece with the least certified clearance; places.size() if none is certified.
  std::size_t nearest = 0;
};

/// Removes places within `tolerance` (m, > 0) of the straight line between the kept ones. The record must have at least
/// one place.
[[nodiscard]] Way simplified(const Record& record, double tolerance);

/// The place on the way that is nearest to `place`.
[[nodiscard]] WayPoint nearest_on(const Way& way, const Vec3& place);

}  // namespace roam::draw
