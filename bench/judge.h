#pragma once
/// \file
/// Counts an engine's wrong answers, and measures the errors.

#include <cstddef>
#include <span>

#include "query.h"
#include "reference.h"

namespace roam::bench {

/// A deeper answer is wrong: the body is in a wall. Ten times the depth that roam promises never to reach.
constexpr double depth_allowed = 1e-5;  // m
/// An answer that stops the body farther off than this keeps it out of places where it fits.
constexpr double gap_allowed = 1e-3;  // m

/// Wrong answers among some queries. "Depth" is the radius minus the smallest distance of the body's axis from any
/// triangle, by the reference, on the whole way that the engine calls free. So a body that passes through a sheet
/// counts too.
struct Verdict {
  std::size_t queries = 0;
  std::size_t hits = 0;        ///< by the reference
  std::size_t missed = 0;      ///< called free, yet deeper than depth_allowed
  std::size_t late = 0;        ///< hit, but the way to it is deeper than depth_allowed
  std::size_t early = 0;       ///< hit, more than gap_allowed away from every triangle at the time given
  std::size_t false_hits = 0;  ///< hit, more than gap_allowed away, where the reference says free
  double deepest = 0;          ///< metres, over missed and late answers

  [[nodiscard]] std::size_t wrong() const { return missed + late + early + false_hits; }
};

/// A point has no depth: its way beyond the first touch counts instead.
/// `says_when` false: the engine only reports hit or free. Then no hit is late or early; a hit is false if the body
/// never comes within gap_allowed of a triangle.
[[nodiscard]] Verdict judge(std::span<const Answer> answers, std::span<const Answer> truth,
                            std::span<const Query> queries, const Reference& reference, bool says_when = true);

/// A distance is "late" if it is more than depth_allowed above the true one, since a body that trusts it is in a wall,
/// and "early" if it is more than gap_allowed below. `deepest` is the most that a late one is above.
[[nodiscard]] Verdict judge_nearest(std::span<const Answer> answers, std::span<const Answer> truth);

}  // namespace roam::bench
