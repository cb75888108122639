#pragma once
/// \file
/// What `roam walk` prints.

#include <cstdint>
#include <optional>
#include <string>

#include "cli/report.h"
#include "roam/pager.h"
#include "roam/route.h"
#include "verify/verification.h"

namespace roam::app {

/// The times of steps, ns; zeros where there was no step.
struct StepTimes {
  double median = 0.0;  ///< to 1 %, as a Histogram says it
  double p99 = 0.0;     ///< the same
  double max = 0.0;
};

struct WalkReport {
  std::string scene;  ///< the file names
  std::uint64_t triangles = 0;
  Mode mode = Mode::walk;
  WalkerSettings settings;
  std::string profile;  ///< the file that the body was taken from; empty: none
  RouteResult result;
  std::size_t waypoints = 0;  ///< of the path; 0 when wandering
  Vec3 eye{0.0};              ///< the camera at the end
  std::string object;         ///< the name of what blocked, if it was blocked by a contact; or why that is not known
  StepTimes times;
  std::optional<verification::Verification> verified;
  double verify_seconds = 0.0;
  std::optional<PagerStats> paging;  ///< where the scene is a store
  Box bounds;                        ///< of the scene; empty: not known here
  std::optional<Body> body;          ///< at the end, where it may be other than `settings`: in a region, crouched
};

/// What a pager held and did, as every report says it.
[[nodiscard]] Json json_report(const PagerStats& paging);

/// Whether anything is certified of how near the body came: not of a ghost, nor of one that fitted nowhere.
[[nodiscard]] bool knows_clearance(const WalkReport& report);
/// Says so where the body is larger than all of the scene, which is seldom meant; else nothing.
[[nodiscard]] std::string note_on_size(const WalkerSettings& body, const Box& scene);

/// One sentence or two that say how the walk ended, and what can be done where it did not reach its end.
[[nodiscard]] std::string explain(const WalkReport& report);

[[nodiscard]] Json json_report(const WalkReport& report);
[[nodiscard]] std::string text_report(const WalkReport& report);

}  // namespace roam::app
