#pragma once
/// \file
/// What `roam walk` prints.

#include <cstdint>
#include <optional>
#include <string>

#include "cli/report.h"
#include "roam/pager.h"
#include "verify/verification.h"
#include "words/walk.h"

namespace roam::app {

/// The times of steps, ns; zeros where there was no step.
struct StepTimes {
  double median = 0.0;  ///< to 1 %, as a Histogram says it
  double p99 = 0.0;     ///< the same
  double max = 0.0;
};

struct WalkReport : words::EndedWalk {
  std::string scene;  ///< the file names
  std::uint64_t triangles = 0;
  std::string profile;  ///< the file that the body was taken from; empty: none
  Vec3 eye{0.0};        ///< the camera at the end
  StepTimes times;
  std::optional<verification::Verification> verified;
  double verify_seconds = 0.0;
  std::optional<PagerStats> paging;  ///< where the scene is a store
};

[[nodiscard]] Json json_report(const WalkReport& report);
[[nodiscard]] std::string text_report(const WalkReport& report);
/// For `--stats`: certified clearances, times, paging, counts of the check.
[[nodiscard]] std::string stats_report(const WalkReport& report);

}  // namespace roam::app
