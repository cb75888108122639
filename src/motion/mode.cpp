// Changing the mode, and coming back from ghost mode.

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "motion/recovery.h"
#include "motion/sizes.h"
#include "roam/walker.h"

namespace roam {

const StepReport& Walker::set_mode(Mode mode) {
  begin();
  const Mode before = mode_;
  mode_ = mode;
  if (mode == Mode::ghost) release();
  if (mode != before) stance_ = {};
  if (before == Mode::ghost && mode != Mode::ghost && !sizes().settled()) {
    const double lowest = feet().z;
    take_size_here();
    put({position_.x, position_.y, lowest + 0.5 * height_}, 0.0);
  }
  if (before == Mode::ghost && mode != Mode::ghost && !walking::fits(*space_, body(), position_)) come_back();
  // Something may have come where it is, of which no step has told yet.
  if (before != Mode::ghost && mode != Mode::ghost) look_again();
  if (mode != before) settle();
  if (held_ && !report_.held) hold();
  finish();
  return report_;
}

void Walker::come_back() {
  const bool known = safe_height_ > 0.0;
  const double to_safe = known ? glm::length(safe_ - position_) : height_;
  const std::optional<Vec3> near =
      walking::nearest_free(*space_, body(), position_, std::min(height_, to_safe), skin_, walking::Way::any);
  if (near) {
    put(*near, 0.0);
    report_.events.push({EventKind::returned, position_});
  } else if (known) {
    settings_ = walking::sized(given_, safe_size_);
    height_ = safe_height_;
    put(safe_, 0.0);
    report_.events.push({EventKind::returned, position_});
    if (embedded()) free_body();  // the space may have changed since
  } else {
    hold();
  }
}

}  // namespace roam
