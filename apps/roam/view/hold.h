#pragma once
/// \file
/// The reason why the body is held, in words.

#include <optional>
#include <string>

#include "roam/walker.h"

namespace roam::app {

/// A sentence for the display.
struct Told {
  std::string text;  ///< empty: nothing to show
  bool warning = false;
};

/// Observes the steps of a walker. A short event is shown for some seconds, and a state that changes from step to step
/// is smoothed. Openings are measured occasionally, not in every step.
class Hold {
 public:
  /// Call it after each step and each placement. `wish`: the desired velocity (m/s; length 0: none). `seconds`: the
  /// time of the step. `failing`: some unknown tiles cannot be read; the sentence then gives the reason.
  void take(const Walker& walker, const Vec3& wish, double seconds, bool failing = false);
  /// `coming`: the tiles that a body waits for, or slows down for; empty: only that it does.
  [[nodiscard]] Told told(const std::string& coming = {}) const;

 private:
  void note_events(const Walker& walker);
  void note_unknown(const Walker& walker, bool failing);
  void look_at_blockage(const Walker& walker, const Vec3& wish, double seconds);
  void look_above(const Walker& walker);

  double now_ = 0.0;            ///< s of all steps
  bool held_ = false;           ///< see Walker::held
  bool nothing_below_ = false;  ///< held because nothing is known to be below
  bool waiting_ = false;
  std::string reason_;         ///< why the awaited tiles do not come; empty: they will
  double slowed_at_ = -1e9;    ///< time of the last slowed step
  double blocked_for_ = 0.0;   ///< s without a break
  double blocked_at_ = -1e9;   ///< time of the last blocked step
  double measured_at_ = -1e9;  ///< time of the last measurement of the opening
  std::string blockage_;
  double looked_above_at_ = -1e9;  ///< time of the last measurement above a crouched body
  std::string above_;              ///< why a crouched body cannot stand; empty: it can, or stands
  Told news_;
  double news_at_ = -1e9;
  double level_ = 0.0;  ///< z of the ground last stood on
};

}  // namespace roam::app
