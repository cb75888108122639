#pragma once
/// \file
/// How a walk ended, in plain words.

#include <cstddef>
#include <optional>
#include <string>

#include "measure/along.h"
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
  bool interrupted = false;   ///< ended early: `result` is the walk so far, and its outcome means nothing
  std::optional<measure::NarrowPlace> narrowest;  ///< none: nowhere were there walls on both sides
  std::string left, right;                        ///< names of the objects there; empty: without a name
  std::optional<measure::LowPlace> lowest;        ///< none: nowhere was there anything above
  std::optional<double> slope;                    ///< degrees: of the face below a body that fell; none: not known
  std::uint64_t ducked = 0;                       ///< how often the body crouched
  double reach = 0.0;                             ///< m: how far beside the body was measured; 0: not at all
};

/// "reached", "blocked", "left_scene", "fell", "held" or "interrupted".
[[nodiscard]] const char* outcome(const EndedWalk& walk);

/// Where the first event of a kind was.
[[nodiscard]] std::optional<Vec3> first(const RouteResult& result, EventKind kind);

/// Whether anything is certified of how near the body came: not of a ghost, nor of one that fitted nowhere.
[[nodiscard]] bool knows_clearance(const EndedWalk& walk);

/// Whether a body fell because it slid down a face of this slope (degrees), not over an edge.
[[nodiscard]] bool is_too_steep(const std::optional<double>& slope, const WalkerSettings& body);

/// Says so where the body is larger than all of the scene, which is seldom meant; else nothing.
[[nodiscard]] std::string note_on_size(const WalkerSettings& body, const Box& scene);

/// The result in one line: "REACHED: 10 of 10 waypoints, 96.9 m in 68.2 s".
[[nodiscard]] std::string headline(const EndedWalk& walk);

/// "0.750 m clear at 24.0 m, (1.00, 2.00, 3.00): 75 mm to spare on each side"; empty if nothing was measured.
[[nodiscard]] std::string narrowest_place(const EndedWalk& walk);

/// "ducked twice; 1.24 m at the lowest, at 26.0 m, (1.00, 2.00, 3.00)"; empty if nothing was measured, and for flights.
[[nodiscard]] std::string headroom(const EndedWalk& walk);

/// One sentence or two that say how the walk ended, and what can be done where it did not reach its end.
[[nodiscard]] std::string explain(const EndedWalk& walk);

}  // namespace roam::words
