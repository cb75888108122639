#pragma once
/// \file
/// Where a floor ends at a void: a place just outside its rim where a small sphere sinks farther than one steps.

#include <atomic>
#include <optional>
#include <vector>

#include "cracks/cracks.h"
#include "cracks/floor_plan.h"

namespace roam::cracks {

/// Nothing between two places at knee height, the one of `from`, for a search for gaps of `smallest`. A sphere is
/// swept, as small as goes between a rail and a wall and larger than the gaps of badly made walls: a ray would slip
/// through those.
[[nodiscard]] bool sees_at_knee(const World& world, const Vec3& from, const Vec3& to, double knee, double smallest);

/// What is asked of air, floor and wall at the level of a rim, which is the z of each place.
class VoidProbe {
 public:
  VoidProbe(const Survey& survey, const CrackOptions& options);

  /// Of the sphere that sinks, a tenth less than CrackOptions::smallest: so that a gap of just that is met from every
  /// place of its rim, whatever roundings say.
  [[nodiscard]] double radius() const { return radius_; }
  /// Just outside a rim: where that sphere passes it by.
  [[nodiscard]] double outside() const { return outside_; }
  [[nodiscard]] const FloorPlan& floor() const { return floor_; }
  [[nodiscard]] const BodyPlan& body() const { return body_; }
  /// A disc as large is an open drop.
  [[nodiscard]] double open() const { return options_.support_max - precision; }

  /// Floor that one steps up or down to.
  [[nodiscard]] bool has_floor(const Vec3& place) const;
  /// As sees_at_knee.
  [[nodiscard]] bool sees(const Vec3& from, const Vec3& to) const;
  /// A body as large comes straight from one place to another without meeting a wall.
  [[nodiscard]] bool lets_pass(const Vec3& from, const Vec3& to, double body) const;
  /// A sphere let go at knee height sinks farther than a step below the place.
  [[nodiscard]] bool sinks(const Vec3& place, double radius) const;
  /// Where a foot comes to rest that sinks there; none where there is no bottom.
  [[nodiscard]] std::optional<Vec3> bottom(const Vec3& place) const;

  static constexpr double precision = 2e-5;  ///< m, of all radii

 private:
  const Survey& survey_;
  CrackOptions options_;
  double step_, radius_, outside_;
  FloorPlan floor_;
  BodyPlan body_;
};

/// A place of a rim and the disc that its void was climbed to from there, which may be far away.
struct RimPlace {
  Vec3 rim{0.0};
  Vec3 outside{0.0};  ///< in the void
  Disc disc;          ///< radius at least probe.open(): an open drop
};

class RimEdges;

/// Of the edges of a floor triangle, bit k that from corner k to the next, those that have no void outside, whoever
/// comes there: those that are `known` to have none, and what is found out about the others.
[[nodiscard]] std::uint8_t edges_without_void(const VoidProbe& probe, const CrackOptions& options,
                                              const Triangle& floor, std::uint8_t known);

/// Of all edges of all floors that are reached, every 2 * smallest, the places that have a void outside, by position.
/// `edges`, of the same survey and options, is told what is found out for whoever comes to other floors. Sets `ended`
/// when `goes_on` says so, and stops early.
[[nodiscard]] std::vector<RimPlace> find_voids(const Survey& survey, const CrackOptions& options,
                                               const VoidProbe& probe, RimEdges& edges,
                                               const std::function<bool(const Vec3& foot)>& is_reached,
                                               const std::function<bool(double)>& goes_on, std::atomic<bool>& ended);

/// Level by level, first by x.
[[nodiscard]] inline bool comes_before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// By where the rim is.
[[nodiscard]] inline bool lies_before(const RimPlace& a, const RimPlace& b) {
  return comes_before(a.rim, b.rim) || (a.rim == b.rim && comes_before(a.outside, b.outside));
}

}  // namespace roam::cracks
