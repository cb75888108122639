#pragma once
/// \file
/// Size learner: adapts a body's size while it roams, if training is incomplete or missing.
///
///     roam::SizeLearner learner(profile);
///     for (;;) {
///       walker.step(input, dt);
///       if (const auto lesson = learner.watch(walker, input.velocity, dt)) {
///         std::cout << "an opening or a crack " << lesson->width << " m wide\n";
///         learner.take(walker, *lesson);  // optional
///       }
///     }
///     roam::save_profile(learner.profile(), roam::profile_path("dam.ply"));
///
/// It learns the two cases of figure 6 of Xie & Niu 2020. If a body cannot enter an opening, it becomes smaller there.
/// If it falls into a crack, its support disc becomes larger everywhere. A lesson is offered only after a trial: the
/// smaller body has a certified way through the opening, or a Walker with the larger disc is carried where the body
/// fell.
///
/// Call it from the thread that moves the body. watch() allocates only with a lesson. Target roam::profile.

#include <cstdint>
#include <optional>

#include "roam/profile.h"
#include "roam/walker.h"

namespace roam {

/// A change of size that would help. Metres.
struct Lesson {
  enum class Kind : std::uint8_t {
    narrower,  ///< a smaller body in a region
    support,   ///< a larger support disc everywhere
  };
  Kind kind = Kind::narrower;
  Vec3 at{0.0};                 ///< middle of the opening, or the body's centre where it fell
  SizeRegion region;            ///< for `narrower`
  double support_radius = 0.0;  ///< for `support`
  double width = 0.0;           ///< of the opening or crack
};

class SizeLearner {
 public:
  static constexpr double radius_min = 0.15;  ///< m: smallest body offered
  static constexpr double support_max = 1.0;  ///< m: largest support disc offered
  static constexpr double patience = 0.5;     ///< s of pushing against an opening before it is measured

  /// Starts from `known`. Its radius and support_radius are those of the walker outside all regions. Throws roam::Error
  /// if it is out of range.
  explicit SizeLearner(Profile known);

  /// Call after each step with the desired velocity, m/s, and the seconds of the step; after placing, with 0. Offers a
  /// lesson once each time that the body meets its cause.
  [[nodiscard]] std::optional<Lesson> watch(const Walker& walker, const Vec3& wish, double seconds);

  /// Gives the size to the walker and the profile. After a fall, puts the walker back to the place where it last stood
  /// firmly. Throws roam::Error for a size that the walker may not have.
  void take(Walker& walker, const Lesson& lesson);

  [[nodiscard]] const Profile& profile() const { return profile_; }
  /// Whether profile() changed since saved().
  [[nodiscard]] bool changed() const { return changed_; }
  void saved() { changed_ = false; }

 private:
  [[nodiscard]] std::optional<Lesson> narrower(const Walker& walker, const Vec3& wish) const;
  [[nodiscard]] std::optional<Lesson> support(const Walker& walker) const;

  Profile profile_;
  double pushed_ = 0.0;     ///< s without getting on
  bool offered_ = false;    ///< since it began to push, or to fall
  bool firm_ = false;       ///< has stood firmly, on floor under its axis: then where
  Vec3 firm_at_{0.0};       ///< centre, metres
  double firm_feet_ = 0.0;  ///< z of the lowest point there, metres
  bool lost_ = false;       ///< has not stood firmly since: then where that began
  Vec3 lost_at_{0.0};       ///< centre, metres
  bool changed_ = false;
};

}  // namespace roam
