#pragma once
/// \file
/// Learning the size of a body while it roams, where training has not said everything (or nothing).
///
///     roam::SizeLearner learner(profile, {.radius_min = 0.2});
///     for (;;) {
///       walker.step(input, dt);
///       if (const auto lesson = learner.watch(walker, input.velocity, dt)) {
///         std::cout << "an opening or a gap " << lesson->width << " m wide\n";
///         learner.take(walker, *lesson);          // or do not: it is an offer
///       }
///     }
///     roam::save_profile(learner.profile(), roam::profile_path("dam.ply"));
///
/// Two things are learned, the two of the paper's figure 6 where they are met and no earlier: *cannot enter*, so the
/// body becomes smaller at that opening and nowhere else; *flies off*, so the foot becomes larger, everywhere. A lesson
/// is only offered when it has been tried: the smaller body has a certified way through the opening, and a Walker with
/// the larger foot has gone to where the body lost the ground, and is carried there. Nothing that is learned lets a
/// body violate what Walker promises.
///
/// From one thread at a time, the one that moves the body; watch() allocates only when it has a lesson. Library target
/// roam::profile.

#include <cstdint>
#include <optional>

#include "roam/profile.h"
#include "roam/walker.h"

namespace roam {

/// What a body could do about what stopped it.
struct Lesson {
  enum class Kind : std::uint8_t {
    narrower,  ///< a smaller body in a region
    support,   ///< a larger foot, everywhere
  };
  Kind kind = Kind::narrower;
  Vec3 at{0.0};                 ///< the middle of the opening, or of the body where it fell, metres
  SizeRegion region;            ///< of a narrower body: where, and its size
  double support_radius = 0.0;  ///< of a larger foot, metres
  double width = 0.0;           ///< of the opening, or of the gap of the floor, metres
};

struct LearnLimits {
  double radius_min = 0.15;  ///< m: no smaller body is offered
  double support_max = 1.0;  ///< m: no larger foot is offered
  double patience = 0.5;     ///< s that a body pushes against an opening before it is looked at
};

class SizeLearner {
 public:
  /// Goes on from what is known: `known`, whose radius and support_radius are those of the walker outside all regions.
  /// Throws roam::Error for a radius or limits out of range.
  explicit SizeLearner(Profile known, const LearnLimits& limits = {});

  /// After each step, and after placing (with 0 seconds). `wish` is the velocity that was wished for, m/s. The same
  /// lesson is offered once while it lasts; it comes again when the body comes again.
  [[nodiscard]] std::optional<Lesson> watch(const Walker& walker, const Vec3& wish, double seconds);

  /// The walker gets the size, and the profile holds it. After a fall it is put back to where it last stood firmly.
  void take(Walker& walker, const Lesson& lesson);

  [[nodiscard]] const Profile& profile() const { return profile_; }
  /// Whether something was learned since saved().
  [[nodiscard]] bool changed() const { return changed_; }
  void saved() { changed_ = false; }

 private:
  [[nodiscard]] std::optional<Lesson> narrower(const Walker& walker, const Vec3& wish) const;
  [[nodiscard]] std::optional<Lesson> support(const Walker& walker) const;

  Profile profile_;
  LearnLimits limits_;
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
