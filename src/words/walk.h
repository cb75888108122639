#pragma once
/// \file
/// How a walk ended, in plain words.

#include <cstddef>
#include <optional>
#include <string>

#include "roam/route.h"

namespace roam::words {

/// A walk that is over, and what its sentences need.
struct EndedWalk {
  Mode mode = Mode::walk;
  WalkerSettings settings;
  RouteResult result;
  std::size_t waypoints = 0;  ///< of the path; 0 when wandering
  std::string object;         ///< the name of what blocked, if it was blocked by a contact; or why that is not known
  Box bounds;                 ///< of the scene; empty: not known here
  std::optional<Body> body;   ///< at the end, where it may be other than `settings`: in a region, crouched
  bool interrupted = false;   ///< ended early: `result` is what has been so far, and its outcome means nothing
};

/// "reached", "blocked", "left_scene", "fell", "held" or "interrupted".
[[nodiscard]] const char* outcome(const EndedWalk& walk);

/// Where the first event of a kind was.
[[nodiscard]] std::optional<Vec3> first(const RouteResult& result, EventKind kind);

/// Whether anything is certified of how near the body came: not of a ghost, nor of one that fitted nowhere.
[[nodiscard]] bool knows_clearance(const EndedWalk& walk);

/// Says so where the body is larger than all of the scene, which is seldom meant; else nothing.
[[nodiscard]] std::string note_on_size(const WalkerSettings& body, const Box& scene);

/// One sentence or two that say how the walk ended, and what can be done where it did not reach its end.
[[nodiscard]] std::string explain(const EndedWalk& walk);

}  // namespace roam::words
