#include "motion/move.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace roam::walking {
namespace {

/// The sweep looks this many skins beyond the end, so that a body in slow motion stops at the skin instead of creeping
/// into it step by step. Frontal contacts need one; two also serve contacts at 30 degrees.
constexpr double look_ahead = 2.0;

/// Each merge of two pieces in one direction may move the straight line by a rounding of the coordinates, 1e-9 m at
/// 6.4e6 m: this many stay far below world_tolerance.
constexpr int merge_limit = 64;

/// Corners that one stride or one stretch of flight may add: slides, a step up (three), ground snap, crouching.
constexpr std::size_t corners_at_once = 24;

/// Slides and steps that are noted in one step; the rest of the list is kept for a fall and for what ends a step.
constexpr std::size_t events_of_motion = 16;

}  // namespace

Advance probe(const Space& space, const Body& body, const Vec3& from, const Vec3& motion, double skin) {
  Advance a;
  const double length = glm::length(motion);
  if (!(length > 0.0)) return a;
  const Vec3 direction = motion / length;
  const double looked = length + look_ahead * skin;
  const Impact s = space.sweep(body, from, direction * looked);
  if (!s.hit) return a;
  a.contact = s;
  // The plane of the contact bounds the gap from below on the whole way: it shrinks by `approach` a metre.
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
  const Advance a = probe(motion);
  time += a.fraction * seconds;
  if (a.fraction > 0.0) go(a.fraction < 1.0 ? motion * a.fraction : motion);
  return a;
}

double Move::clearance_over(const Vec3& motion) const {
  // Nothing beyond what bounds the way so far can bound it now.
  const double known = std::clamp(clearance - settings.radius, 0.0, settings.clearance_reach);
  return settings.radius + std::max(space.clearance(body(), place, motion, known).distance, -world_tolerance);
}

void Move::go(const Vec3& motion) {
  const double length = glm::length(motion);
  if (!(length > 0.0)) return;
  clearance = clearance_over(motion);
  place += motion;
  nearest += length;
  const Vec3 direction = motion / length;
  const bool straight_on = !report.corners.empty() && direction == last_direction_ && merged_ < merge_limit &&
                           report.corners.back().height == height && report.corners.back().radius == settings.radius;
  if (straight_on) {
    Corner& last = report.corners.back();
    last.position = place;
    last.time = time;
    last.clearance = clearance;
    ++merged_;
  } else {
    report.corners.push({place, height, settings.radius, time, clearance, false});
    last_direction_ = direction;
    merged_ = 0;
  }
}

void Move::ease_off(const Advance& touch) {
  if (touch.gap < 0.5 * skin) advance(touch.contact.normal * (skin - touch.gap), 0.0);
}

void Move::resize(double new_height, const Vec3& new_place) {
  height = new_height;
  place = new_place;
  nearest = std::numeric_limits<double>::infinity();
  report.corners.push({place, height, settings.radius, time, clearance, false});
  last_direction_ = Vec3(0.0);
}

void Move::touch(const Impact& contact, double gap) {
  Contact c;
  c.point = contact.point;
  c.normal = contact.normal;
  c.feature = contact.feature;
  c.distance = gap;
  c.triangle = contact.triangle;
  c.unknown = contact.unknown;
  report.met_unknown |= c.unknown;
  // The last touched stands last, and once.
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

void Move::note(EventKind kind, const Vec3& point) {
  const bool seldom = kind == EventKind::fell || (kind > EventKind::stood && kind != EventKind::carried);
  if (seldom || report.events.size() < events_of_motion) report.events.push({kind, point});
}

Move::Mark Move::mark() const {
  const Corner last = report.corners.empty() ? Corner{} : report.corners.back();
  return {place,
          height,
          clearance,
          time,
          nearest,
          last_direction_,
          merged_,
          last,
          report.corners.size(),
          report.events.size(),
          report.contacts,
          report.blocked,
          report.met_unknown};
}

void Move::undo(const Mark& m) {
  place = m.place;
  height = m.height;
  clearance = m.clearance;
  time = m.time;
  nearest = m.nearest;
  last_direction_ = m.direction;
  merged_ = m.merged;
  report.corners.shorten(m.corners);
  if (!report.corners.empty()) report.corners.back() = m.corner;
  report.events.shorten(m.events);
  report.contacts = m.contacts;
  report.blocked = m.blocked;
  report.met_unknown = m.met_unknown;
}

bool Move::has_room() const { return report.corners.size() + corners_at_once <= report.corners.capacity; }

}  // namespace roam::walking
