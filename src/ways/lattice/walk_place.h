#pragma once
/// \file
/// How a body stands at a place of the floor, and where the floor is.

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <unordered_map>

#include "math/random.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

/// A body that is free at a place: its radius, and by how much it is lifted off the place (m).
struct Stand {
  double radius = 0.0;
  double lift = 0.0;  ///< spheres only: over bumps, kerbs and slopes, in [0, step]
};

/// The largest radius that is looked for: measure.widest, or what the height leaves above the knee.
[[nodiscard]] double largest_radius(const Measure& measure);

/// What is swept and asked for: of a sphere, itself; of a capsule, its part above the knee.
[[nodiscard]] Body body_of(const Measure& measure, double radius);
[[nodiscard]] Vec3 centre_of(const Measure& measure, const Vec3& place, const Stand& stand);

/// The largest body up to `largest` that is free at a place of the floor; none where that is less than `least`.
[[nodiscard]] std::optional<Stand> stand_at(const Survey& survey, const Measure& measure, const Vec3& place,
                                            double largest, double least);

/// Where a foot comes to rest.
struct Foot {
  Vec3 place{0.0};
  /// Of the floor under the axis, or of the rim that it is carried from (m): what the next step is up or down from. On
  /// the rim of a kerb the place is between the two floors, and to step up from there would climb more than a step.
  double level = 0.0;
  bool carried = false;  ///< over a gap of the floor
};

/// What was found out about gaps of the floor, of one survey and measure: a lattice comes to most from several sides.
/// Any number of threads.
class KnownGaps {
 public:
  /// What is known of more is forgotten, some 20 MB.
  static constexpr std::size_t most_known = 1 << 18;

  /// Whether a gap is open, by the axis over it at the level of its rim: `look(axis)`, once or oftener.
  template <class Look>
  bool is_open(const Vec3& axis, const Look& look) {
    Part& part = parts_[Hash{}(axis) % parts_.size()];
    {
      const std::lock_guard lock(part.mutex);
      if (const auto known = part.open.find(axis); known != part.open.end()) return known->second;
    }
    const bool open = look(axis);
    const std::lock_guard lock(part.mutex);
    if (part.open.size() >= most_known / parts_.size()) part.open.clear();
    part.open.emplace(axis, open);
    return open;
  }

 private:
  struct Hash {
    std::size_t operator()(const Vec3& v) const { return static_cast<std::size_t>(hashed(v)); }
  };
  struct Part {
    std::mutex mutex;
    std::unordered_map<Vec3, bool, Hash> open;
  };
  std::array<Part, 16> parts_;
};

/// The floor that a foot comes to that stands at height `level` beside it; see foot_at. Where it hangs on a rim with no
/// floor below, the gap must be one that the largest foot is carried over.
[[nodiscard]] std::optional<Foot> floor_below(const Survey& survey, const Measure& measure, double x, double y,
                                              double level, KnownGaps* gaps = nullptr);
/// The same where there is no floor at all.
[[nodiscard]] std::optional<Foot> carried_over(const Survey& survey, const Measure& measure, double x, double y,
                                               double level, KnownGaps* gaps = nullptr);
/// The level of a foot that is known to be at a place.
[[nodiscard]] double level_at(const Survey& survey, const Measure& measure, const Vec3& place);

}  // namespace roam::ways
