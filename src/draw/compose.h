#pragma once
/// \file
/// The sheet: title, plan, details, section and legend, one below the other.

#include <string>

#include "draw/cut.h"
#include "draw/frames.h"
#include "draw/lines.h"
#include "draw/sheet.h"
#include "words/walk.h"

namespace roam::draw {

/// The contents of a picture.
struct Contents {
  std::string title;  ///< the scene and the path, for people
  const words::EndedWalk& report;
  const Record& record;
  const Way& way;
  const RoomSurvey& survey;
  const std::vector<Mark>& marks;
  const Levels& levels;
  const Frames& frames;
  const Cuts& cuts;                            ///< plans: the plan, then that of each detail
  std::size_t most_segments = usual_segments;  ///< of each kind in one panel
};

/// Lays the contents out. Pure: the same contents and font give the same sheet.
[[nodiscard]] Sheet compose(const Contents& contents, const MeasureText& measure);

}  // namespace roam::draw
