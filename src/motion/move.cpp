#include "motion/move.h"

#include <algorithm>
#include <array>
#include <glm/geometric.hpp>

namespace roam::walking {
namespace {

/// Skins by which the sweep looks beyond the end. So a slowly moving body stops at the skin instead of creeping into it
/// step by step. Frontal contacts need one; two also serve contacts at 30 degrees.
constexpr double look_ahead = 2.0;

/// Ways. If nothing is within clearance_reach, the next query reaches farther by this many ways, so that what it finds
/// free lasts for that many steps.
constexpr double ways_ahead = 8.0;

/// Skins. Least reach of a query, however short clearance_reach is.
constexpr double least_look = 4.0;

/// Skins. Reach of a query by a body so near to something, mostly its floor, that the report may be too low by the
/// whole gap (Segment::axis_clearance). Then the way only has to be free, and the floor is out of this reach.
constexpr double floor_look = 0.5;

/// A gap returned by the space may be less than the true one (space.h): at least this part of it, less this many
/// metres.
constexpr double gap_part = 7.0 / 8.0;
constexpr double gap_tolerance = 2e-3;

/// A free way is used as long as its bound is at least three quarters of the true gap (Segment::axis_clearance). Let T
/// be the true gap over the motion. Let the motion lie within `away` of the free way, and the free way within `beyond`
/// of the motion. The gap over the free way is at least T - beyond, so at least gap_part (T - beyond) was found. From
/// that, `away` is subtracted. The sum of all losses must be at most a quarter of T, and T is at least gap - away.
constexpr double reported_part = 3.0 / 4.0;
constexpr double beyond_weight = gap_part / (gap_part - reported_part);  // 7
constexpr double away_weight = 1.0 / (gap_part - reported_part) + 1.0;   // 9

/// Part of the gap at the position. A query looks this far ahead, so that a motion that goes on straight needs no query
/// of its own. The gap there is less by at most that part, and gap_part of the rest is still good enough.
constexpr double part_ahead = 1.0 / (1.0 + beyond_weight / gap_part);  // a ninth

/// Each merge of two pieces in one direction may shift the straight line by a rounding of the coordinates, 1e-9 m at
/// 6.4e6 m. This many merges stay far below world_tolerance.
constexpr int merge_limit = 64;

/// Segments that may follow until the room is looked at again: a contact (2) with a step up (3), the ground after it
/// (2), and where the body is then embedded, its new place (1), standing up (2) and another size (2); with a reserve.
constexpr std::size_t segments_at_once = 14;

/// Events of motion noted in one step; the rest of the list is kept for a fall and for events that end a step.
constexpr std::size_t events_of_motion = 16;

/// Distance of a point from a way, metres.
double distance(const Vec3& point, const Vec3& from, const Vec3& to) {
  const Vec3 way = to - from, off = point - from;
  const double squared = glm::dot(way, way);
  return glm::length(squared > 0.0 ? off - way * std::clamp(glm::dot(off, way) / squared, 0.0, 1.0) : off);
}

}  // namespace

Advance Move::probe(const Vec3& motion) const {
  Advance a;
  const double length = glm::length(motion);
  if (!(length > 0.0)) return a;
  const Vec3 direction = motion / length;
  const double looked = length + look_ahead * skin;
  const Impact s = sweep(direction * looked);
  if (!s.hit) return a;
  a.contact = s;
  // The plane of the contact bounds the gap from below on the whole way: it shrinks by `approach` per metre.
  const double approach = std::max(-glm::dot(s.normal, direction), 0.0);
  if (s.time <= 0.0 && (s.distance < 0.0 || approach <= 0.0)) {
    a.touched = a.embedded = true;
    a.fraction = 0.0;
    a.gap = s.distance;
    return a;
  }
  const double until_touch = s.time * looked;
  const double kept = approach > 0.0 ? until_touch - skin / approach : 0.0;
  if (kept >= length) return a;
  a.touched = true;
  const double gone = kept > rest_part * skin ? kept : 0.0;
  a.fraction = gone / length;
  a.gap = approach * (until_touch - gone);
  return a;
}

Advance Move::advance(const Vec3& motion, double seconds) {
  const double length = glm::length(motion);
  if (!(length > 0.0)) {
    time += seconds;
    return {};
  }
  if (!known.touching || known.fit == Fit::unproven) {
    const double gap = look_along(motion * (1.0 + look_ahead * skin / length));
    if (gap > free_gap) {
      known.fit = Fit::known;
      time += seconds;
      go(motion, settings.radius + std::min(gap, settings.clearance_reach));
      return {};
    }
  }
  known.touching = false;
  if (known.fit == Fit::unproven) {
    known.fit = Fit::known;
    if (space.clearance(body(), place, 0.0).distance < -world_tolerance) {
      known.fit = Fit::came_upon;
      known.free_way = {};
      return {.fraction = 0.0, .touched = true, .embedded = true, .contact = {}, .gap = 0.0};
    }
  }
  const Advance a = probe(motion);
  time += a.fraction * seconds;
  if (a.fraction > 0.0) go(a.fraction < 1.0 ? motion * a.fraction : motion);
  return a;
}

double Move::known_gap(const Vec3& motion, double reach) const {
  const FreeWay& free = known.free_way;
  if (!(free.gap > 0.0) || free.radius != settings.radius || free.height != height) return 0.0;
  const Vec3 end = place + motion;
  const double away = std::max(distance(place, free.from, free.to), distance(end, free.from, free.to));
  const double rest = free.gap - away;
  if (rest >= reach) return rest;
  const double beyond = std::max(distance(free.from, place, end), distance(free.to, place, end));
  return away_weight * away + beyond_weight * beyond <= free.gap ? rest : 0.0;
}

double Move::look_along(const Vec3& motion) {
  const double reach = std::max(settings.clearance_reach, least_look * skin), length = glm::length(motion);
  if (const double gap = known_gap(motion, reach); gap > 0.0) return gap;
  FreeWay& free = known.free_way;
  const bool on_floor = reported_part * known.nearest <= look_ahead * skin + gap_tolerance;
  Vec3 way = motion;
  double look = std::max(floor_look * skin, 2.0 * free_gap);
  if (!on_floor) {
    const bool same_body = free.radius == settings.radius && free.height == height;
    const double here = same_body ? std::min(free.gap - distance(place, free.from, free.to), reach) : 0.0;
    if (length > 0.0 && length < part_ahead * here) way *= part_ahead * here / length;
    const bool in_the_open = same_body && free.gap >= reach;
    look = in_the_open ? reach + ways_ahead * length : reach;
  }
  look = std::min({look, known.nearest, Space::reach_limit});
  const double gap = Nearby::gap_bound(space, vicinity, {body(), place, way}, look);
  free = {};
  if (!(gap > free_gap)) return gap;
  // With so short a reach the true gap may be far more.
  if (!on_floor) free = {place, place + way, gap, settings.radius, height};
  // The near object may be near only at the far end of the way.
  if (gap < look) known.nearest = std::min(known.nearest, gap / gap_part + gap_tolerance + glm::length(way));
  return gap;
}

double Move::gap_over(const Vec3& motion) { return std::min(look_along(motion), settings.clearance_reach); }

double Move::clearance_over(const Vec3& motion) {
  return settings.radius + std::max(gap_over(motion), -world_tolerance);
}

double Move::measured(const Vec3& motion) {
  const double gap = gap_over(motion);
  if (gap >= -world_tolerance) return settings.radius + gap;
  // In touch, a clearance is more exact than a gap.
  const bool fits = space.clearance(body(), place, motion, 0.0).distance >= -world_tolerance;
  return fits ? settings.radius - world_tolerance : 0.0;
}

void Move::measure() {
  known.clearance = measured(Vec3(0.0));
  known.measured = Measured::place;
}

void Move::go(const Vec3& motion) {
  if (glm::length(motion) > 0.0) go(motion, clearance_over(motion));
}

void Move::go(const Vec3& motion, double certified) {
  const double length = glm::length(motion);
  known.clearance = certified;
  known.measured = Measured::way;
  place += motion;
  known.nearest += length;
  const Vec3 direction = motion / length;
  const bool straight_on = !report.segments.empty() && direction == last_direction_ && merged_ < merge_limit &&
                           report.segments.back().height == height && report.segments.back().radius == settings.radius;
  if (straight_on) {
    Segment& last = report.segments.back();
    last.position = place;
    last.time = time;
    last.axis_clearance = std::min(last.axis_clearance, certified);
    ++merged_;
  } else {
    report.segments.push({place, height, settings.radius, time, certified, false});
    last_direction_ = direction;
    merged_ = 0;
  }
}

void Move::ease_off(const Advance& touch) {
  if (touch.gap < 0.5 * skin) advance(touch.contact.normal * (skin - touch.gap), 0.0);
}

void Move::resize(double new_height, const Vec3& new_place) {
  double certified = known.clearance;
  const bool was_known = known.measured != Measured::nothing;
  known.forget_place();
  height = new_height;
  if (!was_known) certified = measured(new_place - place);
  place = new_place;
  known.forget_place();
  known.clearance = certified;
  report.segments.push({place, height, settings.radius, time, certified, false});
  last_direction_ = Vec3(0.0);
}

void Move::touch(const Impact& contact, double gap) {
  Contact c;
  c.point = contact.point;
  c.normal = contact.normal;
  c.feature = contact.feature;
  c.distance = gap;
  c.triangle = contact.triangle;
  c.object = contact.object;
  c.unknown = contact.unknown;
  report.met_unknown |= c.unknown;
  // The last touched contact stands last, and only once.
  InlineList<Contact, 8>& list = report.contacts;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (list[i].triangle != c.triangle || list[i].feature != c.feature) continue;
    for (; i + 1 < list.size(); ++i) list[i] = list[i + 1];
    list[i] = c;
    last_direction_ = Vec3(0.0);
    return;
  }
  if (list.full()) {
    list.back() = c;
  } else {
    list.push(c);
  }
  last_direction_ = Vec3(0.0);
}

void Move::block(const Vec3& point) {
  if (!report.blocked && !was_blocked) note(EventKind::blocked, point);
  report.blocked = true;
}

void Move::note(EventKind kind, const Vec3& point) {
  const bool is_first_fall = kind == EventKind::fell && !report.has(kind);
  if (is_first_fall || report.events.size() < events_of_motion) report.events.push({kind, point});
}

Move::Mark Move::mark() const {
  const Segment last = report.segments.empty() ? Segment{} : report.segments.back();
  return {
      *this,           time,           last_direction_,   merged_, last, report.segments.size(), report.events.size(),
      report.contacts, report.blocked, report.met_unknown};
}

void Move::undo(const Mark& m) {
  static_cast<Whereabouts&>(*this) = m.at;
  time = m.time;
  last_direction_ = m.direction;
  merged_ = m.merged;
  report.segments.shorten(m.segments);
  if (!report.segments.empty()) report.segments.back() = m.segment;
  report.events.shorten(m.events);
  report.contacts = m.contacts;
  report.blocked = m.blocked;
  report.met_unknown = m.met_unknown;
}

bool Move::has_room() const { return report.segments.size() + segments_at_once <= report.segments.capacity; }

}  // namespace roam::walking
