#pragma once
/// \file
/// The report of one step of a Walker: its segments, contacts and events; the tally of a run of steps.
///
/// Lengths are metres, times seconds. Axis clearances are certified lower bounds, capped at radius + clearance_reach.

#include <array>
#include <cstddef>
#include <cstdint>

#include "roam/math.h"
#include "roam/space.h"

namespace roam {

enum class EventKind : std::uint8_t {
  slid,          ///< touched something and went on along it
  blocked,       ///< touched something and could not go on; once for each time (StepReport::blocked: in each step)
  stepped_up,    ///< walked up a kerb, stair or sill
  stepped_down,  ///< walked down one
  jumped,        ///< left the ground by a jump
  airborne,      ///< left the ground otherwise
  landed,        ///< came back to ground
  fell,          ///< is more than Walker::fall_limit() below its last ground; once for each fall
  crouched,      ///< became low, to pass under something or on command
  stood,         ///< found head-room and stood up again
  placed,        ///< put at a position by the caller
  freed,         ///< put where it did not fit, and moved to a free place; not for corrections of a few millimetres
  held,          ///< cannot move: does not fit and cannot be freed, or has nothing below it (see put_back)
  put_back,      ///< fell below everything and was put back over its last ground; `held` follows if that fails
  returned,      ///< left ghost mode inside a wall and was put to the nearest safe position
  throttled,     ///< the step needed too many segments and ended early; see StepReport::elapsed
  met_unknown,   ///< touches, stands on (with its support disc too) or is in unknown space
  slowed,        ///< the wish was faster than SpaceFacts::speed_limit and was slowed to it
  narrowed,      ///< became smaller, in a region or on command: see Walker::set_regions()
  widened,       ///< became larger again
  bridged,       ///< stepped over a crack that its support disc spans: see WalkerSettings::support_radius
};
[[nodiscard]] const char* to_string(EventKind kind);  ///< "slid", "stepped_up", ...

struct Event {
  EventKind kind = EventKind::slid;
  Vec3 point{0.0};  ///< of a contact: on the triangle; otherwise the body's centre
};

/// A list of at most N values, stored inline; never allocates. Values pushed beyond N are counted, not kept.
template <class T, std::size_t N>
class InlineList {
 public:
  static constexpr std::size_t capacity = N;
  [[nodiscard]] std::size_t size() const { return total_ < N ? total_ : N; }
  [[nodiscard]] std::size_t total() const { return total_; }  ///< all that were pushed, kept or not
  [[nodiscard]] bool empty() const { return total_ == 0; }
  [[nodiscard]] bool full() const { return total_ >= N; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return values_[i]; }
  [[nodiscard]] T& operator[](std::size_t i) { return values_[i]; }
  [[nodiscard]] const T* begin() const { return values_.data(); }
  [[nodiscard]] const T* end() const { return values_.data() + size(); }
  [[nodiscard]] const T& back() const { return values_[size() - 1]; }
  [[nodiscard]] T& back() { return values_[size() - 1]; }
  void clear() { total_ = 0; }
  void shorten(std::size_t size) { total_ = size < total_ ? size : total_; }  ///< keeps the first `size`
  void push(const T& value) {
    if (total_ < N) values_[total_] = value;
    ++total_;
  }

 private:
  std::array<T, N> values_;
  std::size_t total_ = 0;
};

/// One straight piece of a move, from the end of the one before it, with one size of the body. A change of size has
/// segments of its own, also of length 0.
struct Segment {
  Vec3 position{0.0};   ///< of the centre at its end
  double height = 0.0;  ///< of the body
  double radius = 0.0;  ///< of the body
  double time = 0.0;    ///< at its end, since the step began
  /// Along all of it, at least radius - 1e-6; 0 if unknown (ghost, or being freed). It may be too low, by at
  /// most a quarter of the gap plus two skins plus 2 mm; Space::clearance() measures more closely.
  double axis_clearance = 0.0;
  bool teleport = false;  ///< put here, not moved: nothing is known of the way
};

/// Result of one step. Belongs to the Walker; valid until its next call.
struct StepReport {
  InlineList<Segment, 64> segments;  ///< in order; empty if the body did not move. Pieces in one direction are merged
  /// Each touched feature of a triangle once, in the order in which it was last touched. If there are more than 8:
  /// the first 7 and the last. `distance` is the gap to the plane of the contact where the body stopped.
  InlineList<Contact, 8> contacts;
  /// In order. A very long step may leave out slides and steps, never the events that end it.
  InlineList<Event, 24> events;
  Vec3 from{0.0};       ///< the centre before
  Vec3 to{0.0};         ///< the centre now
  double height = 0.0;  ///< of the body now
  double radius = 0.0;  ///< of the body now
  /// A lower bound at `to`, perhaps that of the whole last segment. 0: none (ghost, or overlapping).
  double axis_clearance = 0.0;
  double least_axis_clearance = 0.0;    ///< the least of all segments and `to`
  double least_gap = 0.0;               ///< the least axis clearance - radius of the same, each with its own radius
  double elapsed = 0.0;                 ///< simulated time: dt, or a part of it if throttled
  double landing_speed = 0.0;           ///< m/s, downward: the fastest landing of this step; 0: none
  Vec3 ground_velocity{0.0};            ///< m/s: see Stance::ground_velocity
  bool grounded = false;                ///< stands on something (walk mode)
  bool bridging = false;                ///< its support disc spans the crack below it
  bool blocked = false;                 ///< could not go on in the wished direction; contacts.back() is why
  bool held = false;                    ///< see EventKind::held: the same as Walker::held()
  bool put_back = false;                ///< see EventKind::put_back
  bool met_unknown = false;             ///< see EventKind::met_unknown
  [[nodiscard]] double length() const;  ///< of the way that the centre moved, without teleports
  [[nodiscard]] bool has(EventKind kind) const {
    for (const Event& e : events)
      if (e.kind == kind) return true;
    return false;
  }
};

struct Tally {
  std::uint64_t steps = 0;
  double length = 0.0;                ///< of the way that the centre moved, without teleports
  double simulated = 0.0;             ///< time
  double least_axis_clearance = 0.0;  ///< the least StepReport::least_axis_clearance; 0: none was certified yet
  double least_gap = 0.0;             ///< the least StepReport::least_gap, with the radius that the body had there
  std::uint64_t throttled = 0;        ///< steps that ended early or were slowed, see EventKind
  void add_step(const StepReport& report);
  void add_placement(const StepReport& report);  ///< of place(), as at the start: only its clearance counts
};

}  // namespace roam
