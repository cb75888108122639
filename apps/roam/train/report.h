#pragma once
/// \file
/// What `roam train` prints and draws.

#include <filesystem>
#include <string>
#include <vector>

#include "cli/report.h"
#include "draw/opening.h"
#include "roam/train.h"
#include "words/training.h"

namespace roam::app {

/// What was asked, and what came of it.
struct TrainReport {
  std::string scene;
  std::uint64_t triangles = 0;
  TrainOptions options;
  Training training;
  std::filesystem::path profile;  ///< that was written; empty: none
  words::TrainingNames names;
};

[[nodiscard]] Json json_report(const TrainReport& report);
[[nodiscard]] std::string text_report(const TrainReport& report);
/// For `--stats`: interval, regions, trials, parts.
[[nodiscard]] std::string stats_report(const TrainReport& report);

/// What decides, to be drawn with the body that is answered.
[[nodiscard]] std::vector<draw::OpeningView> views_of(const TrainReport& report);

}  // namespace roam::app
