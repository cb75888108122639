#pragma once
/// \file
/// How a space asks many worlds as one.

#include "index/margin.h"
#include "math/largest.h"
#include "world/box_tree.h"
#include "world/query.h"

namespace roam::query {

/// What the body meets on its way, or comes within `reach` metres of, where `margin` metres are kept besides.
[[nodiscard]] inline Sweep reached(const Query& query, double reach, double margin = 0.0) {
  const double around = query.body.radius + reach + margin;
  return {query.from, query.motion, {around, around, around + query.body.half_height}};
}

/// The part of a long way that can concern a box: a world cuts it into pieces, and would cut all of it.
[[nodiscard]] inline Part part_of(const Query& query, const Interval& when) {
  return largest(query.motion) <= index::longest_piece ? Part{} : Part{when.begin, when.end};
}

/// Whether the hit `a` is met before the hit `b`. At the start the deepest counts: that is what to get out of.
[[nodiscard]] inline bool is_earlier(const FirstImpact& a, const FirstImpact& b) {
  if (a.time != b.time) return a.time < b.time;
  const bool both = a.contact && b.contact;
  if (a.time == 0.0 && both && a.contact->distance != b.contact->distance)
    return a.contact->distance < b.contact->distance;
  return a.triangle < b.triangle;
}

}  // namespace roam::query
