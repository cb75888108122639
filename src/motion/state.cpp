#include "motion/state.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <utility>

#include "math/finite.h"
#include "math/largest.h"
#include "motion/crouch.h"
#include "motion/ground.h"
#include "motion/pace.h"
#include "motion/recovery.h"
#include "motion/slide.h"
#include "roam/error.h"
#include "text/number.h"

namespace roam {
namespace {

/// Metres. The skin of a lossless world: a thousand times the rounding at 6.4e6 m, and too small to be seen.
constexpr double least_skin = 1e-4;

/// m/s. A faster wish counts as this one in the same direction: its square is finite, and no step can tell them apart.
constexpr double fastest_wish = 1e100;
/// m: a shorter way proves nothing. The square of one far shorter would be 0.
constexpr double least_proof = 1e-12;

/// Greatest number of pieces of one flight among regions, each half a radius long.
constexpr int flight_limit = 4096;

/// The position to which a body that does not fit at `place` is freed.
std::optional<Vec3> way_out(const Space& space, const Body& body, const Vec3& place, double skin) {
  return walking::nearest_free(space, body, place, body.height(), skin, walking::Way::checked);
}

/// Metres. A body put exactly in touch is too near by a rounding; this much is corrected without an event.
double correction(double skin) { return 2.0 * skin + walking::hit_tolerance; }

}  // namespace

Walker::State::State(const Space& space, const WalkerSettings& settings, Mode mode)
    : space_(&space),
      given_(settings),
      settings_(settings),
      outside_{settings.radius, settings.support_radius},
      skin_(least_skin + 2.0 * space.largest_error()),
      slope_cosine_(std::cos(settings.slope_degrees * (std::numbers::pi / 180.0))),
      mode_(mode) {}

Body Walker::State::body() const { return Body::capsule(settings_.radius, at_.height); }

Vec3 Walker::State::feet() const { return at_.place - Vec3(0.0, 0.0, 0.5 * at_.height); }

/// Limits the wish to the space's speed limit.
void Walker::State::slow_down(WalkerInput& input) {
  const double limit = space_->facts().speed_limit, speed = glm::length(input.velocity);
  if (!(speed > limit)) return;
  input.velocity *= limit / speed;
  report_.events.push({EventKind::slowed, at_.place});
}

walking::Move Walker::State::under_way() {
  return {{*space_, vicinity_, settings_, report_, skin_, slope_cosine_, was_blocked_}, at_};
}

void Walker::State::begin() {
  const std::optional<std::uint64_t> revision = space_->facts().revision;
  if (!revision || *revision != known_at_) at_.known.forget();
  at_.known.touching = !report_.contacts.empty();
  at_.known.fit = walking::Fit::known;
  known_at_ = revision.value_or(0);
  riding_ = Vec3(0.0);
  report_.segments.clear();
  report_.contacts.clear();
  report_.events.clear();
  report_.from = at_.place;
  report_.elapsed = 0.0;
  report_.landing_speed = 0.0;
  report_.blocked = report_.held = report_.put_back = report_.met_unknown = false;
}

void Walker::State::finish() {
  report_.to = at_.place;
  report_.held = held();
  report_.height = at_.height;
  report_.radius = settings_.radius;
  report_.grounded = gait_.grounded();
  report_.bridging = gait_.footing == Footing::disc;
  report_.ground_velocity = gait_.ground_velocity;
  if (mode_ == Mode::ghost) {
    at_.known.forget_place();
  } else if (at_.known.measured == walking::Measured::nothing ||
             (at_.known.measured == walking::Measured::way && at_.place == report_.from)) {
    // A resting body reports the clearance of its position, and not that of the way there. A held body has a clearance
    // too if it fits: it is over nothing to stand on.
    walking::Move m = under_way();
    m.measure();
    at_ = m;
  }
  report_.axis_clearance = report_.least_axis_clearance = at_.known.clearance;
  report_.least_gap = at_.known.clearance - settings_.radius;
  report_.met_unknown |= hold_ == walking::Hold::waits || gait_.unknown;
  if (report_.met_unknown) report_.events.push({EventKind::met_unknown, at_.place});
  for (const Segment& c : report_.segments) {
    if (c.teleport) continue;
    report_.least_axis_clearance = std::min(report_.least_axis_clearance, c.axis_clearance);
    report_.least_gap = std::min(report_.least_gap, c.axis_clearance - c.radius);
  }
}

walking::Refuge Walker::State::here() const {
  return {at_.place, at_.height, {settings_.radius, settings_.support_radius}};
}

void Walker::State::remember_safe() { safe_ = here(); }

void Walker::State::put(const Vec3& place, double time) {
  at_.place = place;
  at_.known.forget();
  const Segment segment{at_.place, at_.height, settings_.radius, time, 0.0, true};
  // A position to which it was put before, and where it did not fit, is replaced.
  if (!report_.segments.empty() && report_.segments.back().teleport) {
    report_.segments.back() = segment;
  } else {
    report_.segments.push(segment);
  }
}

void Walker::State::hold(walking::Hold why) {
  using walking::Hold;
  const bool falls = why == Hold::no_ground || why == Hold::over_nothing;
  hold_ = falls ? why : in_unknown() ? Hold::waits : Hold::embedded;
  report_.held = true;
  gait_ = {};
  report_.events.push({EventKind::held, at_.place});
}

void Walker::State::release() {
  hold_ = walking::Hold::none;
  was_put_back_ = false;
}

bool Walker::State::may_have_changed() const {
  const std::optional<std::uint64_t> now = space_->facts().revision;
  return !now || *now != looked_at_;
}

bool Walker::State::embedded() const {
  return space_->clearance(body(), at_.place, 0.0).distance < -walking::world_tolerance;
}

bool Walker::State::in_unknown() const { return space_->clearance(body(), at_.place, 0.0).unknown; }

void Walker::State::look_again() {
  const std::uint64_t now = revision();
  const bool changed = now != looked_at_ || resized_;
  looked_at_ = now;
  resized_ = false;
  bool stays = !changed;
  switch (hold_) {
    case walking::Hold::none:
      // Something may have come to its position.
      if (embedded()) fit_in();
      return;
    case walking::Hold::waits:
      stays = stays && in_unknown();
      break;
    case walking::Hold::over_nothing:
      stays = !walking::above_ground(*space_, body(), at_.place);
      break;
    case walking::Hold::embedded:
      stays = stays && !may_have_changed();  // in a space without revision it may, at any time
      break;
    case walking::Hold::no_ground:
      break;
  }
  if (stays) return hold(hold_);
  release();
  take_size_here();
  fit_in();
  if (!held()) remember_safe();
}

void Walker::State::fit_in() {
  if (space_->fits(body(), at_.place)) return;
  const std::optional<Vec3> free = way_out(*space_, body(), at_.place, skin_);
  if (free && glm::length(*free - at_.place) <= correction(skin_)) return free_to(free);
  const double low = walking::crouched_height(settings_);
  const Vec3 lowered = at_.place - Vec3(0.0, 0.0, 0.5 * (at_.height - low));
  if (crouch_at(lowered)) return;
  // The centre may be that of a crouched body.
  if (!free && crouch_at(at_.place)) return;
  free_to(free);
}

bool Walker::State::crouch_at(const Vec3& place) {
  const double low = walking::crouched_height(settings_);
  if (mode_ != Mode::walk || !(low < at_.height)) return false;
  const Body body = Body::capsule(settings_.radius, low);
  std::optional<Vec3> at = place;
  if (!space_->fits(body, place)) {
    at = walking::nearest_free(*space_, body, place, correction(skin_), skin_, walking::Way::checked);
  }
  if (!at) return false;
  at_.height = low;
  put(*at, report_.elapsed);
  report_.events.push({EventKind::crouched, at_.place});
  return true;
}

void Walker::State::free_body() { free_to(way_out(*space_, body(), at_.place, skin_)); }

void Walker::State::free_to(const std::optional<Vec3>& free) {
  at_.known.forget();
  if (!free) return hold(walking::Hold::embedded);
  const bool worth_saying = glm::length(*free - at_.place) > correction(skin_);
  put(*free, report_.elapsed);
  if (worth_saying) report_.events.push({EventKind::freed, at_.place});
}

void Walker::State::settle() {
  if (mode_ != Mode::walk || held()) return;
  walking::Move m = under_way();
  walking::keep_ground(m, gait_, 0.0);
  at_ = m;
  if (gait_.grounded() || !(safe_.height > 0.0)) remember_safe();
}

const StepReport& Walker::State::step(const WalkerInput& wish, double dt) {
  if (!is_finite(wish.velocity)) throw Error("the wished velocity is not a finite vector");
  if (!(dt >= 0.0) || !std::isfinite(dt)) {
    throw Error("the time step is " + number_text(dt) + " s; it must be finite and not negative");
  }
  if (!(wish.acceleration > 0.0 && wish.braking > 0.0)) {
    throw Error("the wish accelerates by at most " + number_text(wish.acceleration) + " m/s^2 and brakes by at most " +
                number_text(wish.braking) + " m/s^2; both must be more than 0");
  }
  WalkerInput input = wish;
  if (mode_ == Mode::walk) input.velocity.z = 0.0;
  const double most = largest(input.velocity);
  if (most > fastest_wish) input.velocity *= fastest_wish / most;
  std::optional<walking::Pace> change;
  if (walking::limits(wish)) {
    change = walking::change(pace(), input);
    if (dt > 0.0) input.velocity = change->mean(dt);
  }
  const Vec3 ghost_way = input.velocity * dt;
  if (mode_ == Mode::ghost && !is_within_limit(at_.place + ghost_way)) {
    throw Error("the ghost would leave the space that a body may be in: 1e9 m from the origin in each axis");
  }
  begin();
  if (dt > 0.0) {
    if (ride_.seconds > 0.0) riding_ = ride_.way / ride_.seconds;
    ride_ = {};
  }
  bool is_whole = true;
  if (mode_ == Mode::ghost) {
    at_.place += ghost_way;
    at_.known.forget();
    if (ghost_way != Vec3(0.0)) report_.segments.push({at_.place, at_.height, settings_.radius, dt, 0.0, false});
    if (space_->fits(body(), at_.place)) {
      remember_safe();
      if (walking::above_ground(*space_, body(), at_.place)) ground_ = safe_;
    }
  } else {
    const bool changed = may_have_changed();
    // A free way that starts at the body's position proves that nothing has come there. A change of size before it, in
    // which the centre moves, needs a proof of its own.
    const bool shrinks = (mode_ == Mode::walk && input.crouch && !(at_.height < settings_.height)) || !regions_.empty();
    if (!held() && changed && !shrinks && largest(input.velocity * dt) > least_proof) {
      at_.known.fit = walking::Fit::unproven;
      looked_at_ = revision();
      resized_ = false;
    } else if (held() || changed) {
      look_again();
    }
    if (!held()) {
      slow_down(input);
      is_whole = move(input, dt);
    }
    if (at_.known.fit == walking::Fit::unproven) {
      if (embedded()) fit_in();
      at_.known.fit = walking::Fit::known;
    }
  }
  if (is_whole) report_.elapsed = dt;
  gait_.moved_along = false;
  was_blocked_ = report_.blocked;
  wished_ = input.velocity;
  in_the_end_ = change ? change->velocity(report_.elapsed) : wished_;
  finish();
  return report_;
}

bool Walker::State::move(const WalkerInput& input, double dt) {
  walking::Ending end = move_for(input, dt);
  if (end == walking::Ending::embedded) {
    if (at_.known.fit == walking::Fit::came_upon) {
      fit_in();
    } else {
      free_body();
    }
    if (!held()) end = move_for(input, dt - report_.elapsed);
  }
  if (end == walking::Ending::throttled) report_.events.push({EventKind::throttled, at_.place});
  if (end == walking::Ending::bottomless) put_back();
  if (mode_ == Mode::fly && !held()) remember_safe();
  return end != walking::Ending::throttled;
}

walking::Ending Walker::State::move_for(const WalkerInput& input, double dt) {
  walking::Move m = under_way();
  const bool walking = mode_ == Mode::walk;
  const Vec3 horizontal(input.velocity.x, input.velocity.y, 0.0);
  if (walking && input.crouch) {
    walking::crouch(m);
  } else {
    Vec3 way = walking ? horizontal : input.velocity;
    if (walking && gait_.grounded()) way.z = -glm::dot(gait_.ground, horizontal) / gait_.ground.z;
    walking::stand_up(m, way);
  }
  walking::Ending end = walking::Ending::done;
  if (walking) {
    if (input.jump) walking::jump(m, gait_);
    end = walking::walk(m, gait_, horizontal, dt, safe_, sizes());
  } else {
    end = fly(m, input.velocity, dt);
  }
  at_ = m;
  report_.elapsed = m.time;
  return end;
}

walking::Sizes Walker::State::sizes() { return {given_, outside_, regions_, inside_, settings_}; }

/// Takes the size wanted at the body's position, as if it had been put there.
void Walker::State::take_size_here() {
  at_.known.forget_place();
  std::fill(inside_.begin(), inside_.end(), char{0});
  settings_ = walking::sized(given_, outside_);
  const Vec3 lowest = at_.place - Vec3(0.0, 0.0, 0.5 * settings_.height);
  settings_ = walking::sized(given_, walking::wanted(sizes(), at_.place, lowest));
  at_.height = settings_.height;
}

walking::Ending Walker::State::fly(walking::Move& m, const Vec3& velocity, double dt) {
  const walking::Sizes sizes = this->sizes();
  if (!walking::near_region(sizes, m, velocity * dt)) return walking::slide(m, velocity, dt);
  const double end = m.time + dt, speed = glm::length(velocity);
  for (int count = 0; count < flight_limit && m.has_room(); ++count) {
    walking::adapt(m, gait_, sizes);
    const double left = end - m.time, most = 0.5 * settings_.radius / speed;
    const bool last = !(most < left);
    const walking::Ending ending = walking::slide(m, velocity, last ? left : most);
    if (ending != walking::Ending::done) return ending;
    if (last || report_.blocked) {
      m.time = end;
      return ending;
    }
  }
  return walking::Ending::throttled;
}

void Walker::State::set_regions(std::span<const SizeRegion> regions) {
  check(regions, given_);
  std::vector<SizeRegion> copies(regions.begin(), regions.end());
  std::vector<char> inside(regions.size(), char{0});
  regions_.swap(copies);
  inside_.swap(inside);
  resized_ = true;
}

bool Walker::State::resize(double radius, double support_radius) {
  check(walking::sized(given_, {radius, support_radius}));
  in_the_end_ = pace();
  begin();
  outside_ = {radius, support_radius};
  resized_ = true;
  const walking::Sizes sizes = this->sizes();
  if (mode_ != Mode::ghost && !held()) {
    const bool changed = may_have_changed();
    if (changed && embedded()) {
      take_size_here();  // where its centre is: the new body may fit where something met the old one
    } else {
      walking::Move m = under_way();
      walking::adapt(m, gait_, sizes);
      at_ = m;
    }
    if (changed) look_again();
    resized_ = true;
  }
  finish();
  return walking::wanted(sizes, at_.place, feet()) == walking::Size{settings_.radius, settings_.support_radius};
}

/// `lift`: height of the centre above `at`, as a part of the body's height.
const StepReport& Walker::State::place(const Vec3& at, double lift) {
  const Vec3 centre = at + Vec3(0.0, 0.0, lift * walking::sized(given_, outside_).height);
  if (!is_within_limit(centre)) throw Error("the place to put the walker to is not a point within 1e9 m of the origin");
  begin();
  at_.place = centre;
  take_size_here();
  gait_ = {};
  ride_ = {};
  at_.known = {};
  vicinity_.forget();
  was_blocked_ = false;
  wished_ = in_the_end_ = Vec3(0.0);
  release();
  safe_.height = ground_.height = 0.0;
  looked_at_ = revision();
  put(at + Vec3(0.0, 0.0, lift * at_.height), 0.0);
  report_.events.push({EventKind::placed, at_.place});
  if (mode_ != Mode::ghost) fit_in();
  if (!held() && space_->fits(body(), at_.place)) remember_safe();
  settle();
  at_.known.forget_place();  // the report gives the clearance of the position, wherever the body came from
  finish();
  return report_;
}

}  // namespace roam
