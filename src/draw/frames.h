#pragma once
/// \file
/// The parts of the scene that the sheet of a walk shows, and their scales: pure numbers, before anything is cut or
/// drawn.

#include <vector>

#include "draw/geometry.h"
#include "draw/marks.h"
#include "draw/stations.h"
#include "draw/way.h"
#include "roam/walker.h"

namespace roam::draw {

inline constexpr double detail_gap = 30.0;  ///< pixels between details

/// A magnified place.
struct Detail {
  std::vector<std::size_t> marks;  ///< marks in it; the first one is its subject
  Frame plan;
  Frame section;
};

struct Frames {
  Turn turn;
  Frame plan;
  Frame section;
  bool section_has_plan_scale = false;
  double exaggeration = 1.0;  ///< of the section's heights
  std::vector<Detail> details;
};

/// Chooses the frames:
/// - turns the plan so that the way leads from left to right, unless it fits about as well with x to the right and y
///   up;
/// - shows the walls beside the way as far as the survey measured, or the whole scene if that is not much larger than
///   the way;
/// - uses the plan's scale for the section if that fits;
/// - adds details if the body would be smaller than a dot.
[[nodiscard]] Frames choose_frames(const Way& way, const RoomSurvey& survey, const std::vector<Mark>& marks,
                                   const Box& scene, const WalkerSettings& settings);

}  // namespace roam::draw
