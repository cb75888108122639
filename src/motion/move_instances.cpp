#include "roam/move_instances.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <string>

#include "math/floating_point.h"
#include "math/largest.h"
#include "math/slope.h"
#include "motion/state.h"
#include "roam/filtered.h"
#include "text/number.h"

namespace roam {
namespace walking {

Vec3 InstanceMotion::turned(const Vec3& v) const {
  const double angle = to.heading - from.heading;
  return angle == 0.0 ? v : Pose{Vec3(0.0), angle}.to_scene(v);
}

double InstanceMotion::bulge(const Vec3& point, const Vec3& way) const {
  const double angle = std::abs(to.heading - from.heading);
  if (angle == 0.0) return 0.0;
  const double arm = glm::length(point - from.position);
  const double speed = glm::length(to.position - from.position) + glm::length(way);
  return angle * (angle * (arm + speed) + 2.0 * speed) / 8.0;
}

namespace {

/// Rounding of a turned position and way, relative to their lengths, as in a query of Instances.
constexpr double turn_rounding = 0x1p-48;

/// The gap over a way, metres, at most `reach`; nothing if the way may not be free or is too long for a query.
std::optional<double> gap_over(const Space& space, const Query& way, double reach) {
  if (way.body.radius > Space::reach_limit || largest(way.motion) > Space::motion_limit) return std::nullopt;
  const double gap = space.gap_bound(way, reach);
  if (gap >= 0.0) return gap;
  // In touch, a clearance is more exact than a gap.
  if (space.clearance(way, 0.0).distance >= -world_tolerance) return -world_tolerance;
  return std::nullopt;
}

/// The same between a body that moves by `way` and the instance that is shifted meanwhile.
std::optional<double> gap_to_instance(const InstanceMotion& shift, const Body& body, const Vec3& place, const Vec3& way,
                                      double reach) {
  const Vec3 from = shift.from.to_instance(place), to = shift.to.to_instance(place + way);
  const double rounding = turn_rounding * (largest(from) + largest(to));
  const Body grown{body.radius + shift.bulge(place, way) + rounding, body.half_height};
  return gap_over(*shift.world, {grown, from, to - from}, reach);
}

/// A body squeezed out between an instance and the rest moves at most this many times as fast as the instance.
constexpr double steepest_squeeze = 4.0;

/// Whether the instance stays farther than `reach` from the body. It stays in a ball about its origin that moves with
/// it.
bool is_farther(const InstanceMotion& shift, const Body& body, const Vec3& place, double reach) {
  const Box bounds = shift.world->bounds();
  if (bounds.empty()) return true;
  const double ball = glm::length(glm::max(glm::abs(bounds.lower), glm::abs(bounds.upper)));
  const double gone = glm::length(shift.to.position - shift.from.position);
  // One metre is far more than rounding and storage errors.
  return glm::length(place - shift.from.position) > ball + gone + body.radius + body.half_height + reach + 1.0;
}

}  // namespace
}  // namespace walking

void Walker::State::begin_shifts() {
  shifted_ = false;
  rested_ = std::numeric_limits<double>::infinity();
  fitted_ = !held() && looked_at_ == revision();
}

bool Walker::State::meets(const walking::InstanceMotion& shift) const {
  if (mode_ == Mode::ghost || held()) return false;
  if (gait_.object == shift.instance && (gait_.grounded() || gait_.ground_velocity != Vec3(0.0))) return true;
  if (walking::is_farther(shift, body(), at_.place, 0.0)) return false;
  return !walking::gap_to_instance(shift, body(), at_.place, Vec3(0.0), 0.0);
}

void Walker::State::note_passing(const walking::InstanceMotion& shift) {
  const double reach = settings_.clearance_reach;
  if (mode_ == Mode::ghost || held() || walking::is_farther(shift, body(), at_.place, reach)) return;
  const auto gap = walking::gap_to_instance(shift, body(), at_.place, Vec3(0.0), reach);
  // For an instance that turns far there may be no bound. It does not touch the body, so the gap is at least 0.
  rested_ = std::min(rested_, settings_.radius + gap.value_or(0.0));
}

std::optional<walking::Response> Walker::State::response(const Space& rest, const walking::InstanceMotion& shift) {
  // A part may need two segments: one of rest and one of motion. Another rest may follow.
  const bool has_room = !shifted_ || report_.segments.size() + 3 <= decltype(report_.segments)::capacity;
  const double reach = settings_.clearance_reach;
  const auto along = [&](const Vec3& way) -> std::optional<walking::Response> {
    const auto to_instance = walking::gap_to_instance(shift, body(), at_.place, way, reach);
    if (!to_instance) return std::nullopt;
    if (way == Vec3(0.0)) return walking::Response{way, settings_.radius + *to_instance};
    if (!has_room) return std::nullopt;
    const auto to_rest = walking::gap_over(rest, {body(), at_.place, way}, reach);
    if (!to_rest) return std::nullopt;
    const double clearance = settings_.radius + std::min(*to_instance, *to_rest);
    return walking::Response{way, clearance, std::min(rested_, settings_.radius + *to_rest)};
  };
  const bool stands = gait_.object == shift.instance && gait_.grounded();
  const bool drifts = gait_.object == shift.instance && !gait_.grounded();
  const Vec3 carried = shift.carried(at_.place) - at_.place;
  const Vec3 own = stands ? carried : drifts ? gait_.ground_velocity * shift.seconds : Vec3(0.0);
  // Moves as far as the rest of the scene allows, a skin away, and then along the obstacle, if it can.
  const walking::Move move{{rest, vicinity_, settings_, report_, skin_, slope_cosine_, was_blocked_}, at_};
  const auto towards = [&](const Vec3& wish) -> std::optional<walking::Response> {
    if (largest(wish) > walking::longest_way) return std::nullopt;
    const walking::Advance part = move.probe(wish);
    const Vec3 first = wish * part.fraction;
    if (!part.touched) return along(first);
    const Vec3& normal = part.contact.normal;
    const bool is_floor = gait_.grounded() && normal.z >= slope_cosine_ - cosine_rounding;
    Vec3 left = wish - first;
    // A body that is let down onto floor stays there.
    if (is_floor && stands) left.z = std::max(left.z, 0.0);
    const auto aside = [&](const Vec3& slide) {
      walking::Move there = move;
      there.place += first;
      return along(first + slide * there.probe(slide).fraction);
    };
    const Vec3 level(normal.x, normal.y, 0.0);
    const double towards_it = glm::dot(left, level);
    // To a body that stands, a wall is vertical.
    if (gait_.grounded() && !is_floor && towards_it < 0.0) {
      if (const auto to = aside(left - level * (towards_it / glm::dot(level, level)))) return to;
    }
    const Vec3 slide = left - normal * glm::dot(left, normal);
    if (const auto to = aside(slide)) return to;
    if (const auto to = along(first)) return to;
    // Squeezed out between the two: along the obstacle, as fast as the instance approaches.
    const Vec3 seen = shift.from.to_instance(at_.place);
    const double near = std::min(glm::length(wish) + skin_, Space::reach_limit);
    const Clearance pusher = shift.world->clearance(body(), seen, near);
    if (!pusher.found) return std::nullopt;
    const Vec3 push = Pose{Vec3(0.0), shift.from.heading}.to_scene(pusher.normal);
    const double needed = glm::dot(left, push), made = glm::dot(slide, push);
    if (!(needed > 0.0 && made * walking::steepest_squeeze > needed)) return std::nullopt;
    return along(first + slide * (1.001 * needed / made));
  };
  if (const auto to = towards(own)) return to;
  if (!stands) return towards(carried);
  return std::nullopt;
}

void Walker::State::take(const walking::InstanceMotion& shift, const walking::Response& to) {
  if (to.way == Vec3(0.0)) {
    rested_ = std::min(rested_, to.clearance);
  } else {
    if (!shifted_) {
      in_the_end_ = pace();
      begin();
      shifted_ = true;
    }
    append(shift, to);
    at_.place += to.way;
    ride_.way += to.way;
  }
  // Known facts are about the scene as it was.
  at_.known.forget();
  if (gait_.object != shift.instance) return;
  gait_.moved_along = true;
  if (!gait_.grounded()) {
    if (gait_.level) *gait_.level += gait_.ground_velocity.z * shift.seconds;
    return;
  }
  if (gait_.level) *gait_.level += shift.to.position.z - shift.from.position.z;
  gait_.ground = shift.turned(gait_.ground);
  gait_.floor.normal = shift.turned(gait_.floor.normal);
  gait_.floor.point = shift.carried(gait_.floor.point);
  gait_.disc_result.lasts = gait_.disc.found = false;
}

void Walker::State::append(const walking::InstanceMotion& shift, const walking::Response& to) {
  const double infinity = std::numeric_limits<double>::infinity();
  auto& segments = report_.segments;
  // Instances move one after the other. Time does not go back to where the one before began.
  const double before_it = segments.empty() ? 0.0 : segments.back().time;
  const double begin = std::max(shift.begin, before_it), end = std::max(shift.begin + shift.seconds, before_it);
  if (rested_ < infinity) {
    segments.push({at_.place, at_.height, settings_.radius, begin, to.rested, false});
    rested_ = infinity;
  } else if (!segments.empty()) {
    // Straight on: a deviation of 1e-12 of the way is no bend.
    Segment& last = segments.back();
    const Vec3 before = segments.size() > 1 ? segments[segments.size() - 2].position : report_.from;
    const Vec3 gone = last.position - before;
    const double begun = segments.size() > 1 ? segments[segments.size() - 2].time : 0.0, length = glm::length(gone);
    const double straight = 1e-12 * length * glm::length(to.way);
    // The speed must be the same too, because a segment stands for uniform motion.
    const double even = length * (end - begin) - glm::length(to.way) * (last.time - begun);
    const bool goes_on = last.time == begin && std::abs(even) <= 1e-9 * length * shift.seconds;
    if (goes_on && glm::dot(gone, to.way) > 0.0 && glm::length(glm::cross(gone, to.way)) <= straight) {
      last.position = at_.place + to.way;
      last.time = end;
      last.axis_clearance = std::min(last.axis_clearance, to.clearance);
      return;
    }
  }
  segments.push({at_.place + to.way, at_.height, settings_.radius, end, to.clearance, false});
}

void Walker::State::end_shifts(const Vec3& ground_velocity, double dt) {
  if (gait_.grounded()) gait_.ground_velocity = ground_velocity;
  if (fitted_) looked_at_ = revision();
  ride_.seconds += dt;
  if (!shifted_) return;
  report_.elapsed = dt;
  if (rested_ < std::numeric_limits<double>::infinity()) {
    walking::Move m = under_way();
    m.measure();
    at_ = m;
    const double clearance = std::min(rested_, at_.known.clearance);
    report_.segments.push({at_.place, at_.height, settings_.radius, dt, clearance, false});
  }
  finish();
}

namespace {

/// Metres. Greatest deviation from its arc of a body that moves with a turning instance, as long as most_parts
/// suffices.
constexpr double largest_bulge = 2e-5;

/// Part of the body's radius. No part of a movement is longer, so that a body is pushed when it is reached.
constexpr double part_of_radius = 0.25;

/// Greatest number of parts of one movement, limited by the room in a report.
constexpr int most_parts = 48;

/// A part is halved down to this share before an instance stops.
constexpr double least_share = 1.0 / 8.0;

/// The pose after a part of a movement, `seconds` long.
Pose after(const Pose& pose, const Velocity& velocity, double seconds) {
  return {pose.position + velocity.linear * seconds, pose.heading + velocity.turning * seconds};
}

/// Whether the walker's space is `instances`, or filters of it. If a Filtered leaves out the instance, `seen` is set to
/// false.
bool moves_in(const Space& space, const Instances& instances, ObjectId instance, bool& seen) {
  const Space* inner = &space;
  while (const auto* filtered = dynamic_cast<const Filtered*>(inner)) {
    seen = seen && !filtered->ignores(instance);
    inner = &filtered->space();
  }
  return inner == &instances;
}

/// One instance and the bodies that it meets.
class Movement {
 public:
  Movement(Instances& instances, ObjectId instance, std::span<Walker* const> walkers, double dt)
      : instances_(instances),
        instance_(instance),
        velocity_(instances.velocity(instance)),
        begin_(instances.pose(instance)),
        dt_(dt) {
    const walking::InstanceMotion whole = shift(0.0, dt);
    double arm = 0.0, radius = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < walkers.size(); ++i) {
      bool seen = true;
      if (walkers[i] == nullptr || !moves_in(walkers[i]->space(), instances, instance, seen) || !seen) continue;
      if (!walkers[i]->state().meets(whole)) {
        walkers[i]->state().note_passing(whole);
        continue;
      }
      met_.push_back({i, &walkers[i]->state(), Filtered(walkers[i]->space()), {}});
      met_.back().rest.ignore(instance);
      arm = std::max(arm, glm::length(walkers[i]->position() - begin_.position));
      radius = std::min(radius, walkers[i]->body().radius);
    }
    if (met_.empty()) return;
    const double angle = std::abs(velocity_.turning) * dt, way = glm::length(velocity_.linear) * dt;
    const double turns = angle * std::sqrt((arm + way) / (8.0 * largest_bulge));
    parts_ = std::clamp(std::ceil(std::max(turns, way / (part_of_radius * radius))), 1.0, double(most_parts));
  }

