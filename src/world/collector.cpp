#include "roam/collector.h"

#include <algorithm>

#include "sweep/seen_from.h"
#include "world/floor_only.h"
#include "world/frame.h"
#include "world/query.h"

namespace roam {
namespace {

bool nearer(const Contact& a, const Contact& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.triangle < b.triangle;
}

}  // namespace

Collector::Collector(Kind kind, double reach, std::span<Contact> out)
    : out_(out), initial_reach_(reach), reach_(reach), enough_(reach), kind_(kind) {
  if (kind == Kind::clearance) {
    tolerance_ = query::clearance_tolerance;
    part_ = query::least_part;
  } else if (kind == Kind::gap) {
    tolerance_ = std::numeric_limits<double>::infinity();
    part_ = query::gap_part;
    bounds_only_ = true;
  }
}

void Collector::demand(double tolerance) {
  if (!(tolerance > 0.0)) {
    tolerance_ = 0.0;
    bounds_only_ = false;
  } else if (!bounds_only_) {
    tolerance_ = std::min(tolerance_, tolerance);
  }
}

void Collector::offer(const Query& query, const Triangle& triangle, TriangleId id, ObjectId object) {
  if (const ObjectFilter* const ignored = query.ignored) {
    if ((object != no_object && ignored->ignores(object)) || ignored->ignores(triangle)) return;
  }
  const certified::LocalTriangle local = certified::seen_from(query.from, triangle);
  const auto measure = [&](const certified::LocalTriangle& part) {
    Contact c = query::contact_with(part, query.body, query.from, query.motion);
    c.triangle = id;
    c.object = object;
    offer(c);
  };
  if (floor_ == nullptr) return measure(local);
  for (const certified::LocalTriangle& part : floor_->pieces(local)) measure(part);
}

void Collector::keep_seen(const Contact& c, double doubt) { keep(frame_->in_scene(c), doubt + 2.0 * frame_->pad); }

void Collector::keep(const Contact& c, double doubt) {
  if (only_ != nullptr) {
    if (c.triangle != only_->triangle || (count_ > 0 && !nearer(c, out_[0]))) return;
    out_[0] = c;
    count_ = 1;
    return;
  }
  if (c.distance <= reach_ && !known(c)) {
    if (count_ < out_.size()) {
      out_[count_++] = c;
      std::push_heap(out_.begin(), end(), nearer);
    } else if (nearer(c, out_[0])) {
      std::pop_heap(out_.begin(), end(), nearer);
      out_[count_ - 1] = c;
      std::push_heap(out_.begin(), end(), nearer);
    }
  }
  // Contacts farther than the farthest of a full list do not matter.
  if (count_ == out_.size()) reach_ = std::min(reach_, out_[0].distance);
  enough_ = std::min(enough_, reach_);
  if (tolerance_ > 0.0 && count_ > 0 && c.distance > 0.0) {
    const double reported = bounds_only_ ? c.distance + doubt : c.distance;
    enough_ = std::min(enough_, std::max(c.distance + doubt - tolerance_, reported * (1.0 - part_)));
  }
}

void Collector::sort() { std::sort_heap(out_.begin(), end(), nearer); }

bool Collector::takes_unknown(const Box& box, double radius, double margin) const {
  return floor_ == nullptr || floor_->may_lie_in(box, radius + reach_, margin);
}

bool Collector::known(const Contact& c) {
  if (!repeats_) return false;
  const auto same = std::find_if(out_.begin(), end(), [&](const Contact& o) { return o.triangle == c.triangle; });
  if (same == end()) return false;
  if (nearer(c, *same)) {
    *same = c;
    std::make_heap(out_.begin(), end(), nearer);
  }
  return true;
}

}  // namespace roam
