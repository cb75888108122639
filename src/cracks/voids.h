#pragma once
/// \file
/// Voids at the ends of floors: places just outside a rim where a small sphere sinks deeper than a step.

#include <algorithm>
#include <atomic>
#include <cmath>
#include <optional>
#include <vector>

#include "cracks/cracks.h"
#include "cracks/floor_plan.h"

namespace roam::cracks {

/// Whether nothing lies between two places at knee height above `from`, in a search for gaps of `smallest`. Sweeps a
/// sphere: small enough to pass between a rail and a wall, and larger than the gaps of badly made walls, through which
/// a ray would slip.
[[nodiscard]] bool sees_at_knee(const World& world, const Vec3& from, const Vec3& to, double knee, double smallest);

/// Queries of air, floor and wall at the level of a rim. The z of each place is that level.
class VoidProbe {
 public:
  VoidProbe(const Survey& survey, const CrackOptions& options);

  /// Radius of the sphere that sinks: a tenth less than CrackOptions::smallest, so that rounding never hides a gap of
  /// exactly that size.
  [[nodiscard]] double radius() const { return radius_; }
  /// The distance from a rim at which that sphere passes it.
  [[nodiscard]] double rim_offset() const { return rim_offset_; }
  [[nodiscard]] const FloorPlan& floor() const { return floor_; }
  [[nodiscard]] const BodyPlan& body() const { return body_; }
  /// A disc this large is an open drop.
  [[nodiscard]] double open_radius() const { return options_.support_max - precision; }

  /// Whether there is floor within a step up or down.
  [[nodiscard]] bool has_floor(const Vec3& place) const;
  /// As sees_at_knee.
  [[nodiscard]] bool sees(const Vec3& from, const Vec3& to) const;
  /// Whether a body of that radius goes straight between two places without meeting a wall.
  [[nodiscard]] bool lets_pass(const Vec3& from, const Vec3& to, double body) const;
  /// Whether a sphere dropped from knee height sinks deeper than a step below the place.
  [[nodiscard]] bool sinks(const Vec3& place, double radius) const;
  /// The place where a sinking foot comes to rest; none if there is no bottom.
  [[nodiscard]] std::optional<Vec3> bottom(const Vec3& place) const;

  static constexpr double precision = 2e-5;  ///< m, of all radii

 private:
  const Survey& survey_;
  CrackOptions options_;
  double step_, radius_, rim_offset_;
  FloorPlan floor_;
  BodyPlan body_;
};

/// A place of a rim, and the disc that a climb through its void ended with, which may be far away.
struct RimPlace {
  Vec3 rim{0.0};
  Vec3 outside{0.0};  ///< in the void
  Disc disc;          ///< radius at least probe.open_radius(): an open drop
};

class RimEdges;

/// At most so many places of an edge are examined: one such edge takes about a second. So a scene of a few enormous
/// triangles takes no longer than a large one.
constexpr double most_rim_places = 65536;

/// How many places of an edge are examined, metres: one every 2 * smallest, as far as most_rim_places allow.
[[nodiscard]] inline double rim_places(double length, double smallest) {
  return std::clamp(std::ceil(length / (2.0 * smallest)), 1.0, most_rim_places);
}

/// The edges of a floor triangle without a void outside, reached or not: bit k is the edge from corner k to the next.
/// Bits of `known` stay set; the other edges are examined. Adds nothing more once `stop` is set.
[[nodiscard]] std::uint8_t edges_without_void(const VoidProbe& probe, const CrackOptions& options,
                                              const Triangle& floor, std::uint8_t known, const std::atomic<bool>& stop);

/// All rim places with a void outside, sorted by position: rim_places() along each edge of the reached floors.
/// Adds its findings to `edges`, which must be of the same survey and options. Stops early and sets `ended` when
/// `goes_on` returns false.
[[nodiscard]] std::vector<RimPlace> find_voids(const Survey& survey, const CrackOptions& options,
                                               const VoidProbe& probe, RimEdges& edges,
                                               const std::function<bool(const Vec3& foot)>& is_reached,
                                               const std::function<bool(double)>& goes_on, std::atomic<bool>& ended);

/// Order by x, then y, then z.
[[nodiscard]] inline bool comes_before(const Vec3& a, const Vec3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

/// Order by the rim's position.
[[nodiscard]] inline bool lies_before(const RimPlace& a, const RimPlace& b) {
  return comes_before(a.rim, b.rim) || (a.rim == b.rim && comes_before(a.outside, b.outside));
}

}  // namespace roam::cracks
