#include "roam/walker.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <string>

#include "math/floating_point.h"
#include "motion/crouch.h"
#include "motion/ground.h"
#include "motion/recovery.h"
#include "motion/sizes.h"
#include "motion/slide.h"
#include "motion/walking.h"
#include "roam/error.h"
#include "text/number.h"

namespace roam {
namespace {

/// The skin of a lossless world, metres: a thousand times what rounding moves a body at 6.4e6 m, and less than anybody
/// sees.
constexpr double least_skin = 1e-4;

/// Pieces of one flight among regions: each half a radius.
constexpr int flight_limit = 4096;

bool finite(const Vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

/// Where a body that does not fit at `place` is freed to.
std::optional<Vec3> way_out(const Space& space, const Body& body, const Vec3& place, double skin) {
  return walking::nearest_free(space, body, place, body.height(), skin, walking::Way::checked);
}

}  // namespace

Walker::Walker(const Space& space, const WalkerSettings& settings, Mode mode, const Vec3& start)
    : space_(&space),
      given_(settings),
      settings_(settings),
      outside_{settings.radius, settings.support_radius},
      mode_(mode) {
  const DefaultFloatingPoint guard;
  check(settings);
  skin_ = least_skin + 2.0 * space.largest_error();
  slope_cosine_ = std::cos(settings.slope_degrees * (std::numbers::pi / 180.0));
  place(start);
}

Body Walker::body() const {
  const DefaultFloatingPoint guard;
  return Body::capsule(settings_.radius, height_);
}

Vec3 Walker::feet() const {
  const DefaultFloatingPoint guard;
  return position_ - Vec3(0.0, 0.0, 0.5 * height_);
}

Vec3 Walker::eye() const {
  const DefaultFloatingPoint guard;
  return feet() + Vec3(0.0, 0.0, settings_.eye * (height_ / settings_.height));
}

Vec3 Walker::velocity() const {
  const DefaultFloatingPoint guard;
  Vec3 way(0.0), at = report_.from;
  for (const Corner& c : report_.corners) {
    if (!c.teleport) way += c.position - at;
    at = c.position;
  }
  return report_.elapsed > 0.0 ? way / report_.elapsed : Vec3(0.0);
}

/// The wish, no faster than the space can follow.
WalkerInput Walker::slowed(const WalkerInput& input) {
  const double limit = space_->facts().speed_limit, speed = glm::length(input.velocity);
  WalkerInput out = input;
  if (speed > limit) {
    out.velocity *= limit / speed;
    report_.events.push({EventKind::slowed, position_});
  }
  return out;
}

walking::Move Walker::under_way() {
  walking::Move m(*space_, vicinity_, settings_, report_, skin_, slope_cosine_, position_, height_, known_);
  m.time = report_.elapsed;
  return m;
}

void Walker::come_to(const walking::Move& m) {
  position_ = m.place;
  height_ = m.height;
  known_ = m.known;
}

void Walker::begin() {
  const std::optional<std::uint64_t> revision = space_->facts().revision;
  if (!revision || *revision != known_at_) known_.forget();
  known_.touching = !report_.contacts.empty();
  known_.unproven = known_.came_upon = false;
  known_at_ = revision.value_or(0);
  report_.corners.clear();
  report_.contacts.clear();
  report_.events.clear();
  report_.from = position_;
  report_.elapsed = 0.0;
  report_.landing_speed = 0.0;
  report_.blocked = report_.held = report_.put_back = report_.met_unknown = false;
}

void Walker::finish() {
  report_.to = position_;
  report_.held = held_;
  report_.height = height_;
  report_.radius = settings_.radius;
  report_.grounded = stance_.grounded;
  report_.carried = stance_.carried;
  if (mode_ == Mode::ghost) {
    known_.forget_place();
  } else if (!known_.fresh || (known_.over_way && position_ == report_.from)) {
    // Who rests is told the clearance of the place once, and no more that of the way there. Who is held has one, too,
    // where it fits: over nothing to stand on.
    walking::Move m = under_way();
    m.measure();
    come_to(m);
  }
  report_.clearance = report_.least_clearance = known_.clearance;
  report_.least_gap = known_.clearance - settings_.radius;
  report_.met_unknown |= waits_ || (stance_.grounded && stance_.unknown);
  if (report_.met_unknown) report_.events.push({EventKind::met_unknown, position_});
  for (const Corner& c : report_.corners) {
    if (c.teleport) continue;
    report_.least_clearance = std::min(report_.least_clearance, c.clearance);
    report_.least_gap = std::min(report_.least_gap, c.clearance - c.radius);
  }
}

Walker::Refuge Walker::here() const { return {position_, height_, {settings_.radius, settings_.support_radius}}; }

void Walker::remember_safe() { safe_ = here(); }

void Walker::put(const Vec3& place, double time) {
  position_ = place;
  known_.forget();
  const Corner corner{position_, height_, settings_.radius, time, 0.0, true};
  // Where it was put before, and did not fit, it was not.
  if (!report_.corners.empty() && report_.corners.back().teleport) {
    report_.corners.back() = corner;
  } else {
    report_.corners.push(corner);
  }
}

void Walker::hold() {
  held_ = report_.held = true;
  waits_ = in_unknown();
  stance_ = {};
  report_.events.push({EventKind::held, position_});
}

void Walker::release() { held_ = waits_ = footless_ = over_nothing_ = was_put_back_ = false; }

bool Walker::embedded() const { return space_->clearance(body(), position_, 0.0).distance < -walking::world_tolerance; }

bool Walker::in_unknown() const { return space_->clearance(body(), position_, 0.0).unknown; }

void Walker::look_again() {
  const std::uint64_t now = space_->facts().revision.value_or(0);
  const bool changed = now != looked_at_ || resized_;
  looked_at_ = now;
  resized_ = false;
  if (!held_) {
    // Something may have come where it is.
    if (embedded()) fit_in();
    return;
  }
  const bool over_nothing = over_nothing_ && !walking::above_ground(*space_, body(), position_);
  const bool goes_on = changed || (waits_ && !in_unknown()) || over_nothing_;
  if (over_nothing || !goes_on) return hold();
  release();
  take_size_here();
  fit_in();
  if (!held_) remember_safe();
}

void Walker::fit_in() {
  if (space_->fits(body(), position_)) return;
  const double low = walking::crouched_height(settings_);
  const Vec3 lowered = position_ - Vec3(0.0, 0.0, 0.5 * (height_ - low));
  const auto fits_low = [&](const Vec3& place) {
    return mode_ == Mode::walk && low < height_ && space_->fits(Body::capsule(settings_.radius, low), place);
  };
  const auto crouch_at = [&](const Vec3& place) {
    height_ = low;
    put(place, report_.elapsed);
    report_.events.push({EventKind::crouched, position_});
  };
  if (fits_low(lowered)) return crouch_at(lowered);
  // The centre may be that of a body that crouched.
  if (fits_low(position_) && !way_out(*space_, body(), position_, skin_)) return crouch_at(position_);
  free_body();
}

void Walker::free_body() {
  known_.forget();
  const std::optional<Vec3> free = way_out(*space_, body(), position_, skin_);
  if (!free) return hold();
  // Put exactly in touch, a body is a hair too near: that is set right without a word.
  const bool worth_saying = glm::length(*free - position_) > 2.0 * skin_ + walking::hit_tolerance;
  put(*free, report_.elapsed);
  if (worth_saying) report_.events.push({EventKind::freed, position_});
}

void Walker::settle() {
  if (mode_ != Mode::walk || held_) return;
  walking::Move m = under_way();
  walking::keep_ground(m, stance_, 0.0);
  come_to(m);
  if (stance_.grounded || !(safe_.height > 0.0)) remember_safe();
}

const StepReport& Walker::step(const WalkerInput& input, double dt) {
  const DefaultFloatingPoint guard;
  if (!finite(input.velocity)) throw Error("the wished velocity is not a finite vector");
  if (!(dt >= 0.0) || !std::isfinite(dt)) {
    throw Error("the time step is " + number_text(dt) + " s; it must be finite and not negative");
  }
  begin();
  if (mode_ == Mode::ghost) {
    const Vec3 motion = input.velocity * dt;
    position_ += motion;
    known_.forget();
    if (motion != Vec3(0.0)) report_.corners.push({position_, height_, settings_.radius, dt, 0.0, false});
    if (space_->fits(body(), position_)) {
      remember_safe();
      if (walking::above_ground(*space_, body(), position_)) footing_ = safe_;
    }
  } else {
    const bool changed = space_->facts().revision.value_or(0) != looked_at_;
    // A way that is found free, from where the body is, proves that nothing has come there.
    const Vec3 wish(input.velocity.x, input.velocity.y, mode_ == Mode::fly ? input.velocity.z : 0.0);
    known_.unproven = !held_ && changed && wish * dt != Vec3(0.0);
    if (known_.unproven) {
      looked_at_ = space_->facts().revision.value_or(0);
      resized_ = false;
    } else if (held_ || changed) {
      look_again();
    }
    if (!held_) move(slowed(input), dt);
    if (known_.unproven && embedded()) fit_in();
    known_.unproven = false;
  }
  if (!report_.has(EventKind::throttled)) report_.elapsed = dt;
  finish();
  return report_;
}

void Walker::move(const WalkerInput& input, double dt) {
  walking::Ending end = move_for(input, dt);
  if (end == walking::Ending::embedded) {
    if (known_.came_upon) {
      fit_in();
    } else {
      free_body();
    }
    if (!held_) end = move_for(input, dt - report_.elapsed);
  }
  if (end == walking::Ending::throttled) report_.events.push({EventKind::throttled, position_});
  if (end == walking::Ending::bottomless) put_back();
  if (mode_ == Mode::fly && !held_) remember_safe();
}

walking::Ending Walker::move_for(const WalkerInput& input, double dt) {
  walking::Move m = under_way();
  const bool walking = mode_ == Mode::walk;
  if (walking && input.crouch) {
    walking::crouch(m);
  } else {
    walking::stand_up(m);
  }
  walking::Ending end = walking::Ending::done;
  if (walking) {
    if (input.jump) walking::jump(m, stance_);
    const Vec3 horizontal(input.velocity.x, input.velocity.y, 0.0);
    end = walking::walk(m, stance_, horizontal, dt, {safe_.place, safe_.height, safe_.size}, sizes());
  } else {
    end = fly(m, input.velocity, dt);
  }
  come_to(m);
  report_.elapsed = m.time;
  return end;
}

walking::Sizes Walker::sizes() { return {given_, outside_, regions_, inside_, settings_}; }

/// The size that is wanted where the body is, as if it had been put there.
void Walker::take_size_here() {
  known_.forget_place();
  std::fill(inside_.begin(), inside_.end(), char{0});
  settings_ = walking::sized(given_, outside_);
  const Vec3 lowest = position_ - Vec3(0.0, 0.0, 0.5 * settings_.height);
  settings_ = walking::sized(given_, walking::wanted(sizes(), position_, lowest));
  height_ = settings_.height;
}

walking::Ending Walker::fly(walking::Move& m, const Vec3& velocity, double dt) {
  const walking::Sizes sizes = this->sizes();
  if (!walking::near_region(sizes, m, velocity * dt)) return walking::slide(m, velocity, dt);
  const double end = m.time + dt, speed = glm::length(velocity);
  for (int count = 0; count < flight_limit && m.has_room(); ++count) {
    walking::adapt(m, stance_, sizes);
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

void Walker::set_regions(std::span<const SizeRegion> regions) {
  const DefaultFloatingPoint guard;
  check(regions, given_);
  std::vector<SizeRegion> copies(regions.begin(), regions.end());
  std::vector<char> inside(regions.size(), char{0});
  regions_.swap(copies);
  inside_.swap(inside);
  resized_ = true;
}

bool Walker::resize(double radius, double support_radius) {
  const DefaultFloatingPoint guard;
  check(walking::sized(given_, {radius, support_radius}));
  begin();
  outside_ = {radius, support_radius};
  resized_ = true;
  const walking::Sizes sizes = this->sizes();
  if (mode_ != Mode::ghost && !held_) {
    walking::Move m = under_way();
    walking::adapt(m, stance_, sizes);
    come_to(m);
    // The new body may fit where something came upon the old one.
    if (space_->facts().revision.value_or(0) != looked_at_) look_again();
    resized_ = true;
  }
  finish();
  return walking::wanted(sizes, position_, feet()) == walking::Size{settings_.radius, settings_.support_radius};
}

const StepReport& Walker::place(const Vec3& centre) { return placed(centre, 0.0); }

const StepReport& Walker::place_feet(const Vec3& feet) { return placed(feet, 0.5); }

/// `lift`: how far the centre lies above `at`, part of the height.
const StepReport& Walker::placed(const Vec3& at, double lift) {
  const DefaultFloatingPoint guard;
  if (!finite(at)) throw Error("the place to put the walker to is not a finite point");
  begin();
  const double height = walking::sized(given_, outside_).height;
  position_ = at + Vec3(0.0, 0.0, lift * height);
  take_size_here();
  stance_ = {};
  known_ = {};
  vicinity_.forget();
  release();
  safe_.height = footing_.height = 0.0;
  looked_at_ = space_->facts().revision.value_or(0);
  put(at + Vec3(0.0, 0.0, lift * height_), 0.0);
  report_.events.push({EventKind::placed, position_});
  if (mode_ != Mode::ghost) fit_in();
  if (!held_ && space_->fits(body(), position_)) remember_safe();
  settle();
  known_.forget_place();  // what is told is the clearance there, wherever the body came from
  finish();
  return report_;
}

}  // namespace roam
