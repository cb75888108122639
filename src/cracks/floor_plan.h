#pragma once
/// \file
/// Floors seen from above, at one level: distances in the plan, and the largest discs that are free of floor.

#include <functional>
#include <vector>

#include "roam/survey.h"

namespace roam::cracks {

/// A place of what keeps a disc small, and how far it is in the plan.
struct NearPlace {
  double distance = 0.0;  ///< m, level; at least the reach that was asked for where there is none
  Vec3 point{0.0};
};

/// What a disc must not reach, seen from above.
class Plan {
 public:
  virtual ~Plan() = default;
  /// What is nearest to `place`, no farther than `reach`.
  [[nodiscard]] virtual NearPlace nearest(const Vec3& place, double reach) const = 0;
  /// Into `near`: the nearest and, of each triangle that comes no more than `slack` farther, its nearest place. The
  /// nearest of all is first. Never empty.
  virtual void touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const = 0;

 protected:
  Plan() = default;
  Plan(const Plan&) = default;
  Plan& operator=(const Plan&) = default;
};

/// By distance, then by place.
void sort_near(std::vector<NearPlace>& near);

/// The floor alone: of every triangle what lies within `band` (m) above and below a place that is asked about. The
/// distance is not that of a capsule as high, which would also see floor that lies a little lower and not beside it.
class FloorPlan final : public Plan {
 public:
  FloorPlan(const Survey& survey, double band);

  [[nodiscard]] NearPlace nearest(const Vec3& place, double reach) const override;
  /// Exact in the triangles as they were passed.
  void touching(const Vec3& place, double reach, double slack, std::vector<NearPlace>& near) const override;

 private:
  NearPlace of(TriangleId floor, const Vec3& place) const;
  void within(const Vec3& place, double reach, std::vector<NearPlace>& near) const;

  const Survey* survey_;
  double band_;
  double error_;  ///< a distance of the stored floors may be off by so much
};

/// Floor and walls: as far as a body may be large that stands at a place. Of walls counts what a ball meets whose
/// lowest point is at knee height, as the lower end of a body on foot does.
class BodyPlan final : public Plan {
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

/// A level disc that touches something at its border and holds nothing.
struct Disc {
  Vec3 centre{0.0};
  double radius = 0.0;
};

/// Floor that a disc touches, or nearly (2 % of its radius), and the way to it: level, of length 1.
struct TouchedFloor {
  NearPlace near;
  Vec3 way{0.0};
};

/// All floor that a disc touches, the nearest first.
[[nodiscard]] std::vector<TouchedFloor> touched_floor(const FloorPlan& plan, const Disc& disc);

/// Whether a disc's centre may be moved straight from one place to another.
using MayMove = std::function<bool(const Vec3& from, const Vec3& to)>;

/// Climbs from `start` to a place where the free disc is largest, to `precision` (m), along the bisector of
/// what it nearly touches: so it follows a ridge between two rims that part slowly. Ends early where it is just as
/// large as `enough`.
[[nodiscard]] Disc grow(const Plan& plan, const Vec3& start, double enough, double precision, const MayMove& may_move);

}  // namespace roam::cracks
