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

/// The same without --up and --unit: the frame of the format.
[[nodiscard]] std::optional<SceneFrame> usual_frame_of(SceneOptions scene);

/// Reads the scene in the frame that its profile keeps, if the options say neither --up nor --unit, and the scene is no
/// store. A note says so where the frame is not that of the format. Throws roam::Error for an unreadable profile, with
/// advice how to do without.
void take_kept_frame(SceneOptions& scene);

/// The line of a report that says which profile the frame is from; empty if it is from none.
[[nodiscard]] std::string kept_frame_line(const SceneOptions& scene);

/// The frame for a profile of this scene: none if it is that of the format.
[[nodiscard]] std::optional<SceneFrame> frame_to_keep(const SceneOptions& scene);

/// The frame after a turn by 90 degrees: with the likely axis up, else with the next of z, y, x, -z, -y, -x, in a
/// circle.
[[nodiscard]] SceneFrame next_frame(const SceneFrame& frame, const std::optional<UpAxis>& likely);

/// The options that read a scene in this frame: "--up=y --unit=cm", without a unit of metres.
[[nodiscard]] std::string options_of(const SceneFrame& frame);

/// The options that read a scene in the frame `wanted` instead of `now`: as above, or with --unit=m if `now` has
/// another.
[[nodiscard]] std::string options_for(const SceneFrame& wanted, const SceneFrame& now);

/// {"up": "y", "unit": "cm", "matrix": four rows, see SceneFrame::to_file}; null if there is none.
[[nodiscard]] Json to_json(const std::optional<SceneFrame>& frame);

}  // namespace roam::app
