#include "roam/size_learner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>
#include <utility>

#include "math/floating_point.h"
#include "math/level_distance.h"
#include "math/slope.h"
#include "motion/carrying.h"
#include "roam/opening.h"

namespace roam {
namespace {

/// The offered radius as a part of half the opening's width, which is measured to a few millimetres.
constexpr double room_part = 0.97;
/// Metres by which the support disc exceeds the largest disc that falls through.
constexpr double support_margin = 0.02;
/// Metres: precision to which that disc is measured.
constexpr double disc_precision = 1e-3;
/// Metres below the last firm floor at which a stuck body counts as sunk into something.
constexpr double sunk = 0.02;

/// Part of the radius: a body that moved less has not moved.
constexpr double moved_part = 0.1;
/// Trials of a support disc walk at this speed (m/s), in steps of trial_step seconds, for at most trial_limit steps: a
/// minute.
constexpr double trial_speed = 1.4;
constexpr double trial_step = 1.0 / 60.0;
constexpr int trial_limit = 3600;
/// Metres: a body this close to its target has arrived.
constexpr double arrived = 1e-3;

bool is_sphere(const WalkerSettings& settings) { return settings.height <= 2.0 * settings.radius; }

/// The body with another radius and the same lowest point, and its centre.
struct Placed {
  Body body;
  Vec3 centre{0.0};
};

Placed resized(const Walker& walker, double radius) {
  const double height = is_sphere(walker.settings()) ? 2.0 * radius : walker.body().height();
  const Vec3 feet = walker.feet();
  return {Body::capsule(radius, height), feet + Vec3(0.0, 0.0, 0.5 * height)};
}

/// Whether a body can go sideways until it is in line with `middle`, and then ahead until it is through, with or
/// without a lift by one step. Returns where it ends, or nothing.
std::optional<Vec3> way_through(const Walker& walker, const Placed& small, const Vec3& middle, const Vec3& ahead) {
  const Vec3 sideways(-ahead.y, ahead.x, 0.0);
  const Vec3 aside = sideways * glm::dot(middle - small.centre, sideways);
  const double forward = std::max(0.0, glm::dot(middle - small.centre, ahead)) + 2.0 * walker.body().radius;
  const Space& space = walker.space();
  for (const double lift : {0.0, std::min(walker.settings().step, small.body.height())}) {
    Vec3 place = small.centre;
    bool free = true;
    for (const Vec3& leg : std::array{Vec3(0.0, 0.0, lift), aside, ahead * forward}) {
      free = free && (leg == Vec3(0.0) || !space.first_impact(small.body, place, leg).hit);
      place += leg;
    }
    if (free) return place;
  }
  return std::nullopt;
}

/// Whether there is floor under the axis itself. A rim alone may still carry the body, but shows no plane of the floor.
bool floor_below(const Walker& walker) {
  const double radius = walker.body().radius;
  const double lifted = (radius + walker.skin()) * (1.0 / least_upright(walker.settings().slope_degrees) - 1.0);
  const Vec3 down(0.0, 0.0, -(radius + lifted + 3.0 * walker.skin()));
  const Impact floor = walker.space().ray(walker.feet() + Vec3(0.0, 0.0, radius), down);
  return floor.hit && floor.normal.z >= least_upright(walker.settings().slope_degrees);
}

/// A walker with this support disc, moved straight from `from` until its axis is at `to`. Nothing if it does not
/// arrive, or if its support disc does not carry it there over known floor.
std::optional<Walker> carried_at(const Walker& walker, double support, const Vec3& from, const Vec3& to) {
  WalkerSettings settings = walker.settings();
  settings.support_radius = support;
  Walker trial(walker.space(), settings, Mode::walk, from);
  const Vec3 whole(to.x - from.x, to.y - from.y, 0.0);
  const int most = 2 * static_cast<int>(glm::length(whole) / (trial_speed * trial_step)) + 2;
  for (int i = 0; i < std::min(most, trial_limit); ++i) {
    const Vec3 left(to.x - trial.position().x, to.y - trial.position().y, 0.0);
    const double distance = glm::length(left);
    if (distance < arrived) break;
    trial.step({.velocity = left * (std::min(distance / trial_step, trial_speed) / distance)}, trial_step);
    if (!trial.grounded() || trial.report().has(EventKind::fell)) return std::nullopt;
  }
  const Vec3& end = trial.position();
  const bool there = level_distance(to, end) < arrived;
  if (!there || trial.stance().footing != Footing::disc || trial.stance().unknown) return std::nullopt;
  return trial;
}

bool wishes(const Vec3& wish) { return glm::dot(wish, wish) > 0.0; }

}  // namespace

SizeLearner::SizeLearner(Profile known) : profile_(std::move(known)) {
  const DefaultFloatingPoint guard;
  const WalkerSettings body = apply(profile_, WalkerSettings());
  check(body);
  check(profile_.regions, body);
}

std::optional<Lesson> SizeLearner::watch(const Walker& walker, const Vec3& wish, double seconds) {
  const DefaultFloatingPoint guard;
  const StepReport& report = walker.report();
  const Stance& stance = walker.stance();
  const bool on_foot = walker.mode() == Mode::walk;
  if (walker.mode() == Mode::ghost || report.met_unknown) {
    pushed_ = 0.0;
    return std::nullopt;
  }
  if (on_foot && stance.footing == Footing::ground) {
    lost_ = false;
    const bool moved = !firm_ || glm::length(walker.position() - firm_at_) > moved_part * walker.body().radius;
    if (moved && !report.blocked && floor_below(walker)) {
      firm_ = true;
      firm_at_ = walker.position();
      firm_feet_ = walker.feet().z;
    }
  }
  if (on_foot && firm_ && !stance.firm() && !lost_ && !report.held && !report.put_back) {
    lost_ = true;
    lost_at_ = walker.position();
  }
  const bool fell = on_foot && (report.has(EventKind::fell) || report.put_back);
  pushed_ = report.blocked && wishes(wish) ? pushed_ + seconds : 0.0;
  const bool stuck = pushed_ >= patience;
  if (!fell && !stuck) {
    if (!report.blocked) offered_ = false;
    return std::nullopt;
  }
  if (offered_) return std::nullopt;
  offered_ = true;
  const bool has_sunk = on_foot && firm_ && walker.feet().z < firm_feet_ - sunk && !stance.firm();
  if (fell || has_sunk) {
    if (std::optional<Lesson> lesson = support(walker)) return lesson;
  }
  return fell ? std::nullopt : narrower(walker, wish);
}

std::optional<Lesson> SizeLearner::narrower(const Walker& walker, const Vec3& wish) const {
  const Vec3 flat(wish.x, wish.y, 0.0);
  const double length = glm::length(flat);
  if (!(length > 0.0)) return std::nullopt;
  const Vec3 ahead = flat / length;
  const double radius = walker.body().radius;
  const auto opening = measure_opening(walker, ahead);
  // Low openings are left to crouching.
  if (!opening || opening->kind == Opening::Kind::lintel) return std::nullopt;
  const double fits = room_part * 0.5 * opening->width;
  if (fits >= radius || fits < radius_min) return std::nullopt;
  const Placed small = resized(walker, fits);
  const std::optional<Vec3> end = way_through(walker, small, opening->point, ahead);
  if (!end) return std::nullopt;
  Lesson lesson;
  lesson.kind = Lesson::Kind::narrower;
  lesson.at = opening->point;
  lesson.region.radius = fits;
  lesson.region.support_radius = walker.settings().support_radius;
  const Vec3 room(radius, radius, walker.settings().step);
  for (const Vec3& place : {walker.position(), small.centre, *end}) {
    lesson.region.bounds.include(place - room);
    lesson.region.bounds.include(place + room);
  }
  lesson.region.bounds.include(walker.feet());
  lesson.width = opening->width;
  lesson.region.why = fmt::format("opening {:.2f} m wide", opening->width);
  return lesson;
}

std::optional<Lesson> SizeLearner::support(const Walker& walker) const {
  if (!firm_ || !lost_) return std::nullopt;
  double low = std::max(walker.body().radius, walker.settings().support_radius), high = support_max;
  if (high <= low) return std::nullopt;
  // If not even the largest disc carries, this is a pit or a cliff. Otherwise the trial walker knows the plane of the
  // floor and stands where footing was lost.
  const std::optional<Walker> largest = carried_at(walker, high, firm_at_, lost_at_);
  if (!largest) return std::nullopt;
  while (high - low > disc_precision) {
    const double support = 0.5 * (low + high);
    (carrying(*largest, support) == Carrying::yes ? high : low) = support;
  }
  Lesson lesson;
  lesson.kind = Lesson::Kind::support;
  lesson.at = walker.position();
  lesson.support_radius = std::min(high + support_margin, support_max);
  if (!carried_at(walker, lesson.support_radius, firm_at_, lost_at_)) return std::nullopt;
  lesson.width = 2.0 * high;
  return lesson;
}

void SizeLearner::take(Walker& walker, const Lesson& lesson) {
  const DefaultFloatingPoint guard;
  const bool is_support = lesson.kind == Lesson::Kind::support;
  Profile learned = profile_;
  learned.method = "roaming";
  if (is_support) {
    learned.support_radius = std::max(learned.support_radius, lesson.support_radius);
    for (SizeRegion& region : learned.regions)
      region.support_radius = std::max(region.support_radius, lesson.support_radius);
  } else {
    learned.regions.push_back(lesson.region);
  }
  const auto give = [&](Walker& body) {
    body.set_regions(learned.regions);
    if (is_support) static_cast<void>(body.resize(learned.radius, learned.support_radius));
    if (is_support && firm_) static_cast<void>(body.place(firm_at_));
  };
  Walker trial(walker);
  give(trial);  // throws, if at all, before anything has changed
  give(walker);
  profile_ = std::move(learned);
  pushed_ = 0.0;
  changed_ = true;
}

}  // namespace roam
