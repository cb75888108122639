#pragma once
/// \file
/// Report and drawings of `roam train`.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/report.h"
#include "draw/opening.h"
#include "roam/scene_frame.h"
#include "roam/train.h"
#include "words/training.h"

namespace roam::app {

/// Options and result of a training.
struct TrainReport {
  std::string scene;
  std::uint64_t triangles = 0;
  TrainOptions options;
  Training training;
  std::filesystem::path profile;  ///< the written file; empty: none
  bool is_beside = false;         ///< the scene, where other verbs find it
  words::TrainingNames names;
  std::optional<SceneFrame> frame{};
};

[[nodiscard]] Json json_report(const TrainReport& report);
[[nodiscard]] std::string text_report(const TrainReport& report);
/// For `--stats`: interval, regions, trials, parts.
[[nodiscard]] std::string stats_report(const TrainReport& report);

/// The deciding openings, to be drawn with the resulting body.
[[nodiscard]] std::vector<draw::OpeningView> views_of(const TrainReport& report);

}  // namespace roam::app
