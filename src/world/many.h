#pragma once
/// \file
/// Queries of a space that consists of many worlds.

#include "index/margin.h"
#include "math/largest.h"
#include "world/box_tree.h"
#include "world/query.h"

namespace roam::query {

/// The volume within `reach` metres of the body during its motion, with `margin` metres more.
[[nodiscard]] inline Sweep reached(const Query& query, double reach, double margin = 0.0) {
  const double around = query.body.radius + reach + margin;
  return {query.from, query.motion, {around, around, around + query.body.half_height}};
}

/// The part of a long motion that can concern a box. A world cuts a motion into pieces; this saves those far from the
/// box.
[[nodiscard]] inline Part part_of(const Query& query, const Interval& when) {
  return largest(query.motion) <= index::longest_piece ? Part{} : Part{when.begin, when.end};
}

/// Whether hit `a` comes before hit `b`. At the start the deepest comes first, because the body must get out of that
/// one.
[[nodiscard]] inline bool is_earlier(const FirstImpact& a, const FirstImpact& b) {
  if (a.time != b.time) return a.time < b.time;
  const bool both = a.contact && b.contact;
  if (a.time == 0.0 && both && a.contact->distance != b.contact->distance)
    return a.contact->distance < b.contact->distance;
  return a.triangle < b.triangle;
}

}  // namespace roam::query
