#pragma once
/// \file
/// Queries of a body that keeps what lies around it.

#include "roam/space.h"

namespace roam {

/// Space::sweep() and gap() for a body that asks again from near where it asked last: the same promises, and in a World
/// or a Pager less to look at. Within what they leave open an answer may be another, for it depends on where a search
/// begins: a hit by the 0.025 mm by which a body may arrive before it touches, along a flat way by more, a gap by the
/// part by which it may be too small. The same queries in the same order, from an equal vicinity on and while the
/// revision is the same, get the same bits.
///
/// Walker makes no sweep along a way of which the gap exceeds 0.05 mm. That the body passes nothing rests on the gap
/// then as it does on the sweep.
struct Nearby {
  [[nodiscard]] static Impact sweep(const Space& space, Vicinity& vicinity, const Query& query);
  [[nodiscard]] static double gap(const Space& space, Vicinity& vicinity, const Query& query, double reach);
};

}  // namespace roam
