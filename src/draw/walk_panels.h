#pragma once
/// \file
/// Plans and sections of a walk: walls, way, touches, bodies and marks, painted from plain values.

#include <array>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "draw/cut.h"
#include "draw/frames.h"
#include "draw/levels.h"
#include "draw/marks.h"
#include "draw/panel.h"

namespace roam::draw {

/// The shapes of a walk's plans and sections, cut out of the scene: before anything is painted. The referenced values
/// must outlive it.
struct WalkDrawing {
  Mode mode = Mode::walk;
  double radius = 0.0;  ///< of the body, metres
  const Record& record;
  const Way& way;
  const RoomSurvey& survey;
  std::size_t most_segments = usual_segments;  ///< of each kind in one panel
  std::vector<Mark> marks;
  Frames frames;
  Levels levels;
  Cuts cuts;  ///< plans: the plan, then that of each detail; sections alike
};

/// The gaps beside the body, metres, at which the colour of the way changes.
struct GapScale {
  std::array<double, gap_styles.size() - 1> limits{};
  /// From a sixth of the radius upward in round lengths.
  explicit GapScale(double radius);
  [[nodiscard]] std::size_t index(double gap) const;
};

/// The colour for success, attention or failure.
[[nodiscard]] Colour colour_of(MarkKind kind);

void paint_plan(Panel& panel, const WalkDrawing& walk, const PlanCut& cut);
/// Unrolled along the way. Points are (metres along the way, height).
/// `grid`: that of the cut's ends; see PlanCut.
void paint_section(Panel& panel, const WalkDrawing& walk, std::span<const Segment> cut, double grid);

/// Writes labels at the marks of a painted panel. `label` returns the lines for the mark of an index; none: no label.
void label_marks(Panel& panel, const WalkDrawing& walk, bool is_plan,
                 const std::function<std::vector<std::string>(std::size_t)>& label);

}  // namespace roam::draw
