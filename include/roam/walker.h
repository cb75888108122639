#pragma once
/// \file
/// A body that moves through a Space at a person's command and never through a wall.
///
///     roam::Walker walker(space, {.radius = 0.3}, roam::Mode::walk, start);
///     const roam::StepReport& step = walker.step({.velocity = {1.4, 0.0, 0.0}}, 1.0 / 60.0);
///     std::cout << walker.position().x << " is at least " << step.clearance << " m from every wall\n";
///
/// What is promised, for any speed and any time step, in fly and walk mode:
///   - the body only moves along straight pieces that the space has certified free, by Space::sweep or by Space::gap,
///     asked of the piece or, in a space that tells its changes, before of what lies around it; so that at every
///     instant its axis is at least radius - 1e-6 m from every triangle. The corners of the pieces are in the report,
///     each with its own certified bound;
///   - the one exception is a body that is *put* where it does not fit: it is freed by a way that is checked as far as
///     such a way can be (see Walker::place), or held where it is, and the report says which. Corners to which a body
///     was put and not moved are marked as teleports;
///   - the same space, settings and calls give the same bits on every run.
///
/// *Clearance* is the distance, in metres, of the body's axis (a sphere: its centre) from the nearest triangle; the gap
/// between surfaces is clearance - radius. Positions are those of the body's centre. Up is +z.
///
/// A Walker is one body: use it from one thread at a time. Any number of them may share a Space. Moving allocates
/// nothing. docs/walking.md explains the rules and their limits.

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "roam/error.h"
#include "roam/math.h"
#include "roam/size_region.h"
#include "roam/space.h"
#include "roam/stance.h"

namespace roam {

namespace walking {
class Move;
struct Sizes;
enum class Ending : std::uint8_t;
}  // namespace walking

/// fly: no gravity, collide and slide. walk: gravity, ground, steps, slopes, crouching. ghost: no collision at all.
enum class Mode : std::uint8_t { fly, walk, ghost };

/// "fly", "walk" or "ghost".
[[nodiscard]] const char* name(Mode mode);

/// What the body is and what it can do. The defaults are a grown person on foot.
struct WalkerSettings {
  /// Metres, > 0, <= Space::reach_limit / 4. Half the least width the body needs. Too large: kept out of rooms that a
  /// person enters; too small: falls through cracks that a person steps over.
  double radius = 0.3;
  /// Metres, in [0, Space::reach_limit / 4]. Of a foot that is wider than the body: in walk mode it carries the body
  /// over every crack of the floor in which no disc of this radius finds room, held at the height of the floor. The
  /// foot touches nothing: whatever the body passes, it passes too. Half the width of the widest crack and 2 mm more
  /// will do. Less than `radius` counts as `radius`: over a crack that a body so large cannot fall into it is carried,
  /// and does not sink. What is not known yet carries it as floor does, and the report says `met_unknown`. 0: no foot,
  /// the body stands on its round end. docs/walking.md says what is a crack and what a pit.
  double support_radius = 0.0;
  /// Whole height in metres, >= 2 * radius (equal: the sphere of the paper), <= Space::reach_limit / 4.
  double height = 1.8;
  /// Camera above the lowest point when standing, metres, in [0, height]. Lowered in proportion when crouched.
  double eye = 1.6;
  /// Metres, in [0, height / 2]. Ground that lies at most this much higher or lower than the ground last stood on is
  /// walked onto without a jump or a fall. 0: every kerb stops the body.
  double step = 0.3;
  /// Degrees, in [0, 89]. Ground steeper than this is a wall to go up and a slide to go down.
  double slope_degrees = 45.0;
  /// Metres per second, > 0, <= 1e4. Only wish_velocity uses it: Walker::step takes any velocity.
  double speed = 1.4;
  /// Factor on speed when hurrying, >= 1.
  double fast_factor = 5.0;
  /// Metres per second squared, >= 0. Walk mode only. 0: a body that leaves the ground floats on.
  double gravity = 9.81;
  /// How high a jump lifts the body, metres, in [0, 100]. 0: it does not jump.
  double jump_height = 0.5;
  /// Whole height when crouched, metres, > 0. Taken as 2 * radius where it is less; a body that is not taller than
  /// that (a sphere never is) does not crouch.
  double crouch_height = 1.1;
  /// How far around the body's surface clearance is measured after each step, metres, in [0, Space::reach_limit].
  /// Reported clearances are capped at radius + clearance_reach. The larger, the slower in wide open scenes.
  double clearance_reach = 1.0;

