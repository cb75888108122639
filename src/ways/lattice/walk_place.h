#pragma once
/// \file
/// How a body stands at a place of the floor, and the floor's height.

#include <array>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <optional>
#include <unordered_map>
#include <vector>

#include "math/random.h"
#include "ways/lattice/lattice.h"

namespace roam::ways {

/// A body that is free at a place: its radius, and by how much it is lifted off the place (m).
struct Stand {
  double radius = 0.0;
  double lift = 0.0;  ///< over bumps, kerbs and slopes, in [0, step]
};

/// The largest radius to try: measure.widest, or half of the height above the knee if that is less.
[[nodiscard]] double largest_radius(const Measure& measure);

/// The body for queries: the sphere itself, or a capsule that reaches from the knee to the top. Lowered to the floor,
/// it passes through all that a standing capsule fills.
[[nodiscard]] Body body_of(const Measure& measure, double radius);
[[nodiscard]] Vec3 centre_of(const Measure& measure, const Vec3& place, const Stand& stand);

/// The surfaces within `reach` of body_of() at a place, nearest first.
[[nodiscard]] std::vector<Contact> surfaces_at(const Survey& survey, const Measure& measure, const Vec3& place,
                                               double radius, const Stand& stand, double reach);
/// The same of a body that stands there, down to its feet: the sides of an opening. On foot the floor is none of them,
/// nor what the body steps over.
[[nodiscard]] std::vector<Contact> sides_of(const Survey& survey, const Measure& measure, const Vec3& place,
                                            double radius, const Stand& stand, double reach);

/// Whether a capsule that goes straight between two places, low enough to stand there, meets an obstacle that is too
/// high to step on. Such an obstacle may be below the rounded end of body_of().
[[nodiscard]] bool meets_high_obstacle(const Survey& survey, const Measure& measure, const Vec3& from, const Vec3& to,
                                       double radius);

/// The largest body up to `largest` that is free at a place of the floor; none if that is less than `least`. It must
/// also be free when it is lowered to the floor, or to an obstacle that it steps on.
[[nodiscard]] std::optional<Stand> stand_at(const Survey& survey, const Measure& measure, const Vec3& place,
                                            double largest, double least);

/// A place where feet rest.
struct FloorPlace {
  Vec3 place{0.0};
  /// m. The height of the floor under the axis, or of the rim that carries the feet. The next step counts from it. On a
  /// kerb's rim, `place` lies between the two floors; a step from there would climb too much.
  double level = 0.0;
  bool over_gap = false;  ///< over a gap of the floor
};

/// Known gaps of the floor, for one survey and measure: a lattice meets most of them from several sides. Safe for any
/// number of threads.
class KnownGaps {
 public:
  /// Older results are forgotten beyond this number; some 20 MB.
  static constexpr std::size_t most_known = 1 << 18;

  /// Whether a gap is open. The key is the axis over it, at the height of its rim. Calls `look(axis)` for unknown gaps,
  /// possibly more than once for one gap.
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

/// The floor for feet at height `level` beside (x, y); see foot_at. If they hang over a rim with no
/// floor below, the gap must be one that carries the largest support disc.
[[nodiscard]] std::optional<FloorPlace> floor_below(const Survey& survey, const Measure& measure, double x, double y,
                                                    double level, KnownGaps* gaps = nullptr);
/// The same over a gap without any floor below.
[[nodiscard]] std::optional<FloorPlace> place_over_gap(const Survey& survey, const Measure& measure, double x, double y,
                                                       double level, KnownGaps* gaps = nullptr);
/// The level of a foot whose place is known.
[[nodiscard]] double level_at(const Survey& survey, const Measure& measure, const Vec3& place);

}  // namespace roam::ways
