#pragma once
/// \file
/// What a Walker is made of.

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "motion/gait.h"
#include "motion/known.h"
#include "motion/move.h"
#include "motion/instance_motion.h"
#include "motion/sizes.h"
#include "motion/walking.h"
#include "roam/walker.h"

namespace roam {

namespace walking {

/// Why a body cannot move.
enum class Hold : std::uint8_t {
  none,          ///< it can
  embedded,      ///< it does not fit, and no checked way leads out
  waits,         ///< the same, and what it is in is not known yet
  no_ground,     ///< it would fall out of the scene, from where it fell before
  over_nothing,  ///< it would fall out of the scene: nothing is below
};

}  // namespace walking

class Walker::State {
 public:
  /// A body that has not been placed yet.
  State(const Space& space, const WalkerSettings& settings, Mode mode);

  [[nodiscard]] Body body() const;
  [[nodiscard]] Vec3 feet() const;
  [[nodiscard]] Vec3 velocity() const;
  [[nodiscard]] Vec3 pace() const;
  [[nodiscard]] bool held() const { return hold_ != walking::Hold::none; }
  [[nodiscard]] const Space& space() const { return *space_; }

  // What move_instances() does to a body, in this order (move_instances.cpp).

  /// Begins a report of what moves the body from outside.
  void begin_shifts();
  /// Whether the body goes along with the instance or is in its way; false for a ghost and for a body that is held.
  [[nodiscard]] bool is_concerned(const walking::InstanceMotion& shift) const;
  /// Where the body goes while an instance is shifted; none: it has nowhere to go. `rest`: the space without that
  /// instance.
  [[nodiscard]] std::optional<walking::Response> response(const Space& rest, const walking::InstanceMotion& shift);
  void take(const walking::InstanceMotion& shift, const walking::Response& to);
  /// `ground_velocity`: at its feet, for a body that stands.
  void end_shifts(const Vec3& ground_velocity, double dt);

  /// The plane that a body goes by which is carried by its foot.
  [[nodiscard]] const FloorPlane& floor() const { return gait_.floor; }

 private:
  friend class Walker;

  const StepReport& step(const WalkerInput& input, double dt);
  /// `lift`: how far the centre lies above `at`, part of the height.
  const StepReport& place(const Vec3& at, double lift);
  const StepReport& set_mode(Mode mode);
  void set_regions(std::span<const SizeRegion> regions);
  bool resize(double radius, double support_radius);

  /// Adds the way of a shift to the report.
  void append(const walking::InstanceMotion& shift, const walking::Response& to);
  /// The way of the last call, metres.
  [[nodiscard]] Vec3 moved() const;
  /// Of the space; 0 where it has none.
  [[nodiscard]] std::uint64_t revision() const { return space_->facts().revision.value_or(0); }
  [[nodiscard]] walking::Move under_way();
  [[nodiscard]] walking::Sizes sizes();
  void take_size_here();
  walking::Ending fly(walking::Move& move, const Vec3& velocity, double dt);
  void slow_down(WalkerInput& input);
  void begin();
  void move(const WalkerInput& input, double dt);
  walking::Ending move_for(const WalkerInput& input, double dt);
  void settle();
  void fit_in();
  void free_body();
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
  WalkerSettings given_;     ///< when it was made
  WalkerSettings settings_;  ///< of its present size
  std::vector<SizeRegion> regions_;
  std::vector<char> inside_;  ///< of each region: whether the body counts as in it
  walking::Size outside_;     ///< outside all regions
  double skin_ = 0.0;
  double slope_cosine_ = 0.0;
  Mode mode_ = Mode::fly;
  StepReport report_;
  walking::Gait gait_;
  walking::Whereabouts at_;
  Vec3 wished_{0.0};      ///< velocity on average over the last step, m/s
  Vec3 in_the_end_{0.0};  ///< the velocity that the wish had become then
  Vicinity vicinity_;
  walking::Refuge safe_;    ///< last place where the body stood or, where it has not stood yet, fitted
  walking::Refuge ground_;  ///< last place with something below: of the ghost, and of walking before another mode
  walking::Hold hold_ = walking::Hold::none;
  bool was_blocked_ = false;   ///< at the end of the last step, and has not been put elsewhere since
  bool was_put_back_ = false;  ///< and has not been put elsewhere since
  Vec3 ridden_{0.0};           ///< metres that move_instances() has moved it since the last step
  Vec3 rode_{0.0};             ///< the same before the last call, where that was a step
  /// Certified of the rest since the last segment of a shift, of the instance alone, metres; infinite: there was none.
  double rested_ = std::numeric_limits<double>::infinity();
  bool shifted_ = false;         ///< something has moved it since begin_shifts()
  bool fitted_ = false;          ///< at begin_shifts() it was known to fit, or to be held
  bool resized_ = false;         ///< another size may be wanted than when the body was held
  std::uint64_t known_at_ = 0;   ///< the revision of the space of which at_.known is
  std::uint64_t looked_at_ = 0;  ///< the revision of the space in which the body is known to fit, or to be held
};

}  // namespace roam
