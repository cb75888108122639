#include "world/vicinity.h"

#include "index/traverse.h"
#include "math/largest.h"

namespace roam {
namespace {

/// The box is this many metres wider than the region, and this many motions longer.
constexpr double spare = 0.25;
constexpr double ways_ahead = 3.0;

/// Metres. Limits of the reach, the motion, and the sum of radius and half height. A body beyond them leaves the box
/// too soon or meets too much of it: gathering would take longer than it saves.
constexpr double farthest_reach = 0.25;
constexpr double longest_way = 0.2;
constexpr double largest_body = 16.0;
static_assert(longest_way <= index::short_motion);

/// Metres, in addition to the errors of the space: far above any rounding.
constexpr double slack = 1e-2;

}  // namespace

bool Vicinity::State::cover(const QueryRegion& q) {
  const bool far = q.reach > farthest_reach || largest(q.motion) > longest_way;
  if (far || index::is_thin(q.body) || q.body.radius + q.body.half_height > largest_body) return false;
  const double r = q.body.radius + q.reach + 2.0 * q.largest_error + slack;
  const Vec3 around(r, r, r + q.body.half_height);
  Box needed;
  needed.include(q.from);
  needed.include(q.from + q.motion);
  needed = needed.grown(around);
  if (box.holds(needed.lower) && box.holds(needed.upper)) return true;
  const Vec3 ahead = q.from + (1.0 + ways_ahead) * q.motion;
  box = needed;
  box.include(ahead - around);
  box.include(ahead + around);
  box = box.grown(spare);
  revision = 0;
  return true;
}

Vicinity::Vicinity() : state_(std::make_unique<State>()) {}
Vicinity::~Vicinity() = default;
Vicinity::Vicinity(const Vicinity& other) : state_(other.state_ ? std::make_unique<State>(*other.state_) : nullptr) {}
Vicinity::Vicinity(Vicinity&&) noexcept = default;
Vicinity& Vicinity::operator=(const Vicinity& other) {
  if (state_ && other.state_) {
    *state_ = *other.state_;
    return *this;
  }
  return *this = Vicinity(other);
}
Vicinity& Vicinity::operator=(Vicinity&&) noexcept = default;

void Vicinity::forget() {
  if (state_) *state_ = State();
}

}  // namespace roam
