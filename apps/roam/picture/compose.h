#pragma once
/// \file
/// The sheet: title, plan, details, section and legend, one below the other.

#include <string>

#include "cut.h"
#include "frames.h"
#include "lines.h"
#include "sheet.h"
#include "walk_report.h"

namespace roam::app::picture {

/// All that a picture tells.
struct Contents {
  std::string title;  ///< the scene and the path, for people
  const WalkReport& report;
  const Record& record;
  const Way& way;
  const Survey& survey;
  const std::vector<Mark>& marks;
  const Levels& levels;
  const Frames& frames;
  const Cuts& cuts;                            ///< plans: the plan, then that of each detail
  std::size_t most_segments = usual_segments;  ///< of each kind in one panel
};

/// Lays the contents out. Pure: the same contents and font give the same sheet.
[[nodiscard]] Sheet compose(const Contents& contents, const MeasureText& measure);

}  // namespace roam::app::picture