  /// The settings of the paper's sphere: height 2 * radius, the eye at its centre, a step of at most its radius.
  static WalkerSettings sphere(double radius) {
    WalkerSettings s;
    s.radius = radius;
    s.height = 2.0 * radius;
    s.eye = radius;
    s.step = s.step < radius ? s.step : radius;
    return s;
  }
};

/// Throws roam::Error, naming the setting, its value and its range, when a setting is out of range or not a number.
void check(const WalkerSettings& settings);

/// Throws roam::Error, naming the region by its number from 1 and its `why`, for bounds that are empty or not finite,
/// and for a size that a body with these settings may not have: see Walker::set_regions.
void check(std::span<const SizeRegion> regions, const WalkerSettings& settings);

/// The velocity of a person who pushes in `direction` (length at most 1 counts; longer is shortened to 1): m/s.
[[nodiscard]] Vec3 wish_velocity(const WalkerSettings& settings, const Vec3& direction, bool fast);

/// What a person wishes for one step.
struct WalkerInput {
  /// Metres per second, finite. Walk mode takes the horizontal part; in the air it steers as on the ground.
  Vec3 velocity{0.0};
  bool jump = false;    ///< walk mode: jump, when on the ground
  bool crouch = false;  ///< walk mode: crouch, and stay so. Low ceilings make the body crouch without being told.
};

/// What may happen in a step.
enum class EventKind : std::uint8_t {
  slid,          ///< touched something and went on along it
  blocked,       ///< touched something and could not go on
  stepped_up,    ///< walked up a kerb, stair or sill
  stepped_down,  ///< walked down one
  jumped,        ///< left the ground by a jump
  airborne,      ///< left the ground otherwise
  landed,        ///< came back to ground
  fell,          ///< is more than Walker::fall_limit below where it last stood; once a fall
  crouched,      ///< became low to pass under something, or on command
  stood,         ///< found head-room and stood up again
  placed,        ///< put at a place by the caller
  freed,         ///< was put where it did not fit and moved, by a checked way, to where it does; not said of the few
                 ///< millimetres that part a body put exactly in touch from what it touches
  held,          ///< cannot move: does not fit here and no checked way leads out, or nothing is below and it was put
                 ///< back to the last safe place
  returned,      ///< left ghost mode inside a wall and was put to the nearest safe place
  throttled,     ///< the step needed more corners than fit in a report and ended early; see StepReport::elapsed
  met_unknown,   ///< touched, stands on (its foot, too) or is in what is not known yet (see space.h): solid until it is
                 ///< known
  slowed,        ///< the wish was faster than Space::speed_limit() and was followed at that speed
  narrowed,      ///< became a smaller body, in a region or on command: see Walker::set_regions
  widened,       ///< became a larger one again
  carried,       ///< stepped over a crack that its foot carries it over: see WalkerSettings::support_radius
};

/// The name of a kind as it stands above: "slid", "stepped_up", ...
[[nodiscard]] const char* name(EventKind kind);

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

/// The end of one straight piece of a move.
struct Corner {
  Vec3 position{0.0};  ///< of the centre, metres
  /// The body's whole height, metres, all along the piece that ends here. A change of height shows as a piece of its
  /// own: crouching lowers the centre with the new, lower body (inside the old one); standing up raises the centre with
  /// the old body and then has a corner at the same position with the new one.
  double height = 0.0;
  /// The body's radius, metres, all along the piece that ends here. A change of radius shows likewise: a smaller body
  /// goes from the old centre to its own, inside the old body; a larger one has the old body go to its centre, and then
  /// a corner at the same position with the new one.
  double radius = 0.0;
  double time = 0.0;  ///< seconds since the step began
  /// Certified lower bound of the clearance all along the piece that ends here, metres; 0 where none is known (ghost,
  /// and a body that is being freed). Never less than radius - 1e-6 otherwise; it may be less than the true clearance,
  /// by a quarter of the gap, two skins and 2 mm at most on a free way: Space::clearance tells more. What is merged of
  /// many ways in one direction has the least of theirs.
  double clearance = 0.0;
  bool teleport = false;  ///< put here, not moved: nothing is said about the way
};

/// What one step did. Lives in the Walker; valid until its next call.
struct StepReport {
  /// Of the move, in order; empty when the body did not move. Pieces in one direction are merged. A step that would
  /// need more ends early: see `elapsed`.
  InlineList<Corner, 64> corners;
  /// What was touched on the way, each feature of a triangle once, the last touched last; of more than 8 the first 7
  /// and the last. `distance` is the gap to the plane of the contact where the body stopped.
  InlineList<Contact, 8> contacts;
  /// What happened, in order. Of a very long step some slides and steps may be left out; what ends a step never is.
  InlineList<Event, 24> events;
  Vec3 from{0.0};       ///< the centre before, metres
  Vec3 to{0.0};         ///< the centre now, metres: the last corner, if there is one
  double height = 0.0;  ///< the body's whole height now, metres
  double radius = 0.0;  ///< the body's radius now, metres
  /// Certified lower bound of the clearance at `to`, metres, capped at radius + clearance_reach: that of the way which
  /// ends there, or, where the body did not move, of the place. 0: none (ghost, held while embedded, or something has
  /// come upon it of which the next step frees it).
  double clearance = 0.0;
  double least_clearance = 0.0;  ///< the least over all pieces and `to`, metres, capped likewise
  /// The least clearance - radius over the same, metres, each with its own radius: how near the surface came.
  double least_gap = 0.0;
  double elapsed = 0.0;      ///< seconds that were simulated: dt, or less when throttled
  bool grounded = false;     ///< stands on something (walk mode)
  bool carried = false;      ///< stands on its foot over a crack: see WalkerSettings::support_radius
  bool blocked = false;      ///< ended this step unable to go on in the wished direction; contacts.back() is why
  bool held = false;         ///< see EventKind::held
  bool met_unknown = false;  ///< see EventKind::met_unknown

