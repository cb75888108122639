#pragma once
/// \file
/// What holds the body, in words.

#include <optional>
#include <string>

#include "roam/walker.h"

namespace roam::app {

/// A sentence for the display.
struct Told {
  std::string text;  ///< empty: nothing to tell
  bool warning = false;
};

/// Watches the steps of a walker. What lasts only a moment is told for some seconds; what changes from step to step is
/// told calmly; openings are measured now and then, not in every step.
class Hold {
 public:
  /// After each step, and after placing. `wish` is the velocity that was wished for (m/s; length 0: none), `seconds`
  /// the time that the step took.
  /// `failing`: some of what is unknown cannot be read, so that it says why.
  void take(const Walker& walker, const Vec3& wish, double seconds, bool failing = false);
  [[nodiscard]] Told told() const;

 private:
  void note_events(const Walker& walker);
  void note_unknown(const Walker& walker, bool failing);
  void look_at_blockage(const Walker& walker, const Vec3& wish, double seconds);

  double now_ = 0.0;            ///< s of all steps
  bool held_ = false;           ///< it cannot move: see Walker::held
  bool nothing_below_ = false;  ///< and that is why it is held
  bool waiting_ = false;
  std::string reason_;         ///< why what is waited for does not come; empty: it will
  double slowed_at_ = -1e9;    ///< when last
  double blocked_for_ = 0.0;   ///< s without a break
  double blocked_at_ = -1e9;   ///< when last
  double measured_at_ = -1e9;  ///< when the opening was
  std::string blockage_;
  Told news_;
  double news_at_ = -1e9;
  double level_ = 0.0;  ///< z of the ground last stood on
};

}  // namespace roam::app