  /// Moves all of them. Returns the body that stopped the instance, if any.
  std::optional<Stopped> run() {
    const double usual = dt_ / parts_;
    double done = 0.0, seconds = usual;
    while (done < dt_) {
      const bool last = done + seconds >= dt_ * (1.0 - 1e-12);
      const std::optional<std::size_t> in_the_way = go(done, last ? dt_ - done : seconds);
      if (!in_the_way) {
        done = last ? dt_ : done + seconds;
        seconds = std::min(2.0 * seconds, usual);
        continue;
      }
      seconds *= 0.5;
      if (seconds < least_share * usual) return Stopped{instance_, *in_the_way, done};
    }
    return std::nullopt;
  }

 private:
  struct Met {
    std::size_t number;
    Walker::State* body;
    Filtered rest;
    walking::Response to;
  };

  [[nodiscard]] walking::InstanceMotion shift(double begin, double seconds) const {
    return {instance_,
            &instances_.world(instance_),
            after(begin_, velocity_, begin),
            after(begin_, velocity_, begin + seconds),
            begin,
            seconds};
  }

  /// Moves all bodies and the instance, or none of them; then returns the number of the body that cannot move.
  std::optional<std::size_t> go(double begin, double seconds) {
    const walking::InstanceMotion part = shift(begin, seconds);
    for (Met& it : met_) {
      const std::optional<walking::Response> to = it.body->response(it.rest, part);
      if (!to) return it.number;
      it.to = *to;
    }
    instances_.set_pose(instance_, part.to);
    for (const Met& it : met_) it.body->take(part, it.to);
    return std::nullopt;
  }

