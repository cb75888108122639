#pragma once
/// \file
/// Floors seen from above, at one level: distances in the plan, and the largest discs that are free of floor.

#include <functional>
#include <vector>

#include "roam/survey.h"

namespace roam::training {

/// A place of the floor, and how far it is in the plan.
struct NearFloor {
  double distance = 0.0;  ///< m, level; at least the reach that was asked for where there is none
  Vec3 point{0.0};
};

/// Of every floor what lies within `band` (m) above and below a place that is asked about. The distance is not that of
/// a capsule as high, which would also see floor that lies a little lower and not beside it.
class FloorPlan {
 public:
  FloorPlan(const Survey& survey, double band);

  /// The floor nearest to `place`, no farther than `reach`.
  [[nodiscard]] NearFloor nearest(const Vec3& place, double reach) const;
  /// Into `near`: the nearest and, of each triangle that comes no more than `slack` farther, its nearest place. The
  /// nearest of all is first. Exact in the triangles as they were passed.
  void touching(const Vec3& place, double reach, double slack, std::vector<NearFloor>& near) const;

 private:
  NearFloor of(TriangleId floor, const Vec3& place) const;
  void within(const Vec3& place, double reach, std::vector<NearFloor>& near) const;

  const Survey* survey_;
  double band_;
  double error_;  ///< a distance of the stored floors may be off by so much
};

/// A level disc that touches floor at its border and nowhere else.
struct Disc {
  Vec3 centre{0.0};
  double radius = 0.0;
};

/// Whether a disc's centre may be moved straight from one place to another.
using MayMove = std::function<bool(const Vec3& from, const Vec3& to)>;

/// Climbs from `start` to a place where the disc free of floor is largest, to `precision` (m), along the bisector of
/// what it nearly touches: so it follows a ridge between two rims that part slowly. Ends early where it is as large as
/// `enough`.
[[nodiscard]] Disc grow(const FloorPlan& plan, const Vec3& start, double enough, double precision,
                        const MayMove& may_move);

}  // namespace roam::training
