#pragma once
/// \file
/// Chooses the part of the scene that a picture shows, and its scale: pure numbers, before anything is cut or drawn.

#include <vector>

#include "draw/geometry.h"
#include "draw/marks.h"
#include "draw/survey.h"
#include "draw/way.h"
#include "roam/walker.h"

namespace roam::draw {

/// Pixels of the sheet.
inline constexpr double sheet_width = 2000.0;
inline constexpr double sheet_margin = 60.0;
inline constexpr double content_width = sheet_width - 2.0 * sheet_margin;

/// A part of a plan or section, with its scale.
struct Frame {
  Rect view;             ///< in metres of the plan or section
  double scale_x = 1.0;  ///< pixels per metre
  double scale_y = 1.0;

  [[nodiscard]] double width() const { return view.width() * scale_x; }    ///< pixels
  [[nodiscard]] double height() const { return view.height() * scale_y; }  ///< pixels
};

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

/// The largest of 1, 2, 5, 10, 20, 50, ... and 0.5, 0.2, ... that is at most `limit` (> 0).
[[nodiscard]] double round_length(double limit);

}  // namespace roam::draw
