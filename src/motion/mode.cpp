// Changes of the mode, and returns: from ghost mode, and from below the scene.

#include <algorithm>
#include <glm/geometric.hpp>
#include <optional>

#include "motion/recovery.h"
#include "motion/state.h"

namespace roam {

const StepReport& Walker::State::set_mode(Mode mode) {
  in_the_end_ = pace();
  begin();
  const Mode before = mode_;
  mode_ = mode;
  const bool falls = hold_ == walking::Hold::no_ground || hold_ == walking::Hold::over_nothing;
  if (mode == Mode::ghost || (falls && mode != Mode::walk)) release();
  if (before == Mode::walk && mode != before && gait_.level.has_value()) ground_ = safe_;
  if (mode != before) {
    gait_ = {};
    ride_ = {};
  }
  if (before == Mode::ghost && mode != Mode::ghost && !sizes().settled()) {
    const double lowest = feet().z;
    take_size_here();
    put({at_.place.x, at_.place.y, lowest + 0.5 * at_.height}, 0.0);
  }
  if (before == Mode::ghost && mode != Mode::ghost) come_back();
  // Something may have come to its position that no step has reported yet.
  if (before != Mode::ghost && mode != Mode::ghost) look_again();
  if (mode != before) settle();
  if (held() && !report_.held) hold(hold_);
  finish();
  return report_;
}

void Walker::State::come_back() {
  const bool fits = space_->fits(body(), at_.place);
  if (mode_ == Mode::walk) {
    if (fits && walking::above_ground(*space_, body(), at_.place)) return;
    if (come_back_to(ground_, true)) return;
  }
  // If there is no ground, the body falls and is put back.
  if (!fits && !come_back_to(safe_, false)) hold(walking::Hold::embedded);
}

bool Walker::State::come_back_to(const walking::Refuge& refuge, bool ground) {
  const bool known = ground ? over_ground(refuge) : refuge.height > 0.0;
  const double to_refuge = known ? glm::length(refuge.place - at_.place) : at_.height;
  const std::optional<Vec3> near =
      walking::nearest_free(*space_, body(), at_.place, std::min(at_.height, to_refuge), skin_, walking::Way::any,
                            ground ? walking::Below::ground : walking::Below::anything);
  if (!near && !known) return false;
  if (near) {
    put(*near, 0.0);
  } else {
    settings_ = walking::sized(given_, refuge.size);
    at_.height = refuge.height;
    put(refuge.place, 0.0);
  }
  report_.events.push({EventKind::returned, at_.place});
  if (!near && embedded()) free_body();  // the space may have changed since
  return true;
}

bool Walker::State::over_ground(const walking::Refuge& refuge) const {
  return refuge.height > 0.0 &&
         walking::above_ground(*space_, Body::capsule(refuge.size.radius, refuge.height), refuge.place);
}

void Walker::State::put_back() {
  const bool has_stood = gait_.level.has_value();
  if (!over_ground(safe_) && over_ground(ground_)) safe_ = ground_;
  settings_ = walking::sized(given_, safe_.size);
  at_.height = safe_.height;
  gait_ = {};
  put(safe_.place, report_.elapsed);
  report_.events.push({EventKind::put_back, at_.place});
  report_.put_back = true;
  if (embedded()) free_body();  // the space may have changed since
  settle();
  if (held() || gait_.grounded()) return;
  const bool fell_before = was_put_back_ && !has_stood;
  was_put_back_ = true;
  if (!walking::above_ground(*space_, body(), at_.place)) {
    hold(walking::Hold::over_nothing);
  } else if (fell_before) {
    hold(walking::Hold::no_ground);
  }
}

}  // namespace roam