  [[nodiscard]] bool has(EventKind kind) const {
    for (const Event& e : events)
      if (e.kind == kind) return true;
    return false;
  }
};

class Walker {
 public:
  /// Puts a body into `space`, which must outlive it and stay where it is, at `start` (of its centre), as place() does.
  /// Throws roam::Error for bad settings and for a start that is not finite.
  Walker(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& start);
  Walker(Space&& space, const WalkerSettings& settings, Mode mode, const Vec3& start) = delete;

  /// Moves for `dt` seconds (>= 0, finite). See the head of this file for what is promised. Throws roam::Error for
  /// input that is not finite.
  ///
  /// Cost on free flat ground: one look for the nearest triangle, over the way, and one sweep down to the ground.
  /// Flying: the one look; none at all while the body is still well inside what an earlier one has found free.
  const StepReport& step(const WalkerInput& input, double dt);

  /// Puts the standing body's centre at `centre`, at rest; in walk mode, where only the crouched body fits, that, with
  /// the same feet. Where it does not fit there, it is moved to the nearest place found where it does, at most its own
  /// height away, along a straight way on which a sphere about its centre, as large as the start allows, is certified
  /// to meet nothing: so its centre is never moved to the far side of a wall. Where there is none, in walk mode, it
  /// crouches with its centre there. Else it is held: it stays, every step reports `held`, and only place() and ghost
  /// mode get it away, or a change of the space: when its Space::revision() has grown, the next step goes on as if the
  /// body had been put there then. A body that is held by what is not known yet also says `met_unknown`; as soon as it
  /// is known there the next step goes on likewise, in spaces without revisions too.
  const StepReport& place(const Vec3& centre);

  /// Changes the mode. Leaving ghost mode inside a wall puts the body to the nearest safe place: the nearest that is
  /// found around it, or the last place of its way as a ghost where it fitted, whichever is nearer.
  const StepReport& set_mode(Mode mode);

  /// From now on the body has another size in these regions, and that of its settings outside all of them. Where
  /// regions overlap, the smallest body and the largest foot count. Copied.
  ///
  /// A body is in a region as soon as its centre or its lowest point is in the bounds, and until both are more than
  /// 5 cm outside. It is asked in each step, every half radius of its way. It becomes smaller at once: the small body
  /// lies in the large one, with the same lowest point and, but for a sphere, the same height. It becomes larger when
  /// the larger body is certified free with the same lowest point, on a slope with one as much higher as the larger
  /// body needs there; until then it goes on as it is. A sphere stays a sphere; the eye keeps its height above the
  /// lowest point, or is at the top of a body that is not so high. A foot that carries stays as large as it is.
  ///
  /// Takes effect with the next call. Throws roam::Error for what check() refuses; then all is as before.
  void set_regions(std::span<const SizeRegion> regions);
  [[nodiscard]] std::span<const SizeRegion> regions() const { return regions_; }

