#pragma once
/// \file
/// Report of `roam walk`.

#include <cstdint>
#include <optional>
#include <string>

#include "cli/report.h"
#include "roam/pager.h"
#include "roam/scene_frame.h"
#include "verify/verification.h"
#include "words/walk.h"

namespace roam::app {

/// Times of steps, ns; zeros without steps.
struct StepTimes {
  double median = 0.0;  ///< accurate to 1 %, from a Histogram
  double p99 = 0.0;     ///< accurate to 1 %, from a Histogram
  double max = 0.0;
};

struct WalkReport : words::EndedWalk {
  std::string scene;  ///< the file names
  std::uint64_t triangles = 0;
  std::string profile;  ///< file of the body's profile; empty: none
  std::optional<SceneFrame> frame;
  Vec3 eye{0.0};  ///< the camera's position at the end
  StepTimes times;
  std::optional<verification::Verification> verified;
  double verify_seconds = 0.0;
  std::optional<PagerStats> paging;  ///< set if the scene is a store
};

[[nodiscard]] Json json_report(const WalkReport& report);
[[nodiscard]] std::string text_report(const WalkReport& report);
/// For `--stats`: certified clearances, times, paging, counts of the verification.
[[nodiscard]] std::string stats_report(const WalkReport& report);

}  // namespace roam::app
