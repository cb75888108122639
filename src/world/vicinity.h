#pragma once
/// \file
/// What a Vicinity holds: where searches around a body begin.

#include <cstdint>

#include "index/roots.h"
#include "world/nearby.h"

namespace roam {

/// What a body asks for: what is within `reach` (m) of it on its way. Of a sweep that is hit_reach.
struct Question {
  const Body& body;
  const Vec3& from;
  const Vec3& motion;
  double reach;
  double largest_error;    ///< of the space, metres
  std::uint64_t revision;  ///< of the space, which no other has; not 0
};

struct Vicinity::State {
  Box box;                     ///< what `roots` are of; follows from what was asked alone, not from what was there
  std::uint64_t revision = 0;  ///< of the space in which they were gathered
  bool complete = false;       ///< they hold all that meets the box
  index::Roots roots;

  /// Whether the question can be answered within the box, which is moved there where it is not. False for what is too
  /// far or too wide for a vicinity.
  [[nodiscard]] bool cover(const Question& question);
};

/// Where the search for an answer begins; null: with everything. gather(box, roots) adds what meets the box and returns
/// whether that is all.
template <class Gather>
[[nodiscard]] const index::Roots* roots_in(Vicinity& vicinity, const Question& question, const Gather& gather) {
  Vicinity::State* const kept = vicinity.state();
  if (kept == nullptr || !kept->cover(question)) return nullptr;
  if (kept->revision != question.revision) {
    kept->revision = question.revision;
    kept->roots.count = 0;
    kept->complete = gather(kept->box, kept->roots);
  }
  return kept->complete ? &kept->roots : nullptr;
}

}  // namespace roam
