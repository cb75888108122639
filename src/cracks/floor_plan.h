#pragma once
/// \file
/// Floors seen from above, at one level: distances in the plan, and the largest discs that are free of floor.

#include <functional>
#include <vector>

#include "roam/survey.h"

namespace roam::cracks {

/// A place that limits a disc, and its distance in the plan.
struct NearPlace {
  double distance = 0.0;  ///< m, level; at least the queried reach if there is no such place
  Vec3 point{0.0};
};

/// Obstacles for a disc, seen from above.
class PlanObstacles {
 public:
  virtual ~PlanObstacles() = default;
  /// The obstacle nearest to `place`, no farther than `reach`.
  [[nodiscard]] virtual NearPlace nearest(const Vec3& place, double reach) const = 0;
  /// Fills `near` with the nearest place of each triangle at most `slack` farther than the nearest of all, which comes
  /// first. Never empty.
  virtual void touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const = 0;

 protected:
  PlanObstacles() = default;
  PlanObstacles(const PlanObstacles&) = default;
  PlanObstacles& operator=(const PlanObstacles&) = default;
};

/// By distance, then by place.
void sort_near(std::vector<NearPlace>& near);

/// The floor alone: of every triangle, the part within `band` (m) above and below the queried place. The distance
/// differs from that of a capsule as high as the band, which would also see floor a little below its end.
class FloorPlan final : public PlanObstacles {
 public:
  FloorPlan(const Survey& survey, double band);

  [[nodiscard]] NearPlace nearest(const Vec3& place, double reach) const override;
  /// Exact for the triangles as they were passed.
  void touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const override;

 private:
  NearPlace of(TriangleId floor, const Vec3& place) const;
  void within(const Vec3& place, double reach, std::vector<NearPlace>& near) const;

  const Survey* survey_;
  double band_;
  double error_;  ///< m, bound of the error of a distance to stored floors
};

/// Floor and walls: the distance is the radius of the largest body that can stand at a place. A wall counts if it
/// touches a ball whose lowest point is at knee height, like the lower end of a walking body.
class BodyPlan final : public PlanObstacles {
 public:
  BodyPlan(const Survey& survey, const FloorPlan& floor, double knee);
  [[nodiscard]] NearPlace nearest(const Vec3& place, double reach) const override;
  void touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const override;
  /// The wall alone.
  [[nodiscard]] NearPlace nearest_wall(const Vec3& place, double reach) const;

 private:
  const Survey* survey_;
  const FloorPlan* floor_;
  double knee_;
};

/// A level disc that touches obstacles at its border and holds none.
struct Disc {
  Vec3 centre{0.0};
  double radius = 0.0;
};

/// Floor that a disc touches or nearly touches (within 2 % of its radius), and the direction to it: level, of length 1.
struct TouchedFloor {
  NearPlace near;
  Vec3 way{0.0};
};

/// All floor that a disc touches, the nearest first.
[[nodiscard]] std::vector<TouchedFloor> touched_floor(const FloorPlan& plan, const Disc& disc);

/// Whether a disc's centre may move straight from one place to another.
using MayMove = std::function<bool(const Vec3& from, const Vec3& to)>;

/// Climbs from `start` to a place where the free disc is largest, to `precision` (m). Moves along the bisector of the
/// nearly touched obstacles, so it can follow a ridge between two rims that part slowly. Ends early where the disc is
/// exactly as large as `enough`.
[[nodiscard]] Disc grow(const PlanObstacles& plan, const Vec3& start, double enough, double precision,
                        const MayMove& may_move);

}  // namespace roam::cracks