  Instances& instances_;
  ObjectId instance_;
  Velocity velocity_;
  Pose begin_;
  double dt_, parts_ = 1.0;
  std::vector<Met> met_;
};

}  // namespace

std::vector<Stopped> move_instances(Instances& instances, std::span<Walker* const> walkers, double dt) {
  const DefaultFloatingPoint guard;
  if (!(dt >= 0.0) || !std::isfinite(dt)) {
    throw Error("the time step is " + number_text(dt) + " s; it must be finite and not negative");
  }
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    bool seen = true;
    if (walkers[i] != nullptr && !moves_in(walkers[i]->space(), instances, no_object, seen)) {
      throw Error("walker " + std::to_string(i) + " does not move in these instances, nor in a Filtered of them");
    }
  }
  for (std::size_t i = 0; i < walkers.size(); ++i) {
    if (walkers[i] != nullptr && std::find(walkers.begin(), walkers.begin() + static_cast<std::ptrdiff_t>(i),
                                           walkers[i]) != walkers.begin() + static_cast<std::ptrdiff_t>(i)) {
      throw Error("walker " + std::to_string(i) + " is in the list twice");
    }
  }
  const std::vector<ObjectId> all = instances.instances();
  for (const ObjectId instance : all) {
    const Pose end = after(instances.pose(instance), instances.velocity(instance), dt);
    if (!(largest(end.position) <= coordinate_limit) || !std::isfinite(end.heading)) {
      throw Error("the instance " + std::to_string(instance) +
                  " would be moved out of the coordinates that roam knows");
    }
  }
  std::vector<Stopped> stopped;
  stopped.reserve(all.size());
  for (Walker* const walker : walkers) {
    if (walker != nullptr) walker->state().begin_shifts();
  }
  bool is_whole = false;
  const auto end = [&] {
    for (Walker* const walker : walkers) {
      if (walker == nullptr) continue;
      const ObjectId ground = walker->stance().object;
      const bool stands_still =
          std::any_of(stopped.begin(), stopped.end(), [&](const Stopped& stop) { return stop.instance == ground; });
      const bool moves = is_whole && instances.has(ground) && !stands_still;
      walker->state().end_shifts(
          moves ? instances.velocity(ground).at(instances.pose(ground), walker->feet()) : Vec3(0.0), dt);
    }
  };
  try {
    for (const ObjectId instance : all) {
      const Velocity& velocity = instances.velocity(instance);
      if (dt == 0.0 || (velocity.linear == Vec3(0.0) && velocity.turning == 0.0)) continue;
      if (const auto stop = Movement(instances, instance, walkers, dt).run()) stopped.push_back(*stop);
    }
  } catch (...) {
    end();  // memory ran out between two parts of the movement: which grounds came to their ends is not known
    throw;
  }
  is_whole = true;
  end();
  return stopped;
}

}  // namespace roam
