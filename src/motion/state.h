#pragma once
/// \file
/// The internal state of a Walker.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "motion/gait.h"
#include "motion/instance_motion.h"
#include "motion/known.h"
#include "motion/move.h"
#include "motion/sizes.h"
#include "motion/walking.h"
#include "roam/walker.h"

namespace roam {

namespace walking {

/// The reason why a body cannot move.
enum class Hold : std::uint8_t {
  none,          ///< not held
  embedded,      ///< it overlaps something, and no checked way leads out
  waits,         ///< the same, and it overlaps unknown space
  no_ground,     ///< it would fall out of the scene, from where it fell before
  over_nothing,  ///< it would fall out of the scene: nothing is below
};

}  // namespace walking

class Walker::State {
 public:
  /// Creates a body that has not been placed yet.
  State(const Space& space, const WalkerSettings& settings, Mode mode);

  [[nodiscard]] Body body() const;
  [[nodiscard]] Vec3 feet() const;
  [[nodiscard]] Vec3 velocity() const;
  [[nodiscard]] Vec3 pace() const;
  [[nodiscard]] bool held() const { return hold_ != walking::Hold::none; }
  [[nodiscard]] const Space& space() const { return *space_; }

  // Effects of move_instances() on a body, in this order (move_instances.cpp).

  /// Begins a report of motion caused from outside.
  void begin_shifts();
  /// Whether the body moves with the instance or is in its way. False for a ghost and for a held body.
  [[nodiscard]] bool meets(const walking::InstanceMotion& shift) const;
  /// Takes the gap to an instance that it does not meet into the clearance of its rest.
  void note_passing(const walking::InstanceMotion& shift);
  /// The response of the body while an instance is shifted; nothing if it has nowhere to go. `rest`: the space without
  /// that instance.
  [[nodiscard]] std::optional<walking::Response> response(const Space& rest, const walking::InstanceMotion& shift);
  void take(const walking::InstanceMotion& shift, const walking::Response& to);
  /// `ground_velocity`: at the body's feet, for a body that stands.
  void end_shifts(const Vec3& ground_velocity, double dt);

  /// The plane of the floor last seen by a body with a support disc.
  [[nodiscard]] std::optional<FloorPlane> floor() const {
    return gait_.floor_seen ? std::optional(gait_.floor) : std::nullopt;
  }

 private:
  friend class Walker;

  const StepReport& step(const WalkerInput& input, double dt);
  /// `lift`: height of the centre above `at`, as a part of the body's height.
  const StepReport& place(const Vec3& at, double lift);
  const StepReport& set_mode(Mode mode);
  void set_regions(std::span<const SizeRegion> regions);
  bool resize(double radius, double support_radius);

  /// Adds the motion of a shift to the report.
  void append(const walking::InstanceMotion& shift, const walking::Response& to);
  /// The motion of the last call, metres.
  [[nodiscard]] Vec3 moved() const;
  /// Revision of the space; 0 if it has none.
  [[nodiscard]] std::uint64_t revision() const { return space_->facts().revision.value_or(0); }
  /// Whether the space may have changed since looked_at_.
  [[nodiscard]] bool may_have_changed() const;
  [[nodiscard]] walking::Move under_way();
  [[nodiscard]] walking::Sizes sizes();
  void take_size_here();
  walking::Ending fly(walking::Move& move, const Vec3& velocity, double dt);
  void slow_down(WalkerInput& input);
  void begin();
  [[nodiscard]] bool move(const WalkerInput& input, double dt);  ///< whether the whole time passed
  walking::Ending move_for(const WalkerInput& input, double dt);
  void settle();
  void fit_in();
  [[nodiscard]] bool crouch_at(const Vec3& place);  ///< if the crouched body fits, or is too near by a rounding
  void free_body();
  void free_to(const std::optional<Vec3>& free);  ///< holds it if there is no such position
  void come_back();
  void put(const Vec3& place, double time);
  void hold(walking::Hold why);
  void release();
  bool come_back_to(const walking::Refuge& refuge, bool over_ground);
  void put_back();
  [[nodiscard]] bool over_ground(const walking::Refuge& refuge) const;
  [[nodiscard]] bool embedded() const;
  [[nodiscard]] bool in_unknown() const;
  void look_again();
  [[nodiscard]] walking::Refuge here() const;
  void remember_safe();
  void finish();

  const Space* space_;
  WalkerSettings given_;     ///< as made
  WalkerSettings settings_;  ///< at its present size
  std::vector<SizeRegion> regions_;
  std::vector<char> inside_;  ///< for each region, whether the body counts as inside
  walking::Size outside_;     ///< size outside all regions
  double skin_ = 0.0;
  double slope_cosine_ = 0.0;
  Mode mode_ = Mode::fly;
  StepReport report_;
  walking::Gait gait_;
  walking::Whereabouts at_;
  Vec3 wished_{0.0};      ///< mean wished velocity over the last step, m/s
  Vec3 in_the_end_{0.0};  ///< wished velocity at the end of that step, m/s
  Vicinity vicinity_;
  walking::Refuge safe_;    ///< last position where the body stood; until it has stood, where it fitted
  walking::Refuge ground_;  ///< last position with something below: for the ghost, and for walking before another mode
  walking::Hold hold_ = walking::Hold::none;
  bool was_blocked_ = false;   ///< at the end of the last step, and it has not been put elsewhere since
  bool was_put_back_ = false;  ///< and it has not been put elsewhere since
  struct Ride {
    Vec3 way{0.0};         ///< m, by which move_instances() has moved it
    double seconds = 0.0;  ///< simulated by move_instances()
  };
  Ride ride_;         ///< since the last step
  Vec3 riding_{0.0};  ///< m/s: its average before the last call, if that was a step
  /// Metres. Certified clearance of the rest since the last segment of a shift, to the instance alone; infinite if
  /// there was no rest.
  double rested_ = std::numeric_limits<double>::infinity();
  bool shifted_ = false;         ///< an instance has moved it since begin_shifts()
  bool fitted_ = false;          ///< at begin_shifts() it was known to fit or to be held
  bool resized_ = false;         ///< another size may be wanted than when the body was held
  std::uint64_t known_at_ = 0;   ///< revision of the space that at_.known is about
  std::uint64_t looked_at_ = 0;  ///< revision of the space in which the body is known to fit or to be held
};

}  // namespace roam