  /// From now on this is the size outside all regions, metres: for those who learn on the way which size serves. A
  /// smaller body is had at once, a larger one as soon as it fits, in this call or a later one; as in regions. Returns
  /// whether the body has the size that is wanted where it is. report() tells what happened. Throws roam::Error for a
  /// size that settings may not have; then all is as before.
  bool resize(double radius, double support_radius);

  [[nodiscard]] const Space& space() const { return *space_; }
  /// As they hold now: radius and support_radius, and of a sphere height, eye and step, are those of the present size.
  [[nodiscard]] const WalkerSettings& settings() const { return settings_; }
  [[nodiscard]] Mode mode() const { return mode_; }
  [[nodiscard]] const Vec3& position() const { return position_; }  ///< of the centre, metres
  [[nodiscard]] Vec3 feet() const;                                  ///< the lowest point, metres
  [[nodiscard]] Vec3 eye() const;                                   ///< the camera, metres
  [[nodiscard]] Body body() const;                                  ///< as it is now: in size, standing or crouched
  [[nodiscard]] bool crouched() const { return height_ < settings_.height; }
  [[nodiscard]] bool grounded() const { return stance_.grounded; }
  /// Does not fit where it is and can not be freed: see place().
  [[nodiscard]] bool held() const { return held_; }
  [[nodiscard]] const Stance& stance() const { return stance_; }
  /// Upward speed in the air, m/s; 0 on the ground and outside walk mode.
  [[nodiscard]] double rise_speed() const { return stance_.rise_speed; }
  /// Metres per second, on average over the last call: 0 when it did not move the body, and without what it was put.
  /// What LiveSpace::update wants to know.
  [[nodiscard]] Vec3 velocity() const;
  /// What the last call did.
  [[nodiscard]] const StepReport& report() const { return report_; }

  /// The gap, metres, that the body keeps from what it slides along. Twice the space's largest error, the height of the
  /// bumps that storing a flat wall may make in it, plus 0.1 mm. A soft target: passages that leave less than this on
  /// either side are passed all the same, so that the skin never counts twice.
  [[nodiscard]] double skin() const { return skin_; }

  /// A drop of the lowest point by more than this, metres, below the ground last stood on is a fall: radius + step.
  /// A round body that is carried by the rims of a crack sinks by less than its radius, and ground a step lower still
  /// counts as walked on; what lies deeper can not be climbed out of on foot.
  [[nodiscard]] double fall_limit() const { return settings_.radius + settings_.step; }

 private:
  [[nodiscard]] walking::Move under_way();
  [[nodiscard]] walking::Sizes sizes();
  void take_size_here();
  walking::Ending fly(walking::Move& move, const Vec3& velocity, double dt);
  [[nodiscard]] WalkerInput slowed(const WalkerInput& input);
  void begin();
  void move(const WalkerInput& input, double dt);
  walking::Ending move_for(const WalkerInput& input, double dt);
  void settle();
  void fit_in();
  void free_body();
  void come_back();
  void put(const Vec3& place, double time);
  void hold();
  void release();
  [[nodiscard]] bool embedded() const;
  [[nodiscard]] bool in_unknown() const;
  void come_to(const walking::Move& move);
  void look_again();
  void remember_safe();
  void finish();

  const Space* space_;
  WalkerSettings given_;     ///< when it was made
  WalkerSettings settings_;  ///< of its present size
  std::vector<SizeRegion> regions_;
  std::vector<char> inside_;  ///< of each region: whether the body counts as in it
  walking::Size outside_;     ///< outside all regions
  StepReport report_;
  Stance stance_;
  Vec3 position_{0.0};
  Vec3 safe_{0.0};            ///< last place where the body stood or, where it has not stood yet, fitted
  walking::Size safe_size_;   ///< there
  double safe_height_ = 0.0;  ///< metres, there; 0: there is none yet
  double height_ = 0.0;
  walking::Known known_;  ///< at position_
  double skin_ = 0.0;
  double slope_cosine_ = 0.0;
  Mode mode_ = Mode::fly;
  bool held_ = false;
  bool waits_ = false;           ///< held by what is not known yet
  bool resized_ = false;         ///< another size may be wanted than when the body was held
  std::uint64_t known_at_ = 0;   ///< the revision of the space of which known_ is
  std::uint64_t looked_at_ = 0;  ///< the revision of the space in which the body is known to fit, or to be held
};

}  // namespace roam
