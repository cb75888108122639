// Changing the mode, and coming back: from ghost mode, and from below the scene.

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "math/floating_point.h"
#include "motion/recovery.h"
#include "motion/sizes.h"
#include "roam/walker.h"

namespace roam {

const StepReport& Walker::set_mode(Mode mode) {
  const DefaultFloatingPoint guard;
  begin();
  const Mode before = mode_;
  mode_ = mode;
  if (mode == Mode::ghost || (footless_ && mode != Mode::walk)) release();
  if (before == Mode::walk && mode != before && stance_.stood) footing_ = safe_;
  if (mode != before) stance_ = {};
  if (before == Mode::ghost && mode != Mode::ghost && !sizes().settled()) {
    const double lowest = feet().z;
    take_size_here();
    put({position_.x, position_.y, lowest + 0.5 * height_}, 0.0);
  }
  if (before == Mode::ghost && mode != Mode::ghost) come_back();
  // Something may have come where it is, of which no step has told yet.
  if (before != Mode::ghost && mode != Mode::ghost) look_again();
  if (mode != before) settle();
  if (held_ && !report_.held) hold();
  finish();
  return report_;
}

void Walker::come_back() {
  const bool fits = space_->fits(body(), position_);
  if (mode_ == Mode::walk) {
    if (fits && walking::above_ground(*space_, body(), position_)) return;
    if (come_back_to(footing_, true)) return;
  }
  // Where there is no ground it falls, and is put back.
  if (!fits && !come_back_to(safe_, false)) hold();
}

bool Walker::come_back_to(const Refuge& refuge, bool ground) {
  const bool known = ground ? over_ground(refuge) : refuge.height > 0.0;
  const double to_refuge = known ? glm::length(refuge.place - position_) : height_;
  const std::optional<Vec3> near =
      walking::nearest_free(*space_, body(), position_, std::min(height_, to_refuge), skin_, walking::Way::any,
                            ground ? walking::Below::ground : walking::Below::anything);
  if (!near && !known) return false;
  if (near) {
    put(*near, 0.0);
  } else {
    settings_ = walking::sized(given_, refuge.size);
    height_ = refuge.height;
    put(refuge.place, 0.0);
  }
  report_.events.push({EventKind::returned, position_});
  if (!near && embedded()) free_body();  // the space may have changed since
  return true;
}

bool Walker::over_ground(const Refuge& refuge) const {
  return refuge.height > 0.0 &&
         walking::above_ground(*space_, Body::capsule(refuge.size.radius, refuge.height), refuge.place);
}

void Walker::put_back() {
  const bool has_stood = stance_.stood;
  if (!over_ground(safe_) && over_ground(footing_)) safe_ = footing_;
  settings_ = walking::sized(given_, safe_.size);
  height_ = safe_.height;
  stance_ = {};
  put(safe_.place, report_.elapsed);
  report_.events.push({EventKind::put_back, position_});
  report_.put_back = true;
  if (embedded()) free_body();  // the space may have changed since
  settle();
  if (held_ || stance_.grounded) return;
  over_nothing_ = !walking::above_ground(*space_, body(), position_);
  footless_ = over_nothing_ || (was_put_back_ && !has_stood);
  was_put_back_ = true;
  if (footless_) hold();
}

}  // namespace roam
