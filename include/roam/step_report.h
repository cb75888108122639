#pragma once
/// \file
/// What a Walker tells of one step: the way it went, segment by segment, what it touched and what happened.

#include <array>
#include <cstddef>
#include <cstdint>

#include "roam/math.h"
#include "roam/space.h"

namespace roam {

/// What may happen in a step.
enum class EventKind : std::uint8_t {
  slid,          ///< touched something and went on along it
  blocked,       ///< touched something and could not go on; said once, and again after it could (StepReport::blocked)
  stepped_up,    ///< walked up a kerb, stair or sill
  stepped_down,  ///< walked down one
  jumped,        ///< left the ground by a jump
  airborne,      ///< left the ground otherwise
  landed,        ///< came back to ground
  fell,          ///< is more than Walker::fall_limit below where it last stood; once a fall
  crouched,      ///< became low to pass under something, or on command
  stood,         ///< found head-room and stood up again
  placed,        ///< put at a place by the caller
  freed,     ///< was put where it did not fit and moved, by a checked way, to where it does; not said of a correction
             ///< of a few millimetres
  held,      ///< is stuck: does not fit and cannot be freed, or has nothing below it (see put_back)
  put_back,  ///< fell below everything, and was put back to where it last had ground below; `held` follows where it has
             ///< nothing below there either, or falls from there again
  returned,  ///< left ghost mode inside a wall and was put to the nearest safe place
  throttled,    ///< the step needed more segments than fit in a report and ended early; see StepReport::elapsed
  met_unknown,  ///< touched, stands on (its foot, too) or is in what is not known yet (see space.h): solid until it is
                ///< known
  slowed,       ///< the wish was faster than SpaceFacts::speed_limit and was followed at that speed
  narrowed,     ///< became a smaller body, in a region or on command: see Walker::set_regions
  widened,      ///< became a larger one again
  bridged,      ///< stepped over a crack that its support disc spans: see WalkerSettings::support_radius
};

/// The name of a kind as it stands above: "slid", "stepped_up", ...
[[nodiscard]] const char* to_string(EventKind kind);

/// Something that happened, and where.
struct Event {
  EventKind kind = EventKind::slid;
  Vec3 point{0.0};  ///< of a contact: on the triangle; else the body's centre
};

/// A list of at most N values that lives where it is declared and never allocates. What is pushed beyond N is left out
/// and only counted.
template <class T, std::size_t N>
class InlineList {
 public:
  static constexpr std::size_t capacity = N;
  [[nodiscard]] std::size_t size() const { return total_ < N ? total_ : N; }
  [[nodiscard]] std::size_t total() const { return total_; }  ///< how many were pushed, the left out included
  [[nodiscard]] bool empty() const { return total_ == 0; }
  [[nodiscard]] bool full() const { return total_ >= N; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }
  [[nodiscard]] T& operator[](std::size_t i) { return values_[i]; }
  [[nodiscard]] const T* begin() const { return values_.data(); }
  [[nodiscard]] const T* end() const { return values_.data() + size(); }
  [[nodiscard]] const T& back() const { return values_[size() - 1]; }
  [[nodiscard]] T& back() { return values_[size() - 1]; }
  void clear() { total_ = 0; }
  void shorten(std::size_t size) { total_ = size < total_ ? size : total_; }  ///< forgets all but the first `size`
  void push(const T& value) {
    if (total_ < N) values_[total_] = value;
    ++total_;
  }

 private:
  std::array<T, N> values_;
  std::size_t total_ = 0;
};

/// One straight piece of a move, from where the one before ends.
struct Segment {
  Vec3 position{0.0};  ///< of the centre at its end, metres
  /// The body's whole height, metres, all along it. A change of height shows as a piece of its
  /// own: crouching lowers the centre with the new, lower body (inside the old one); standing up raises the centre with
  /// the old body and then has a segment that ends at the same position with the new one.
  double height = 0.0;
  /// The body's radius, metres, all along it. A change of radius shows likewise: a smaller body
  /// goes from the old centre to its own, inside the old body; a larger one has the old body go to its centre, and then
  /// a segment that ends at the same position with the new one.
  double radius = 0.0;
  double time = 0.0;  ///< seconds since the step began
  /// Certified lower bound of the clearance all along it, metres; 0 where none is known (ghost,
  /// and a body that is being freed). Never less than radius - 1e-6 otherwise. On a free way it is too low by at most a
  /// quarter of the gap, two skins and 2 mm: Space::clearance measures more closely. A merged piece has the least of
  /// its parts.
  double axis_clearance = 0.0;
  bool teleport = false;  ///< put here, not moved: nothing is said about the way
};

/// What one step did. Lives in the Walker; valid until its next call.
struct StepReport {
  /// Of the move, in order; empty when the body did not move. Pieces in one direction are merged. A step that would
  /// need more ends early: see `elapsed`.
  InlineList<Segment, 64> segments;
  /// What was touched on the way, each feature of a triangle once, the last touched last. If more than 8: the
  /// first 7 and the last. `distance` is the gap to the plane of the contact where the body stopped.
  InlineList<Contact, 8> contacts;
  /// What happened, in order. Of a very long step some slides and steps may be left out; what ends a step never is.
  InlineList<Event, 24> events;
  Vec3 from{0.0};       ///< the centre before, metres
  Vec3 to{0.0};         ///< the centre now, metres: the end of the last segment, if there is one
  double height = 0.0;  ///< the body's whole height now, metres
  double radius = 0.0;  ///< the body's radius now, metres
  /// Certified lower bound of the clearance at `to`, metres, capped at radius + clearance_reach: that of the way which
  /// ends there, or, where the body did not move, of the place. 0: none (ghost, held while embedded, or something that
  /// moved overlaps it until the next step frees it).
  double axis_clearance = 0.0;
  double least_axis_clearance = 0.0;  ///< the least over all pieces and `to`, metres, capped likewise
  /// The least clearance - radius over the same, metres, each with its own radius: how near the surface came.
  double least_gap = 0.0;
  double elapsed = 0.0;  ///< seconds that were simulated: dt, or less when throttled
  /// Metres per second, downward: the fastest landing of this step; 0: none.
  double landing_speed = 0.0;
  Vec3 ground_velocity{0.0};  ///< metres per second, of the moving ground under the body: see Stance::ground_velocity
  bool grounded = false;  ///< stands on something (walk mode)
  bool bridging = false;  ///< its support disc spans the crack below it: see WalkerSettings::support_radius
  bool blocked = false;   ///< could not go on in the wished direction in this step; contacts.back() is why
  bool held = false;      ///< see EventKind::held: the same as Walker::held()
  bool put_back = false;  ///< see EventKind::put_back
  bool met_unknown = false;  ///< see EventKind::met_unknown

  /// Metres that the centre moved, placing not counted.
  [[nodiscard]] double length() const;
  [[nodiscard]] bool has(EventKind kind) const {
    for (const Event& e : events)
      if (e.kind == kind) return true;
    return false;
  }
};

}  // namespace roam
