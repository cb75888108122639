#pragma once
/// \file
/// The way of a walk as a picture needs it: few places, and how far along each of them lies.

#include <vector>

#include "draw/geometry.h"
#include "roam/walker.h"

namespace roam::draw {

/// A place of the body, as a step's report told it.
struct Place {
  Vec3 position{0.0};      ///< of the centre, metres
  double height = 0.0;     ///< the body's whole height, metres
  double clearance = 0.0;  ///< certified all along the straight piece that ends here, metres; 0: none
  bool teleport = false;   ///< put here, not moved
};

/// Something that was touched.
struct Touch {
  Vec3 point{0.0};        ///< on the triangle, metres
  Vec3 normal{0.0};       ///< towards the body
  std::size_t place = 0;  ///< index of the place at which it was told
};

/// All that is kept of a walk while it goes on: however long it is, some 8,000 places.
struct Record {
  static constexpr std::size_t most = 8192;  ///< of each

  std::vector<Place> places;
  std::vector<Touch> touches;
  std::size_t thinned = 0;  ///< the first places, between which some were left out
  /// Metres. What was left out lies no farther than twice this from the straight lines between the places that stay; 0:
  /// all are there.
  double tolerance = 0.0;
  double spacing = 1e-2;  ///< metres; touches in a row that are nearer to each other than this are one
};

/// Takes down a step. The start, step 0, is one place: where the body was put.
void append(Record& record, const StepReport& report, bool is_start);

/// A corner of the simplified way.
struct WayPoint {
  Vec3 position{0.0};   ///< of the centre, metres
  double height = 0.0;  ///< of the body, metres
  double along = 0.0;   ///< metres from the start, seen from above; what was not moved does not count
  bool jump = false;    ///< put here: no way leads from the point before
};

struct Way {
  std::vector<WayPoint> points;
  double length = 0.0;     ///< `along` of the last point
  double tolerance = 0.0;  ///< metres: no place of the body lies farther from the way
  /// For each place of the record, its distance along the way.
  std::vector<double> along;
  /// Index of the place to which the piece with the least certified clearance leads; places.size(): none is certified.
  std::size_t nearest = 0;
};

/// Leaves out places that lie within `tolerance` (m, > 0) of the straight line between those that stay. A record of at
/// least one place.
[[nodiscard]] Way simplified(const Record& record, double tolerance);

}  // namespace roam::draw
