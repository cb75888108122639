#pragma once
/// \file
/// The frame of a scene or store, as verbs know it before and after reading.

#include <optional>
#include <string>

#include "cli/report.h"
#include "roam/scene_frame.h"
#include "roam/store.h"
#include "scenes/scene_options.h"

namespace roam::app {

/// The frame in which these options read the scene; of a store the frame in which it was built. None if the scene's
/// files differ, or if the store cannot be opened.
[[nodiscard]] std::optional<SceneFrame> frame_of(const SceneOptions& scene);
[[nodiscard]] std::optional<SceneFrame> frame_of(const Store& store);

/// The options that read a scene in this frame: "--up=y --unit=cm", without a unit of metres.
[[nodiscard]] std::string options_of(const SceneFrame& frame);

/// {"up": "y", "unit": "cm", "matrix": four rows, see SceneFrame::to_file}; null if there is none.
[[nodiscard]] Json to_json(const std::optional<SceneFrame>& frame);

}  // namespace roam::app
